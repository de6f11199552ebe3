"""The complete problem (38): what solvers say, and the multipliers that contradict (14)."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact import rational
from recontrol.lmi.conditions import condition, maximise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import scalar, symmetric

from .. import conditions
from ..problems import observer, rendezvous


def identity_objective(t: Any) -> Any:
    """t itself."""
    return t


def contradiction(data: Any, F: np.ndarray) -> Problem:
    """Max t with G(Z) >= t I, Z >= 0, trace Z = 1, Z blind to Y: t > 0 contradicts (14) for this F."""
    from .. import model

    p = model.plant(data, data["n_printed"])
    used = [
        condition(conditions.gap),
        condition(conditions.lyapunov, rename={"P": "Z"}),
        condition(conditions.kills_Y),
        condition(conditions.unit_trace),
    ]
    return Problem(
        "contradiction of (14)",
        {"Z": symmetric(12), "t": scalar()},
        used,
        {"A": p["A"], "B": data["m"] * p["B"], "F": F},
        maximise(identity_objective),
        balanced=False,
    )


def observers(data: Any, synthesis_placement: Any) -> dict[str, np.ndarray]:
    """Observer matrices F (6, 6), exact: printed gains, placed gains to six decimals, and two that are not A - LC."""
    from .. import model

    A = model.plant(data, data["n_printed"])["A"]
    found = {name: observer(data, name) for name in ("L_printed", "L_corrected", "minus half", "canonical")}
    for name in ("yang_tits", "varga", "kautsky"):
        L = rational.rounded(np.asarray(synthesis_placement[name]), 6)
        found[name] = A - L @ data["C"]
    return {name: F for name, F in found.items() if F is not None}


def P38(data: Any) -> dict[str, Any]:
    """Solve attempts at (38) for both gains: words only, the finding is the certificate."""
    found = {}
    for gain in ("L_printed", "L_corrected"):
        problem = rendezvous(data, f"n_printed, {gain}", name=f"P38 with {gain}")
        found[gain] = {
            solver: problem.solve(solver, time_limit=20).record() for solver in ("CLARABEL", "CVXOPT", "SDPA")
        }
    return found


def multipliers(data: Any, model: Any) -> dict[str, Any]:
    """t* [1/s] for every observer matrix (positive refutes), and Z for those that are refuted."""
    from .observers import placement

    found: dict[str, Any] = {}
    for name, F in observers(data, placement(data, model)).items():
        solution = contradiction(data, F).solve()
        found[name] = {"t": solution.value, "Z": solution.point["Z"], "words": solution.words}
    return found
