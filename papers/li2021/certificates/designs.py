"""Designs: the optimum of P1 from both sides, the two-step syntheses P4 and P5, and what does not work."""

from __future__ import annotations

from typing import Any

from recontrol.lmi.enclosure import Enclosure, enclose
from recontrol.lmi.proof import prove_feasible, prove_infeasible

from ..problems import theorem
from ..synthesis.nominal import convex
from ..synthesis.steps import TORQUE, first_step


def _nominal(data: Any) -> Enclosure:
    return enclose(convex(data, "1"), says="least gamma^2 of (12) with lambda = 1 over all controllers", digits=7)


def nominal_upper(data: Any) -> dict[str, Any]:
    """P1 at lambda = 1: a controller that reaches this gamma^2."""
    return _nominal(data).upper_certificate


def nominal_lower(data: Any) -> dict[str, Any]:
    """P1 at lambda = 1: no controller goes below."""
    return _nominal(data).lower_certificate


def _at_centre(data: Any, synthesis: Any, kind: str, torque: Any = ()) -> Any:
    found = {"C_f": synthesis["two-step"]["C_f"]}
    return theorem(data, kind, "plant", gains=False, found=found, torque=torque)


def two_step_one_empty(data: Any, synthesis: Any) -> dict[str, Any]:
    """P4: with the paper's two scalars (13) is empty at the central C_f."""
    return prove_infeasible(_at_centre(data, synthesis, "one"), says="(13), two scalars, central C_f: empty")


def two_step_three_empty(data: Any, synthesis: Any) -> dict[str, Any]:
    """P4: with four scalars it is empty at this C_f too."""
    return prove_infeasible(_at_centre(data, synthesis, "three"), says="(13), four scalars, central C_f: empty")


def two_step_design(data: Any, synthesis: Any) -> dict[str, Any]:
    """P4: with diagonal multipliers (13) holds at 5 % drift and gamma = 10."""
    problem = _at_centre(data, synthesis, "diag")
    return prove_feasible(problem, synthesis["two-step"]["point"], says="(13) holds for the two-step design")


def torque_design(data: Any, synthesis: Any) -> dict[str, Any]:
    """P5, C9: (13), (19) and (20 derived) together: the stated problem has a solution."""
    found = synthesis["torque"]["pairs"]["3/20"]
    problem = theorem(data, "diag", "plant;theta=20", gains=False, found={"C_f": found["C_f"]}, torque=TORQUE)
    return prove_feasible(problem, found["point"], says="(13), (19), (20 derived) hold: requirements 1 to 3 are met")


def torque_late_empty(data: Any, synthesis: Any) -> dict[str, Any]:
    """P5: the torque conditions cannot be left to the second step."""
    problem = _at_centre(data, synthesis, "diag", TORQUE)
    return prove_infeasible(
        problem, says="(13), (19), (20 derived), theta = 20: empty at the C_f of the torque-free step"
    )


def first_step_torque_empty(data: Any) -> dict[str, Any]:
    """P5: (lambda, theta) = (1, 20) has no first step at gamma = 10."""
    problem = first_step(data, "plant;e2=0.1;lam=1;theta=20", torque=True)
    return prove_infeasible(problem, says="(SF) with torque, lambda = 1, theta = 20: empty at gamma = 10")
