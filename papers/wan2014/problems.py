"""The paper's matrix-inequality problems with exact data, and the units that make them solvable.

A case is a text of words joined by ", ": a mean motion (n_printed, n_orbit, ...), an observer (L_printed, L_corrected,
canonical, or an arrangement "order 102 signs +-+"), an e(0). `source` rebuilds the data of any case from paper.yaml.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.exact.rational import diagonal, identity
from recontrol.lmi.conditions import Condition, condition, maximise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import diagonal as diagonal_variable
from recontrol.lmi.variables import full, repeated, scalar, symmetric

from . import conditions, model

SOURCE = "papers.wan2014.problems:source"
AXES = "xyz"


class Scale:
    """Units from the problem data alone: length of the start, thrust over mass, limits; rational, no square root."""

    length = fmpq(5000)  # m, norm(r(0)) = 5000.04
    rate = fmpq(1, 158)  # 1/s, sqrt(u_x/(m length)) = 1/158.1
    cost = length * length / rate
    state = [length] * 3 + [length * rate] * 3
    multiplier = fmpq(200) ** 2 / cost

    @classmethod
    def units(cls, limit: np.ndarray) -> dict[str, Any]:
        """Units of X, Y, eps, r and of the box unknowns, from the thrust limits (1, 3)."""
        thrust = list(limit[0])
        return {
            "X": ([s / cls.cost for s in cls.state], cls.state),
            "Y": ([u / cls.cost for u in thrust], cls.state),
            "S": ([u / cls.cost for u in thrust], cls.state),
            "W": (thrust, [1 / s for s in cls.state]),
            "eps": ([cls.multiplier] * 6, [fmpq(1)] * 6),
            "r": 1 / cls.cost,
            "mu": cls.rate,
        }


def observer(data: Any, word: str) -> np.ndarray | None:
    """Matrix F (6, 6) of the observer error named by one word of a case."""
    if word in ("L_printed", "L_corrected"):
        n = data["n_printed"]
        return model.plant(data, n)["A"] - data[word] @ data["C"]
    if word == "canonical":
        return model.canonical_observer(data)
    if word == "minus half":
        return fmpq(-1, 2) * identity(6)
    if word == "real parts":
        F = model.canonical_observer(data)
        return diagonal(F.diagonal())
    if word.startswith("order "):
        _, order, _, signs = word.split()
        return model.canonical_observer(data, tuple(map(int, order)), tuple(1 if s == "+" else -1 for s in signs))
    return None


def source(data: Any, case: str) -> dict[str, Any]:
    """Every datum of the problems of this paper for one case (see the head of this module)."""
    motions, starts = model.mean_motions(data), model.initial_errors(data)
    found: dict[str, Any] = {"Qi": identity(6), "Ri": identity(3), "x0": data["x0"]}
    found |= {"cost_unit": Scale.cost, "time_unit": 1 / Scale.rate}
    found |= {f"limit_{axis}": data["u_max"][0, i] for i, axis in enumerate(AXES)}
    found |= {"K0": data["K"], "X0": data["X"], "D": _margin_weight(data["X"], both="both blocks" in case)}
    found |= {
        "left": diagonal([Scale.cost / u for u in data["u_max"][0]]),
        "right": diagonal([1 / s for s in Scale.state]),
    }
    found |= print_boxes(data)
    for word in case.split(", "):
        if word in motions or word.startswith("n="):
            found |= model.plant(data, motions[word] if word in motions else rational.decimal(word[2:]))
        elif word in starts:
            found["xi0"] = np.vstack([data["x0"], starts[word]])
        elif (F := observer(data, word)) is not None:
            found["F"] = F
    return found


def print_boxes(data: Any) -> dict[str, Any]:
    """Rounding boxes of the printed X, Y, K, by "box of V"; of W = K - K0, and of S = W (X - X0): abs(S) <= hK hX."""
    found = {f"box of {v}": (data[v] - data.half(v), data[v] + data.half(v)) for v in "XYK"}
    reach = data.half("K") @ data.half("X")
    return found | {"box of W": (-data.half("K"), data.half("K")), "box of S": (-reach, reach)}


def _margin_weight(X: np.ndarray, *, both: bool) -> np.ndarray:
    first = list(X.diagonal())
    return diagonal(first + (first if both else [fmpq(0)] * 6))


def scaled_reciprocal(r: Any, cost_unit: Any) -> Any:
    """cost_unit / rho, of order one: the objective of (38) turned into a maximum."""
    return cost_unit * r


def decay_margin(mu: Any, time_unit: Any) -> Any:
    """Margin mu [1/s] in scaled units."""
    return time_unit * mu


def rendezvous(
    data: Any,
    case: str,
    *,
    count: int = 2,
    kappa: int = 2,
    saturated: bool = True,
    nominal: bool = False,
    margin: bool = False,
    spread: bool = False,
    name: str = "",
) -> Problem:
    """Maximise r = 1/rho over X, Y, eps: (14) (or its state part if the case names no observer), (30), (31).

    count: how often R is counted; kappa: 2 as printed or 1; saturated: with (31); nominal: e = 0; margin: maximise the
    margin mu of (14) instead of r; spread: one multiplier for each channel instead of eps I.
    """
    values = source(data, case)
    with_observer, with_start = "F" in values, "xi0" in values
    if nominal:
        first: Any = condition(conditions.eq14_nominal, count=count)
    elif margin:
        first = condition(conditions.eq14_margin if with_observer else conditions.eq14_state_margin, count=count)
    else:
        first = condition(conditions.eq14 if with_observer else conditions.eq14_state, count=count)
    start = condition(conditions.eq30 if with_start else conditions.eq30_state)
    limits = [
        condition(conditions.eq31, f"eq31_{a}", rename={"limit": f"limit_{a}"}, axis=i, kappa=kappa)
        for i, a in enumerate(AXES)
    ]
    used: list[Condition] = [first, start, *(limits if saturated else [])]
    variables = {"X": symmetric(6), "Y": full(3, 6), "r": scalar()}
    if not nominal:
        variables["eps"] = diagonal_variable(6) if spread else repeated([6])
    if margin:
        variables["mu"] = scalar()
    units = Scale.units(data["u_max"])
    needed = {argument for c in used for argument in c.arguments().values()} | {"cost_unit", "time_unit"}
    return Problem(
        name or f"{'CO' if with_observer else 'SF'}, R{count}, kappa {kappa}",
        variables,
        used,
        {k: v for k, v in values.items() if k in needed},
        maximise(decay_margin if margin else scaled_reciprocal),
        {k: units[k] for k in variables},
        paper="wan2014",
        case=case,
        source=SOURCE,
    )


def boxed(data: Any, problem: Problem, *, with_gain: bool) -> Problem:
    """The problem with X and Y in the rounding boxes of the print; with_gain: Y = K X for some K in its box, relaxed.

    W = K - K0 and S = W (X - X0), which is only asked to lie in its box abs(S) <= hK hX: a superset of the truth.
    """
    given = print_boxes(data)
    boxes = {v: given[f"box of {v}"] for v in "XY"}
    if not with_gain:
        return replace(problem, boxes=boxes)
    boxes |= {v: given[f"box of {v}"] for v in "WS"}
    values, units = source(data, problem.case), Scale.units(data["u_max"])
    link = condition(conditions.product_gap)
    return replace(
        problem,
        variables={**problem.variables, "W": full(3, 6), "S": full(3, 6)},
        conditions=[*problem.named, link],
        data={**problem.data, **{k: values[k] for k in ("K0", "X0", "left", "right")}},
        units={**problem.units, "W": units["W"], "S": units["S"]},
        boxes=boxes,
    )


def linked(plain: Problem, data: Any) -> Problem:
    """The problem with X, Y and K in their rounding boxes and Y = K X exactly; for points, not for multipliers."""
    boxes = {v: print_boxes(data)[f"box of {v}"] for v in "XYK"}
    tie = condition(conditions.product)
    return replace(plain, variables={**plain.variables, "K": full(3, 6)}, conditions=[*plain.named, tie], boxes=boxes)
