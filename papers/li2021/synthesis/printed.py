"""P2: the printed gains in (12). Then the torque: which conditions (12), (19), (20) meet, and bounds by ellipsoids."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.lmi.conditions import minimise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import scalar, symmetric

from .. import conditions as c
from ..problems import SN, build, lemma, with_gamma
from .solving import least_gamma, point

THETAS = ("0.3", "0.5", "1", "2", "5", "20")
SHAPES = {"free": ("loop-proposed", False), "structured": ("loop-proposed", True), "ref39": ("loop-ref39", False)}
TORQUE_SETS = {
    "none": (),
    "eq19": (c.eq19,),
    "eq19-eq20-printed": (c.eq19, c.eq20_printed),
    "eq20-derived": (c.eq20_derived,),
}


def least_tau(tau: Any) -> Any:
    """Objective: lambda^2."""
    return tau


def largest_tau(tau: Any) -> Any:
    """Objective: minus lambda^2."""
    return -tau


def _tau_end(problem: Problem, objective: Any) -> float:
    return float(point(replace(problem, objective=minimise(objective)).solve(fast=True))["tau"])


def printed(data: Any) -> dict[str, Any]:
    """Artifact: ``lemma`` (P2 and the curves of figure A), ``torque-sets`` (least gamma), ``bounds`` (torque, N m)."""
    return {
        "lemma": {name: _lemma(data, case, structured) for name, (case, structured) in SHAPES.items()},
        "torque-sets": {name: _with_torque(data, extra) for name, extra in TORQUE_SETS.items()},
        "bounds": {
            "lyapunov": {name: lyapunov_bound(data, f"loop-{name}") for name in ("proposed", "ref39")},
            "lemma4": {theta: _smallest_torque(data, theta) for theta in THETAS},
        },
    }


def _lemma(data: Any, case: str, structured: bool) -> dict[str, Any]:
    gamma, solution = least_gamma(lemma(data, case, structured=structured, best=True, free_tau=True))
    tau = float(solution.point["tau"])
    at_ten = lemma(data, case, structured=structured, free_tau=True)
    low, high = _tau_end(at_ten, least_tau), _tau_end(at_ten, largest_tau)
    wide = lemma(data, f"{case};gamma=1000", structured=structured, free_tau=True)
    lowest = _tau_end(wide, least_tau)
    out = {"gamma": gamma, "tau": tau, "tau-interval": [low, high], "tau-low-1000": lowest}
    if case == "loop-ref39":
        out["gamma-lambda-1"], _ = least_gamma(lemma(data, case, structured=structured, best=True))
    grid = np.exp(np.linspace(np.log(lowest * 1.05), np.log(min(0.9 * high, 1000.0)), 9))
    curve = [least_gamma(lemma(data, f"{case};lam={lam}", structured=structured, best=True))[0] for lam in _texts(grid)]
    return out | {"curve": {"tau": grid, "gamma": curve}}


def _texts(taus: Any) -> list[str]:
    """lambda as decimal text of each tau."""
    return [f"{float(np.sqrt(tau)):.12f}" for tau in taus]


def _with_torque(data: Any, extra: tuple[Any, ...]) -> float:
    variables = with_gamma({**SN, "tau": scalar()})
    problem = build(data, "eq12-torque", "loop-proposed", [c.eq12_structured, *extra], variables, best=True)
    return least_gamma(problem)[0]


def lyapunov_problem(data: Any, case: str) -> Problem:
    """Least ``xi0' P xi0`` of a decreasing P that covers the torque; exact data."""
    problem = build(data, "torque-bound", case, [c.torque_decay, c.torque_cover], {"P": symmetric(12)})
    from ..problems import problem_data

    xi0 = problem_data(data, case)["xi0"]
    return replace(problem, data={**problem.data, "xi0": xi0}, objective=minimise(c.torque_level))


def lyapunov_bound(data: Any, case: str) -> float:
    """Torque bound [N m] for the initial state of Table 1, rigid loop, no disturbance, no drift."""
    solution = lyapunov_problem(data, case).solve(fast=True)
    point(solution)
    return float(np.sqrt(solution.value))


def _smallest_torque(data: Any, theta: str) -> float:
    variables = {**SN, "tau": scalar(), "u2": scalar()}
    problem = build(
        data, "lemma4", f"loop-proposed;theta={theta}", [c.eq12_structured, c.eq19, c.eq20_derived], variables
    )
    solution = replace(problem, objective=minimise(squared_torque)).solve(fast=True)
    return float(np.sqrt(point(solution)["u2"]))


def squared_torque(u2: Any) -> Any:
    """Objective: u_max^2."""
    return u2
