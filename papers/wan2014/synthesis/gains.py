"""The problems that have solutions: SF (no observer block) and CO (canonical observer), their variants, fixed gains."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.exact import rational
from recontrol.lmi.conditions import condition, maximise, minimise
from recontrol.lmi.problem import Problem, Solution, agreement
from recontrol.lmi.variables import repeated, scalar, symmetric

from .. import conditions
from ..boxes import Print
from ..problems import AXES, SOURCE, Scale, rendezvous, source

COST_UNIT = float(rational.to_float(Scale.cost))
IN_PLANE = np.ix_([0, 1], [0, 1, 3, 4])
SCS_OPTIONS = {"max_iters": 5_000, "eps": 1e-7}
SLACK = "1.002"


def rho(solution: Solution) -> float | None:
    """Guaranteed cost of a solution, in the paper's unit."""
    return None if not solution.value else COST_UNIT / solution.value


def summary(data: Any, solution: Solution) -> dict[str, Any]:
    """rho, eps, X, Y, K of a solution and the distance of every entry to the print in units of its last place."""
    if not solution.has_point:
        return {"record": solution.record()}
    p, X, Y = Print.of(data), solution.point["X"], solution.point["Y"]
    K = np.linalg.solve(X, Y.T).T
    return {
        "rho": rho(solution),
        "eps": float(solution.point["eps"][0, 0]) if "eps" in solution.point else None,
        "X": X,
        "Y": Y,
        "K": K,
        "margins": solution.margins,
        "units_from_print": {
            "X": (X - p.X) / (2 * p.hX),
            "Y": (Y - p.Y) / (2 * p.hY),
            "K": (K - p.K) / (2 * p.hK),
        },
    }


def several(problem: Problem) -> tuple[Solution, dict[str, Any]]:
    """The CLARABEL solution, and what three interior-point solvers and a first-order one say about rho."""
    found = [problem.solve(solver) for solver in ("CLARABEL", "CVXOPT", "SDPA")]
    found.append(problem.solve("SCS", time_limit=10, **SCS_OPTIONS))
    table = agreement(found)
    table["rho"] = {s.solver: rho(s) for s in found}
    return found[0], table


def corner(X: Any, unit: Any) -> Any:
    """X33 in scaled units."""
    return unit * X[2:3, 2:3]


def range_of_X33(data: Any, problem: Problem, best: float) -> dict[str, Any]:
    """Smallest and largest X33 with rho <= 1.002 rho*, and K there."""
    floor = rational.rounded(best / float(SLACK), 12) / Scale.cost
    unit = Scale.cost / Scale.length**2
    limited = [*problem.named, condition(conditions.at_least)]
    found: dict[str, Any] = {}
    for name, sense in (("low", minimise), ("high", maximise)):
        bounded = replace(
            problem, conditions=limited, data={**problem.data, "floor": floor, "unit": unit}, objective=sense(corner)
        )
        solution = bounded.solve()
        found[name] = {"X33": float(solution.point["X"][2, 2]), "K": summary(data, solution)["K"]}
    return found


def minimum_w(data: Any) -> dict[str, Any]:
    """(38) as written, min w with (37), for SF with R twice."""
    problem = rendezvous(data, "n_printed")
    written = replace(
        problem,
        variables={**problem.variables, "w": scalar()},
        conditions=[*problem.named, condition(conditions.eq37)],
        objective=minimise(scaled_w),
        units={**problem.units, "w": Scale.cost},
    )
    solution = written.solve()
    return {"w": float(solution.point["w"]) if solution.has_point else None, "record": solution.record()}


def scaled_w(w: Any, cost_unit: Any) -> Any:
    """w over the unit of cost."""
    return w / cost_unit


def SF(data: Any) -> dict[str, Any]:
    """State part of (14) at the printed mean motion, R twice and once; range of X33; min w once."""
    found: dict[str, Any] = {}
    for count in (2, 1):
        problem = rendezvous(data, "n_printed", count=count)
        solution, table = several(problem)
        found[f"R{count}"] = summary(data, solution) | {"solvers": table}
        if count == 2:
            found["X33"] = range_of_X33(data, problem, float(solution.value or 0))
    return found | {"min_w": minimum_w(data)}


def CO(data: Any) -> dict[str, Any]:
    """Complete (14) with the canonical observer at both mean motions, R twice and once; range of X33."""
    found: dict[str, Any] = {}
    for motion in ("n_orbit", "n_printed"):
        for count in (2, 1):
            problem = rendezvous(data, f"{motion}, canonical", count=count)
            solution, table = several(problem)
            found[f"{motion}_R{count}"] = summary(data, solution) | {"solvers": table}
            if (motion, count) == ("n_orbit", 2):
                found["X33"] = range_of_X33(data, problem, float(solution.value or 0))
    return found


def variants(data: Any) -> dict[str, Any]:
    """SF with one change each: rho, and the largest relative difference of the eight in-plane gains to the baseline."""
    changed: dict[str, Problem] = {
        "baseline": rendezvous(data, "n_printed"),
        "n_orbit": rendezvous(data, "n_orbit"),
        "n_circular": rendezvous(data, "n_circular"),
        "e_zero": rendezvous(data, "n_printed", nominal=True),
        "e0_velocity": rendezvous(data, "n_printed, e0_velocity"),
        "e0_full": rendezvous(data, "n_printed, e0_full"),
        "e0_full_kappa1": rendezvous(data, "n_printed, e0_full", kappa=1),
        "kappa1": rendezvous(data, "n_printed", kappa=1),
        "kappa1_R1": rendezvous(data, "n_printed", kappa=1, count=1),
        "diagonal_multiplier": rendezvous(data, "n_printed", spread=True),
    }
    found = {name: summary(data, problem.solve()) for name, problem in changed.items()}
    base = found["baseline"]
    for entry in found.values():
        if "K" in entry:
            entry["rho_ratio"] = entry["rho"] / base["rho"]
            entry["gain_change"] = float(np.abs(entry["K"][IN_PLANE] / base["K"][IN_PLANE] - 1).max())
    return found


def fixed(data: Any) -> dict[str, Any]:
    """rho(K) of SF with the gain given: K printed, and K = Y X^-1 of the printed decimals; with and without (31)."""
    X, Y = data["X"], data["Y"]
    from recontrol.exact import linalg

    gains = {"printed": data["K"], "K_YX": linalg.solve(X, Y.T).T}
    found: dict[str, Any] = {}
    values, units = source(data, "n_printed"), Scale.units(data["u_max"])
    for name, K in gains.items():
        for limited in (True, False):
            used = [condition(conditions.fixed_gain, count=2), condition(conditions.eq30_state)]
            if limited:
                used += [
                    condition(conditions.fixed_limit, f"limit_{a}", rename={"limit": f"limit_{a}"}, axis=i, kappa=2)
                    for i, a in enumerate(AXES)
                ]
            needed = {argument for c in used for argument in c.arguments().values()} | {"cost_unit"}
            problem = Problem(
                f"SF with K {name}",
                {"X": symmetric(6), "eps": repeated([6]), "r": scalar()},
                used,
                {k: v for k, v in {**values, "K": K}.items() if k in needed},
                maximise(_reciprocal),
                {k: units[k] for k in ("X", "eps", "r")},
                paper="wan2014",
                case="n_printed",
                source=SOURCE,
            )
            solution = problem.solve()
            key = f"{name}{'' if limited else '_no_limit'}"
            found[key] = {"rho": rho(solution) if solution.has_point else None, "record": solution.record()}
    return found


def _reciprocal(r: Any, cost_unit: Any) -> Any:
    return cost_unit * r
