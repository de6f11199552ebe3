"""What the printed digits of X, Y, K say: about rho and e(0), about the mean motion, about the observer matrix."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import permutations, product
from typing import Any

import numpy as np

from recontrol.lmi.conditions import maximise
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError

from .. import boxes
from ..problems import rendezvous
from .gains import COST_UNIT

LOW, HIGH, GRID = 1.120e-3, 1.135e-3, 6  # rad/s
CLOSE = (1.1265e-3, 1.127e-3)
STEPS_OUT, STEPS_IN = (4e-9, 4e-8, 1.2e-7), (4e-8, 1.2e-7, 4e-7, 1e-6)  # rad/s
OBSERVERS = {"SF": "", "CO": ", canonical"}


def smaller_reciprocal(r: Any, cost_unit: Any) -> Any:
    """Minus the objective: its maximum is the largest rho."""
    return -cost_unit * r


def _extreme_rho(data: Any, problem: Problem, *, largest: bool) -> float | None:
    found = boxes.solve(replace(problem, objective=maximise(smaller_reciprocal)) if largest else problem, data, None)
    return None if found.margin is None else COST_UNIT / abs(found.margin)


def digits(data: Any) -> dict[str, Any]:
    """(X, Y) in their boxes, SF with R twice at n_printed: rho; what (31) alone allows; V(0) for each e(0)."""
    base = rendezvous(data, "n_printed")
    without_start = replace(base, conditions=[c for c in base.named if not c.name.startswith("eq30")])
    found: dict[str, Any] = {
        "rho_low": _extreme_rho(data, base, largest=False),
        "rho_high": _extreme_rho(data, base, largest=True),
        "rho_high_limits_only": _extreme_rho(data, without_start, largest=True),
        "mu": boxes.margin(rendezvous(data, "n_printed", margin=True), data, with_gain=False).margin,
    }
    for case in ("e0_zero", "e0_velocity", "e0_full"):
        problem = rendezvous(data, f"n_printed, {case}", saturated=False)
        smallest = _extreme_rho(data, problem, largest=False)
        found[case] = {
            "smallest_V0": smallest,
            "excluded": None if smallest is None else bool(smallest > found["rho_high_limits_only"]),
        }
    found["gain_multiple"] = boxes.gain_point(data)[0]
    return found


def pair(data: Any, case: str, count: int) -> tuple[Problem, Problem]:
    """The problem of a case, and the same held off by a margin."""
    return rendezvous(data, case, count=count), rendezvous(data, case, count=count, margin=True)


def joint(data: Any) -> dict[str, Any]:
    """Joint boxes of X, Y, K: refutations at n_printed and witnesses at n_orbit, SF and CO, R twice and once;
    what X and Y alone say of CO; and the starts with an observer error, which (30), (31) refute."""
    found: dict[str, Any] = {"gain": dict(zip(("multiple", "X", "K"), boxes.gain_point(data), strict=True))}
    for problem, observer in OBSERVERS.items():
        for count in (2, 1):
            _, held = pair(data, f"n_printed{observer}", count)
            found[f"{problem}_n_printed_R{count}"] = boxes.refutation(held, data, with_gain=True)
            plain, held = pair(data, f"n_orbit{observer}", count)
            found[f"{problem}_n_orbit_R{count}"] = boxes.witness(held, plain, data)
    return found


def joint_margin(data: Any, observer: str, count: int, n: float) -> float:
    """Margin [1/s] of the joint box of X, Y, K at one mean motion, relaxed from above; -1 without a point."""
    held = rendezvous(data, f"n={n:.9g}{observer}", count=count, margin=True)
    found = boxes.margin(held, data, with_gain=True)
    return -1.0 if found.margin is None else found.margin


def intervals(data: Any) -> dict[str, Any]:
    """For SF and CO, R twice: margins over n; R twice and once: the ends of the interval of n that the digits admit.

    Outside the relaxed margin is negative and the refuting vector is kept; inside a witness is kept, found a little
    further in, since the relaxation is wider than the truth.
    """
    found: dict[str, Any] = {}
    for problem, observer in OBSERVERS.items():
        margins = {n: joint_margin(data, observer, 2, n) for n in sorted([*np.linspace(LOW, HIGH, GRID), *CLOSE])}
        grid = list(margins)
        found[problem] = {"n": np.array(grid), "margin": np.array([margins[n] for n in grid])}
        best = max(grid, key=lambda n: margins[n])
        plain, held = pair(data, f"n={best:.9g}{observer}", 2)
        start = boxes.witness(held, plain, data)
        negative = [n for n in grid if margins[n] < 0]
        sides = {"low": max(n for n in negative if n < best), "high": min(n for n in negative if n > best)}
        for side, outside in sides.items():
            for count in (2, 1):
                end = _root(partial(joint_margin, data, observer, count), best, outside)
                found[f"{problem}_{side}_R{count}"] = end
                if count == 2:
                    found[f"{problem}_{side}"] = _ends(data, observer, end, 1 if side == "low" else -1, start)
    return found


def _root(margin: Any, inside: float, outside: float) -> float:
    """Where the margin changes sign, to 2e-9 rad/s."""
    from scipy.optimize import brentq

    return float(brentq(margin, inside, outside, xtol=2e-9, rtol=1e-7))


def _ends(data: Any, observer: str, end: float, inward: int, start: dict[str, Any] | None) -> dict[str, Any]:
    """The nearest n outside that is refuted and the nearest inside that has a witness, with what proves them."""
    entry: dict[str, Any] = {}
    for step in STEPS_OUT:
        outside = f"{end - inward * step:.9g}"
        plain, held = pair(data, f"n={outside}{observer}", 2)
        vector = boxes.refutation(held, data, with_gain=True)
        if vector is not None and _survives(plain, data, vector):
            entry["outside"] = {"n": float(outside), "text": f"n={outside}", **vector}
            break
    for step in STEPS_IN:
        within = f"{end + inward * step:.9g}"
        plain, held = pair(data, f"n={within}{observer}", 2)
        if (point := boxes.witness(held, plain, data, steps=5, start=start)) is not None:
            entry["inside"] = {"n": float(within), "text": f"n={within}", **point}
            break
    return entry


def _survives(plain: Problem, data: Any, vector: dict[str, Any]) -> bool:
    """Whether the rounded vector still refutes: too close to the end it does not."""
    try:
        boxes.refute(plain, data, vector)
    except NotProvenError:
        return False
    return True


def arrangements(data: Any) -> dict[str, Any]:
    """Margin of the joint box at n_orbit for every order and sign pattern of the blocks of F, and two simpler F.

    The margin is held off in both first blocks of (14), so that it is finite for every F; its sign decides alike.
    """
    words = ["minus half", "real parts"]
    words += [
        f"order {''.join(map(str, order))} signs {''.join(signs)}"
        for order in permutations(range(3))
        for signs in product("+-", repeat=3)
    ]
    found = {}
    for word in words:
        problem = rendezvous(data, f"n_orbit, {word}, both blocks", margin=True)
        answer = boxes.margin(problem, data, with_gain=True)
        found[word] = {"margin": answer.margin, "words": answer.words}
    survivors = [word for word, entry in found.items() if entry["margin"] is not None and entry["margin"] > 0]
    return {"table": found, "survivors": survivors}
