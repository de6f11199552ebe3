"""The repaired analysis of the printed gains: stability, cost, thrust, each at a rational Lyapunov matrix."""

from __future__ import annotations

from typing import Any

from recontrol.lmi import loops, proof
from recontrol.lmi.enclosure import bound_by_point

from .. import model, repaired
from ..problems import Scale


def stable(data: Any, gain: str) -> dict[str, Any]:
    """Cost inequality with P > 0: the loop is stable for every admissible uncertainty of (3)."""
    problem = repaired.stability_problem(data, gain)
    says = f"the printed loop with {gain} is stable for every uncertainty diag(Lambda), abs <= 1"
    return proof.prove_feasible(problem, problem.solve(margin="1e-5"), says=says)


def stable_L_printed(data: Any) -> dict[str, Any]:
    return stable(data, "L_printed")


def stable_L_corrected(data: Any) -> dict[str, Any]:
    return stable(data, "L_corrected")


def cost(data: Any, case: str) -> dict[str, Any]:
    """Upper bound of J over the unit of cost, P block, D diagonal, L corrected."""
    problem = repaired.cost_problem(data, f"L_corrected, {case}", shape="block", spread=True)
    says = f"J of the linear loop over the unit of cost, {case}"
    return bound_by_point(problem, problem.solve(margin="1e-8").point, says=says)[1]


def cost_e0_zero(data: Any) -> dict[str, Any]:
    return cost(data, "e0_zero")


def cost_e0_velocity(data: Any) -> dict[str, Any]:
    return cost(data, "e0_velocity")


def cost_e0_full(data: Any) -> dict[str, Any]:
    return cost(data, "e0_full")


def thrust(data: Any, case: str, axis: str) -> dict[str, Any]:
    """Upper bound of the squared thrust of one axis over its limit: below 1 the limit is never reached."""
    problem = repaired.thrust_problem(data, f"L_corrected, {case}", axis)
    says = f"squared thrust over its limit, axis {axis}, {case}"
    return bound_by_point(problem, problem.solve(margin="1e-7").point, says=says)[1]


def thrust_e0_zero_x(data: Any) -> dict[str, Any]:
    return thrust(data, "e0_zero", "x")


def thrust_e0_zero_y(data: Any) -> dict[str, Any]:
    return thrust(data, "e0_zero", "y")


def thrust_e0_zero_z(data: Any) -> dict[str, Any]:
    return thrust(data, "e0_zero", "z")


def thrust_e0_velocity_x(data: Any) -> dict[str, Any]:
    return thrust(data, "e0_velocity", "x")


def thrust_e0_velocity_y(data: Any) -> dict[str, Any]:
    return thrust(data, "e0_velocity", "y")


def thrust_e0_velocity_z(data: Any) -> dict[str, Any]:
    return thrust(data, "e0_velocity", "z")


def box_source(data: Any, case: str) -> dict[str, Any]:
    """M0, and the box M0 + E D F of A - BK (case K) or A - LC over the rounding box of the gain, at n_printed."""
    p = model.plant(data, data["n_printed"])
    E, F = loops.entry_box(data.half(case))
    if case == "K":
        return {"M": p["A"] - p["B"] @ data["K"], "E": -p["B"] @ E, "F": F}
    return {"M": p["A"] - data[case] @ data["C"], "E": -E, "F": F @ data["C"]}


def box_stable(data: Any, case: str, units: Any = 1) -> dict[str, Any]:
    """Stability for every entry anywhere in its box."""
    context = {"paper": "wan2014", "case": case, "source": "papers.wan2014.certificates.analysis:box_source"}
    says = f"stable for every {case} in its rounding box"
    return loops.prove_box_stable(**box_source(data, case), units=units, name=f"box of {case}", says=says, **context)


def box_K(data: Any) -> dict[str, Any]:
    return box_stable(data, "K", Scale.state)


def box_L_printed(data: Any) -> dict[str, Any]:
    return box_stable(data, "L_printed")


def box_L_corrected(data: Any) -> dict[str, Any]:
    return box_stable(data, "L_corrected")
