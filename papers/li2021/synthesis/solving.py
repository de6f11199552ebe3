"""Solving helpers: least gamma, centres, largest margins, controllers of solutions."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.exact.rational import to_float
from recontrol.lmi.blocks import eye
from recontrol.lmi.centre import Centre, analytic_centre
from recontrol.lmi.conditions import condition, minimise
from recontrol.lmi.problem import Problem, Solution
from recontrol.lmi.variables import scalar
from recontrol.systems.output_feedback import Controller

Array = np.ndarray


class NoPointError(RuntimeError):
    """A solver gave no point where the reviewed run has one."""


def point(solution: Solution) -> Mapping[str, Any]:
    """The point of a solution. Raises NoPointError."""
    if not solution.has_point:
        raise NoPointError(f"{solution.problem}: {solution.solver} says {solution.words} {solution.reason}")
    return solution.point


def least_gamma(problem: Problem, **options: Any) -> tuple[float, Solution]:
    """Least gamma of a problem that minimises gamma^2, and the solution.

    Where CLARABEL gives no point, it is asked again with the rows scaled the other way (balanced or plain),
    then CVXOPT.
    """
    other = replace(problem, balanced=not problem.balanced)
    for form, solver in ((problem, "CLARABEL"), (other, "CLARABEL"), (problem, "CVXOPT")):
        solution = form.solve(solver, fast=True, **options)
        if solution.has_point:
            break
    return float(np.sqrt(max(point(solution)["gamma2"], 0.0))), solution


def relaxed(function: Callable[..., Any]) -> Callable[..., Any]:
    """The condition ``M - t I`` in place of ``M``, with t as its first argument."""
    signature = inspect.signature(function)

    def shifted(t: Any, **values: Any) -> Any:
        M = function(**values)
        return M - t * eye(M.shape[0])

    first = inspect.Parameter("t", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    shifted.__signature__ = signature.replace(parameters=[first, *signature.parameters.values()])  # type: ignore[attr-defined]
    return shifted


def largest_margin(problem: Problem, **options: Any) -> Solution:
    """Point that minimises the largest eigenvalue t of all conditions written "< 0", in the units of the equations."""
    shifted = [
        condition(relaxed(x.function), x.name, sense="<", rename={**x.rename}, **x.given)
        if x.sense in ("<", "<=")
        else x
        for x in problem.named
    ]
    variables = {**problem.variables, "t": scalar()}
    return Problem(
        problem.name, variables, shifted, problem.data, minimise(lambda t: t), units=problem.units, balanced=False
    ).solve(**options)


def centre(problem: Problem, start: Mapping[str, Any]) -> tuple[dict[str, Any], Centre]:
    """Analytic centre of all conditions of a problem from a strictly feasible point, in original units.

    Raises NoPointError that names the problem if Newton's method does not get there.

    Scaling of the unknowns only helps the arithmetic: the centre does not depend on it.
    """
    units = to_float(np.array(problem.unknown_units, dtype=object))
    constants, coefficients = float_forms(problem, units)
    x0 = np.concatenate([v.vector(np.reshape(start[n], v.matrix_shape)) for n, v in problem.variables.items()]) / units
    try:
        found = analytic_centre(constants, coefficients, x0)
    except ValueError as error:
        raise NoPointError(f"{problem.name}, {problem.case}: {error}") from None
    x = found.x * units
    out: dict[str, Any] = {}
    for name, v in problem.variables.items():
        first = problem.offsets[name]
        V = np.reshape(v.matrix(x[first : first + v.size]), v.matrix_shape)
        out[name] = V if v.shape else float(V[0, 0])
    return out, found


def float_forms(problem: Problem, units: Array) -> tuple[list[Array], list[Array]]:
    """Constant (n, n) and coefficients (unknowns, n, n) of each condition "> 0", by evaluation at unit vectors."""
    first = problem.offsets

    def at(x: Array) -> list[Array]:
        point = {name: v.matrix(x[first[name] : first[name] + v.size]) for name, v in problem.variables.items()}
        values = problem.values(point)
        return [np.asarray(c.matrix(values), dtype=float) for c in problem.named]

    constants = at(np.zeros(problem.size))
    columns = [at(unit) for unit in np.diag(units)]
    return constants, [np.stack([c[k] - M for c in columns]) for k, M in enumerate(constants)]


def controller_of_point(x: Mapping[str, Any], C_f: Array) -> Controller:
    """A_f = N^-1 F_a, B_f = N^-1 F_b of a point of (13)."""
    return Controller(np.linalg.solve(x["N"], x["F_a"]), np.linalg.solve(x["N"], x["F_b"]), C_f)


def gain_of(x: Mapping[str, Any]) -> Array:
    """C_f = Z X^-1 of a point of the state-feedback step."""
    return np.linalg.solve(x["X"], x["Z"].T).T
