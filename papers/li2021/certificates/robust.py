"""C8: robustness of the printed gains by scaled inequalities, and a torque bound by a plain Lyapunov function."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.exact.rational import to_float
from recontrol.lmi.conditions import condition
from recontrol.lmi.enclosure import bound_by_point
from recontrol.lmi.loops import definite
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import prove_feasible

from .. import conditions as c
from ..problems import build
from ..synthesis.printed import lyapunov_problem
from ..synthesis.robustness import disk_problem, hinf_problem
from ..synthesis.solving import point

INERTIA_MULTIPLIER = 0.1  # for the tiny channels of Delta H, beside P <= I


def _with(problem: Problem, *names: str) -> Problem:
    """The problem and the condition that its named unknowns are positive definite."""
    extra = [condition(definite, f"{name} > 0", rename={"P": name}) for name in names]
    return replace(problem, conditions=[*problem.named, *extra])


def disk_drift(data: Any, synthesis: Any) -> dict[str, Any]:
    """Every frozen gain drift up to 5 % with every Delta H keeps the poles in D(1.01, 1)."""
    found = synthesis["scaled"]["disk"]
    problem = _with(disk_problem(data, "gains-H-proposed"), "P", "Lam")
    count = problem.variables["Lam"].size
    Lam = np.diag(np.concatenate([np.diag(found["Lam"]), np.full(count - len(found["Lam"]), INERTIA_MULTIPLIER)]))
    says = "all poles stay in D(1.01, 1) for every gain drift up to 5 % and every Delta H"
    return prove_feasible(problem, {"P": found["P"], "Lam": Lam}, says=says)


def hinf_drift(data: Any) -> dict[str, Any]:
    """H-infinity norm below 1.36 for all gain drift up to 5 %, Delta H and Delta J, however they vary in time."""
    case = "all-proposed;gamma=1.36"
    variables = {k: v for k, v in hinf_problem(data, case).variables.items() if k != "gamma2"}
    problem = build(data, "scaled-hinf", case, [c.robust_hinf], variables)
    problem = _with(replace(problem, units={"P": "10"}), "P", "Lam")
    says = "the H-infinity norm stays below 1.36 for all gain drift up to 5 %, Delta H and Delta J, at any speed"
    return prove_feasible(problem, problem.solve(), says=says)


def torque_bound(data: Any) -> dict[str, Any]:
    """The torque of the rigid undisturbed loop never exceeds the square root of this bound [N m]."""
    from scipy.linalg import solve_continuous_lyapunov

    problem = lyapunov_problem(data, "loop-proposed")
    P = np.asarray(point(problem.solve())["P"])
    # Both conditions touch zero at the optimum: a small strictly decreasing part moves the point inside.
    A = to_float(problem.data["A"])
    inside = solve_continuous_lyapunov(A.T, -np.eye(len(A)))
    says = "squared torque of the rigid undisturbed loop [N^2 m^2]"
    return bound_by_point(problem, {"P": P * (1 + 1e-6) + 1e-4 * inside}, says=says)[1]
