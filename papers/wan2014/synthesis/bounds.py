"""Bounds of the repaired analysis for the printed gains and for the gains of SF and CO."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact import rational

from ..problems import AXES, rendezvous
from ..repaired import cost_problem, loop_data, source, thrust_problem
from .gains import COST_UNIT, summary

CASES = ("e0_zero", "e0_velocity", "e0_full")


def limits(data: Any) -> dict[str, float]:
    """Largest thrust by axis [N]."""
    return dict(zip(AXES, data.float("u_max")[0].tolist(), strict=True))


def repaired(data: Any) -> dict[str, Any]:
    """Cost bounds (P block, full; D scalar, diagonal) and thrust bounds [N] for three e(0); the paper's P fails."""
    cost, thrust = {}, {}
    for case in CASES:
        name = f"L_corrected, {case}"
        for shape in ("block", "full"):
            for spread in (False, True):
                problem = cost_problem(data, name, shape=shape, spread=spread)
                solvers = ("CLARABEL", "SDPA") if spread else ("CLARABEL",)
                found = {solver: problem.solve(solver) for solver in solvers}
                key = f"{case}_{shape}_{'diagonal' if spread else 'scalar'}"
                cost[key] = {
                    "bound": found["CLARABEL"].value * COST_UNIT if found["CLARABEL"].value else None,
                    "solvers": {s: {"value": f.value, "outcome": f.outcome} for s, f in found.items()},
                }
        for axis, limit in limits(data).items():
            solution = thrust_problem(data, name, axis).solve(margin="1e-7")
            thrust[f"{case}_{axis}"] = limit * float(np.sqrt(solution.value)) if solution.value else None
    same = cost_problem(data, "L_corrected, e0_zero", shape="same", spread=True).solve()
    return {"cost": cost, "thrust": thrust, "same": {"outcome": same.outcome, "words": same.words}}


def bounds_of_gain(data: Any, K: np.ndarray) -> dict[str, Any]:
    """Cost and thrust bounds with another gain, P block, D diagonal, L corrected."""
    exact = rational.rounded(np.asarray(K), 9)
    found: dict[str, Any] = {}
    for case in CASES[:2]:
        values = source(data, f"L_corrected, {case}") | loop_data(data, exact, data["L_corrected"])
        problem = cost_problem(data, f"L_corrected, {case}", shape="block", spread=True, values=values)
        solution = problem.solve()
        found[case] = {"cost": solution.value * COST_UNIT if solution.value else None}
        for axis, limit in limits(data).items():
            answer = thrust_problem(data, f"L_corrected, {case}", axis, values=values).solve(margin="1e-7")
            found[case][axis] = limit * float(np.sqrt(answer.value)) if answer.value else None
    return found


def other_gains(data: Any) -> dict[str, Any]:
    """The same bounds for the gains of SF, CO and SF with kappa = 1, R once."""
    problems = {
        "K_SF": rendezvous(data, "n_printed"),
        "K_CO": rendezvous(data, "n_orbit, canonical"),
        "K_kappa1": rendezvous(data, "n_printed", kappa=1, count=1),
    }
    return {name: bounds_of_gain(data, summary(data, problem.solve())["K"]) for name, problem in problems.items()}
