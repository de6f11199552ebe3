"""The same problems in SI units, unscaled, given to each solver: how much the units matter."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from recontrol.lmi.conditions import condition, minimise
from recontrol.lmi.variables import scalar

from .. import conditions
from ..problems import rendezvous
from .gains import COST_UNIT, SCS_OPTIONS, rho, scaled_w

SOLVERS = ("CLARABEL", "CVXOPT", "SDPA", "SCS")


def units_matter(data: Any) -> dict[str, Any]:
    """SF and (38), max r and min w, in SI units without any scaling: words and rho by solver."""
    found: dict[str, Any] = {}
    for name, case in (("SF", "n_printed"), ("P38", "n_printed, L_corrected")):
        plain = replace(rendezvous(data, case), units={}, balanced=False)
        written = replace(
            plain,
            variables={**plain.variables, "w": scalar()},
            conditions=[*plain.named, condition(conditions.eq37)],
            objective=minimise(scaled_w),
        )
        for goal, problem in (("max r", plain), ("min w", written)):
            for solver in SOLVERS:
                options = {**SCS_OPTIONS} if solver == "SCS" else {}
                answer = problem.solve(solver, time_limit=10, **options)
                if goal == "max r":
                    value = rho(answer) if answer.value and answer.value > 0 else None
                else:
                    value = answer.value * COST_UNIT if answer.value else None
                found[f"{name}, {goal}, {solver}"] = {
                    "words": answer.words,
                    "outcome": answer.outcome,
                    "reason": answer.reason,
                    "rho": value,
                }
    return found
