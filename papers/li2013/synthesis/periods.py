"""Largest period and decay rate that each condition admits, block by block, beside the exact periodic limits."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.exact.ball import precision
from recontrol.systems import sampled

from .. import conditions as c
from .. import problems as pr
from ..sweeps import DECOMPOSED, SweepError, call, floats, margin, run, search, values_of

WIDTH_H, WIDTH_ALPHA = 1e-3, 1e-4  # s, 1/s


def baseline(data: Any, block: str, h: float, orbit: str = "w-print") -> float:
    """Margin of the time-independent condition at the period h (natural units, tr P = n, no cap)."""
    import cvxpy

    v = floats(data, f"block={block}")
    scale = 1 / np.sqrt(np.diag(v["unit"]))
    n = len(scale)
    A, B, K = v[pr.ORBITS[orbit]] * scale / scale[:, None], v["B"] / scale[:, None], v["K"] * scale
    t, P, R = cvxpy.Variable(), cvxpy.Variable((n, n), symmetric=True), cvxpy.Variable((n, n), symmetric=True)
    free = {name: cvxpy.Variable((n, n)) for name in ("T1", "T2", "T3")}
    bound = {"P": P, "R": R, **free, "A": A, "B": B, "K": K, "h": h}
    M = call(c.time_independent, bound)
    constraints = [(M + M.T) / 2 + t * np.eye(3 * n) << 0, P - t * np.eye(n) >> 0, R - t * np.eye(n) >> 0]
    model = cvxpy.Problem(cvxpy.Maximize(t), [*constraints, cvxpy.trace(P) == n])
    values = values_of(model, run(model))
    point = {key: values[x.id] if hasattr(x, "id") else x for key, x in bound.items()}
    N = call(c.time_independent, point)
    ends = [-np.linalg.eigvalsh((N + N.T) / 2)[-1], *(np.linalg.eigvalsh(point[k])[0] for k in "PR")]
    return float(min(ends))


def exact_limits(data: Any, orbit: str) -> dict[str, Any]:
    """Per block and rate: bracket of the largest period of exact periodic sampling, proven by balls at both ends."""
    out: dict[str, Any] = {}
    for block in DECOMPOSED:
        exact = pr.exact_data(data, f"block={block}")
        G = exact["B"] @ exact["K"]
        for name, alpha in (("a0", fmpq(0)), ("a02", data["alpha"])):
            with precision(160):
                found = sampled.largest_period(exact[pr.ORBITS[orbit]], G, alpha, start=0.1, stop=6.0, width=1e-9)
            ends = [float(rational.to_float(end)) for end in (found.low, found.high)]
            out.setdefault(block, {})[name] = {"low": ends[0], "high": ends[1], "proven": found.proven}
    return out


def _largest_h(data: Any, block: str, alpha: str, stop: float, **options: Any) -> dict[str, float]:
    def good(h: float) -> float:
        return margin(
            data, f"units=si alpha={alpha} h={h!r}", "w-print", c.DERIVED, blocks=(block,), capped=False, **options
        ).value

    return search(good, 0.5, stop, WIDTH_H)


def periods(data: Any) -> dict[str, Any]:
    """exact: orbit -> block -> rate -> bracket; h_max: condition -> block -> bracket; alpha_max: block -> bracket.

    Conditions: derived-a0, derived-a02, no-P3 (alpha = 0, P_3 = 0), time-independent (alpha = 0). Every bracket has
    its starting interval: 0.5 s (0.02 1/s) to the exact periodic limit, beyond which no condition can hold.
    """
    exact = {orbit: exact_limits(data, orbit) for orbit in pr.ORBITS}
    limits = exact["w-print"]
    h_max: dict[str, dict[str, Any]] = {}
    alpha_max: dict[str, Any] = {}
    for block in DECOMPOSED:
        stop = {name: limits[block][name]["high"] for name in ("a0", "a02")}
        h_max.setdefault("derived-a0", {})[block] = _largest_h(data, block, "0", stop["a0"])
        h_max.setdefault("derived-a02", {})[block] = _largest_h(data, block, "0.02", stop["a02"])
        h_max.setdefault("no-P3", {})[block] = _largest_h(data, block, "0", stop["a0"], drop_P3=True)
        h_max.setdefault("time-independent", {})[block] = search(
            lambda h, block=block: baseline(data, block, h), 0.5, stop["a0"], WIDTH_H
        )
        alpha_max[block] = search(
            lambda a, block=block: (
                margin(data, f"units=si alpha={a!r}", "w-print", c.DERIVED, blocks=(block,), capped=False).value
            ),
            0.02,
            _exact_rate(data, block) + 1e-3,
            WIDTH_ALPHA,
        )
    return {"exact": exact, "h_max": h_max, "alpha_max": alpha_max}


def _exact_rate(data: Any, block: str) -> float:
    v = floats(data, f"block={block}")
    rate = sampled.decay_rate(v["A_print"], v["B"] @ v["K"], v["h"])
    if rate <= 0:
        raise SweepError(f"block {block}: the loop is unstable")
    return float(rate)
