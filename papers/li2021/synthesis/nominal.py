"""P1: nominal synthesis over lambda, by the exact change of variables. P7: a feasibility solve that stops early."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.lmi.conditions import minimise
from recontrol.lmi.problem import Problem, agreement
from recontrol.systems.output_feedback import Controller, ConvexVariables, controller_of

from .. import conditions as c
from ..plant import floats, plant
from ..problems import CONVEX, build, with_gamma
from .solving import float_forms, largest_margin, least_gamma, point

Array = np.ndarray
LAMBDAS = ("0.7", "0.8", "0.9", "1", "1.2", "1.4", "1.6", "2", "3", "5", "10")


def convex(data: Any, lam: str, *, best: bool = True) -> Problem:
    """(12) in convex variables at one lambda."""
    variables = with_gamma(CONVEX) if best else CONVEX
    return build(data, "eq12-convex", f"plant;lam={lam}", [c.eq12_convex], variables, best=best)


def controller_of_variables(data: Any, x: Any) -> Controller:
    """Controller of convex variables in floats."""
    p = floats({k: v for k, v in plant(data).items() if k in "ABC"})
    return controller_of(p["A"], p["B"], p["C"], ConvexVariables(*(np.asarray(x[k]) for k in CONVEX)))


def nominal(data: Any) -> dict[str, Any]:
    """Least gamma over lambda, agreement of three solvers at lambda = 1, and three designs at lambda = 1."""
    gammas: dict[str, float] = {}
    designs: dict[str, Any] = {}
    for lam in LAMBDAS:
        gammas[lam], solution = least_gamma(convex(data, lam))
        if lam == "1":
            best = solution
            designs["min-gamma"] = controller_of_variables(data, solution.point)._asdict()
    rigid = build(data, "eq12-convex-rigid", "plant", [c.eq12_convex_rigid], with_gamma(CONVEX), best=True)
    gammas["rigid"], _ = least_gamma(rigid)
    feasible = convex(data, "1", best=False)
    designs["max-margin"] = controller_of_variables(data, point(largest_margin(feasible)))._asdict()
    designs["min-trace"] = controller_of_variables(data, point(_least_trace(feasible)))._asdict()
    solvers = [best, *(convex(data, "1").solve(solver) for solver in ("SDPA", "CVXOPT"))]
    return {"gamma": gammas, "designs": designs, "agreement": agreement(solvers)}


def weighted_trace(X: Any, Y: Any) -> Any:
    """Objective 10 tr X + 0.1 tr Y, both of order one in the units of X and Y."""
    from recontrol.lmi.blocks import trace

    return 10 * trace(X) + trace(Y) / 10


def _least_trace(problem: Problem) -> Any:
    from dataclasses import replace

    return replace(problem, objective=minimise(weighted_trace)).solve()


def early_stop(data: Any) -> dict[str, Any]:
    """P7: barrier descent on t from x = 0 in unscaled variables, stopped at the first t < 0.

    An explanation of how the controller of [39] may have come about: its path, and so its digits, depend on the method.
    """
    problem = convex(data, "1", best=False)
    (M0,), (M,) = float_forms(problem, np.ones(problem.size))
    x, steps, t = _descend(-M0, -M, radius=1e9)
    variables = {n: v.matrix(x[problem.offsets[n] : problem.offsets[n] + v.size]) for n, v in problem.variables.items()}
    return {"controller": controller_of_variables(data, variables)._asdict(), "steps": steps, "t": t}


def _descend(M0: Array, M: Array, radius: float) -> tuple[Array, int, float]:
    """Minimise ``w t - log det(tI - M(x)) - log(R^2 - |x|^2)``, w = 1, 5, 25, ..., at most 50 Newton steps each."""
    m, n = M.shape[:2]
    L = np.concatenate([-M, np.eye(n)[None]])
    z = np.zeros(m + 1)
    z[-1] = np.linalg.eigvalsh(M0)[-1] + 1
    weight, steps = 1.0, 0
    while weight < 1e12:
        for _ in range(50):
            slack = np.tensordot(z, L, 1) - M0
            inverse = np.linalg.inv(np.linalg.cholesky(slack))
            W = inverse @ L @ inverse.T
            room = radius**2 - z[:-1] @ z[:-1]
            gradient = -np.trace(W, axis1=1, axis2=2)
            gradient[-1] += weight
            gradient[:-1] += 2 * z[:-1] / room
            flat = W.reshape(m + 1, -1)
            hessian = flat @ flat.T
            hessian[:-1, :-1] += 2 * np.eye(m) / room + 4 * np.outer(z[:-1], z[:-1]) / room**2
            direction = -np.linalg.solve(hessian, gradient)
            decrement = float(-gradient @ direction)
            if decrement < 1e-10:
                break
            z = z + direction / (1 + np.sqrt(decrement))
            steps += 1
            if z[-1] < 0:
                return z[:-1], steps, float(z[-1])
        weight *= 5
    raise RuntimeError("the descent did not reach t < 0")
