"""Theorems 1 and 2: (17) is empty, (13) excludes the printed C_f, and how much drift (13) grants the printed gains.

Infeasibility with diagonal multipliers covers every special case of them (one or three scalars, fixed ones), that of
free A_f, B_f covers given ones. (13) at a drift bound is a convex combination of (13) at larger ones of either sign,
so a point at one bound serves every smaller one, and an empty set stays empty for every larger one.
"""

from __future__ import annotations

from typing import Any

from recontrol.lmi.conditions import condition
from recontrol.lmi.proof import prove_feasible, prove_infeasible
from recontrol.lmi.variables import full, symmetric

from .. import conditions as c
from ..problems import GAINS, SN, STATE_FEEDBACK, build, theorem

# Found by bisection on the largest margin of (13); each end is proven.
DRIFT_LIMITS = {"one": ("0.0039", "0.0040"), "three": ("0.0292", "0.0293"), "diag": ("0.0348", "0.0352")}


def eq17_empty(data: Any) -> dict[str, Any]:
    """C1: rows 1-1 and 5-1 of (17) alone contradict each other, in every reading and for all other unknowns."""
    problem = build(data, "eq17-minor", "plant", [c.eq17_minor], {"S": symmetric(6)})
    return prove_infeasible(problem, says="(17) has no solution for this plant, whatever the scalars and the reading")


def eq17_control(data: Any) -> dict[str, Any]:
    """C1, control: with the radius 2 in place of 1 the same code finds (17) strictly feasible."""
    whole = condition(c.eq17, on="C", columns=6)
    variables = {**SN, **GAINS, "C_f": full(3, 6)}
    problem = build(data, "eq17", "plant;b=2;e2=0.1", [whole, c.shape_S, c.shape_N], variables)
    return prove_feasible(problem, problem.solve(), says="(17) with the disk D(1.01, 2) is feasible")


def _first_step(data: Any, case: str) -> Any:
    return build(data, "state-feedback", case, [c.state_feedback], STATE_FEEDBACK)


def sf_r1_empty(data: Any) -> dict[str, Any]:
    """C2: (SF), reading R1, scalars of Table 1, so (13) has no point for any controller."""
    return prove_infeasible(_first_step(data, "plant"), says="no controller satisfies (13), R1, scalars of Table 1")


def sf_r1_lambda3_empty(data: Any) -> dict[str, Any]:
    """C2 at lambda = 3."""
    return prove_infeasible(_first_step(data, "plant;lam=3"), says="no controller satisfies (13), R1, lambda = 3")


def sf_r1_lambda10(data: Any) -> dict[str, Any]:
    """C2 at lambda = 10: nearly marginal, but feasible."""
    problem = _first_step(data, "plant;lam=10")
    return prove_feasible(problem, problem.solve(), decimals=14, says="(SF), R1, lambda = 10 is feasible")


def sf_r2(data: Any) -> dict[str, Any]:
    """C2: (SF), reading R2, scalars of Table 1 has a point; whether (13) has one stays open."""
    problem = _first_step(data, "plant;e2=0.1")
    return prove_feasible(problem, problem.solve(), says="(SF), R2, scalars of Table 1 is feasible")


def _fixed(data: Any, case: str) -> Any:
    """(13) at the printed C_f with the scalars of Table 1."""
    return build(data, "eq13-fixed", case, [c.eq13], {**SN, **GAINS})


def gain_r1_empty(data: Any) -> dict[str, Any]:
    """C3: printed C_f, any A_f and B_f, scalars of Table 1, reading R1."""
    return prove_infeasible(_fixed(data, "proposed"), says="(13), R1, Table 1: no A_f, B_f go with the printed C_f")


def gain_r2_empty(data: Any) -> dict[str, Any]:
    """C3: the same in reading R2."""
    says = "(13), R2, Table 1: no A_f, B_f go with the printed C_f"
    return prove_infeasible(_fixed(data, "proposed;e2=0.1"), says=says)


def gain_diag_empty(data: Any) -> dict[str, Any]:
    """C3: printed C_f, any A_f, B_f, lambda and diagonal multipliers, gamma = 10."""
    says = "(13) with any lambda and any diagonal multipliers: no A_f, B_f go with the printed C_f at 5 % drift"
    return prove_infeasible(theorem(data, "diag", "proposed", gains=False), says=says)


def _drift(data: Any, kind: str, end: int) -> Any:
    return theorem(data, kind, f"proposed;delta_m={DRIFT_LIMITS[kind][end]}", gains=True)


def _below(data: Any, kind: str) -> dict[str, Any]:
    problem = _drift(data, kind, 0)
    return prove_feasible(problem, problem.solve(), says=f"(13), {kind}: the printed gains are a point at this drift")


def _above(data: Any, kind: str) -> dict[str, Any]:
    says = f"(13), {kind}: the printed gains are no point from this drift on"
    return prove_infeasible(_drift(data, kind, 1), decimals=14, says=says)


def drift_one_below(data: Any) -> dict[str, Any]:
    """C5: two scalars, lambda free: feasible at this drift and every smaller one."""
    return _below(data, "one")


def drift_one_above(data: Any) -> dict[str, Any]:
    """C5: two scalars: empty at this drift and every larger one."""
    return _above(data, "one")


def drift_three_below(data: Any) -> dict[str, Any]:
    """Four scalars: feasible up to here."""
    return _below(data, "three")


def drift_three_above(data: Any) -> dict[str, Any]:
    """Four scalars: empty from here."""
    return _above(data, "three")


def drift_diag_below(data: Any) -> dict[str, Any]:
    """C5: diagonal multipliers: feasible up to here."""
    return _below(data, "diag")


def drift_diag_above(data: Any) -> dict[str, Any]:
    """Diagonal multipliers: empty from here."""
    return _above(data, "diag")
