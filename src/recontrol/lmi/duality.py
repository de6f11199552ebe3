"""Multipliers of matrix inequalities in floats, from a solver, held off the boundary so that they survive rounding.

Everything runs on the exact affine form M_c(x) = M_c0 + sum_i x_i M_ci of the conditions c, in scaled units.
Multipliers Z_c >= 0 with sum_c <Z_c, M_ci> = c_i prove a lower bound of c'x; with c = 0, infeasibility.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from recontrol.errors import RecontrolError
from recontrol.exact import ball, rational
from recontrol.lmi import solvers
from recontrol.lmi.faces import Faced, exposed_faces
from recontrol.lmi.problem import Problem

# Violation below which conditions count as infeasible: homogeneous ones end at zero, not above.
FEASIBLE_BY = 1e-7
# Least eigenvalue of scaled multipliers (of unit total trace) below which they count as singular.
SINGULAR = 1e-8
# Faces may have faces. A basis is known to the root of a solver's accuracy only: simple fractions are tried twice.
ROUNDS, RECOGNISED = 3, (1e-6, 1e-3)


class NotProvenError(RecontrolError, ArithmeticError):
    """A statement could not be proven: the message says which step failed. It is no refutation."""


@dataclass(frozen=True)
class FloatForm:
    """Scaled float coefficients: constants and, per condition, a sparse (n n, unknowns) matrix; costs; boxes."""

    constants: dict[str, np.ndarray]
    coefficients: dict[str, Any]
    costs: np.ndarray
    boxes: dict[int, tuple[float, float]]
    equalities: frozenset[str]

    def matrix(self, name: str, x: Any, s: Any = 1.0) -> Any:
        """CVXPY expression s M_0 + sum_i x_i M_i."""
        import cvxpy

        M = self.constants[name]
        return s * M + cvxpy.reshape(self.coefficients[name] @ x, M.shape, order="C")


def float_form(faced: Faced) -> FloatForm:
    """Coefficients in scaled units (unknowns and rows), restricted to the faces."""
    import scipy.sparse

    problem = faced.problem
    units = [float(rational.to_float(u)) for u in problem.unknown_units]
    constants, coefficients = {}, {}
    for c in problem.named:
        form = faced.forms[c.name]
        s = rational.to_float(np.array(faced.row_units[c.name], dtype=object).reshape(-1))
        w = np.outer(s, s) if not c.is_equality else np.ones(form.shape)
        constants[c.name] = ball.midpoint(form.constant()) * w
        shape = (form.shape[0] * form.shape[1], problem.size)
        columns = scipy.sparse.lil_array(shape)
        for i, M in form.coefficients().items():
            columns[:, [i]] = (ball.midpoint(M) * w * units[i]).reshape(-1, 1)
        coefficients[c.name] = columns.tocsc()
    costs = np.zeros(problem.size)
    for i, cost in problem.costs[1].items():
        costs[i] = float(ball.midpoint(cost)) * units[i]
    boxes = {
        i: (float(rational.to_float(lo)) / units[i], float(rational.to_float(hi)) / units[i])
        for i, (lo, hi) in problem.unknown_boxes.items()
    }
    return FloatForm(constants, coefficients, costs, boxes, frozenset(c.name for c in problem.named if c.is_equality))


def held_off_bound(
    faced: Faced, margin: float, dual_margin: float, solver: str, time_limit: float
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Scaled point with M_s >= margin I and scaled multipliers Z_s >= dual_margin I, from one solve.

    Minimising c'x - dual_margin sum tr M_s(x) shifts the multipliers by dual_margin I: they become the dual variables
    plus dual_margin I, interior by construction. Raises NotProvenError if the solver finds no point.
    """
    import cvxpy

    form = float_form(faced)
    x = cvxpy.Variable(faced.problem.size)
    size = max(float(np.abs(form.costs).max()), 1e-300)
    objective, constraints = form.costs @ x / size, []
    for name, constant in form.constants.items():
        M = form.matrix(name, x)
        if name in form.equalities:
            constraints.append(M == 0)
            continue
        constraints.append(M - margin * np.eye(len(constant)) >> 0)
        objective = objective - dual_margin * cvxpy.trace(M)
    constraints += _box(form, x)
    run = _run(cvxpy.Problem(cvxpy.Minimize(objective), constraints), solver, time_limit, "the bound")
    Z = {}
    for (name, constant), dual in zip(form.constants.items(), run.duals, strict=False):
        shift = 0.0 if name in form.equalities else dual_margin * np.eye(len(constant))
        Z[name] = (_symmetric(dual, name in form.equalities) + shift) * size
    return np.asarray(run.values[0], dtype=float), Z


def _box(form: FloatForm, x: Any, s: Any = 1.0) -> list[Any]:
    return [e for i, (lo, hi) in form.boxes.items() for e in (x[i] >= s * lo, x[i] <= s * hi)]


def least_violation(problem: Problem, solver: str, time_limit: float) -> float:
    """min t >= -1 with M_s(x) + t I >= 0: negative if the conditions are feasible, as far as the solver sees."""
    import cvxpy

    form = float_form(Faced(problem, {}))
    x, t = cvxpy.Variable(problem.size), cvxpy.Variable()
    constraints = [t >= -1, *_box(form, x)]
    for name, constant in form.constants.items():
        M = form.matrix(name, x)
        constraints.append(M == 0 if name in form.equalities else M + t * np.eye(len(constant)) >> 0)
    run = _run(cvxpy.Problem(cvxpy.Minimize(t), constraints), solver, time_limit, "the least violation")
    return float(run.reported if run.reported is not None else -1.0)


@dataclass(frozen=True)
class Interior:
    """Scaled multipliers of largest least eigenvalue, that eigenvalue, and the N_c that limit it (see `faces`)."""

    multipliers: dict[str, np.ndarray]
    least: float
    exposing: dict[str, np.ndarray]


def interior_multipliers(faced: Faced, needed: float | None, solver: str, time_limit: float) -> Interior:
    """Multipliers with sum of traces 1 that contradict by ``needed``, of largest least eigenvalue.

    They are the dual variables of min t - s needed over N_c = s M_c0 + sum x_i M_ci + t I >= 0, sum tr N_c = 1, s >= 0,
    shifted by the optimal value. (Multipliers of the least violation itself are singular and would not survive
    rounding.) ``needed=None`` asks for the multipliers of a bound instead: s = 0 and c'x = 0.
    """
    import cvxpy

    form = float_form(faced)
    x, t, s = cvxpy.Variable(faced.problem.size), cvxpy.Variable(), cvxpy.Variable(nonneg=True)
    names = [n for n, M in form.constants.items() if n not in form.equalities and M.size]
    N = {n: form.matrix(n, x, s) + t * np.eye(len(form.constants[n])) for n in names}
    constraints = [N[n] >> 0 for n in names]
    constraints.append(sum(cvxpy.trace(M) for M in N.values()) == 1)
    constraints += [form.matrix(n, x, s) == 0 for n in form.equalities]
    constraints += _box(form, x, s) if needed is not None else [s == 0, form.costs @ x == 0]
    constraints += [x[i] == 0 for i in form.boxes] if needed is None else []
    model = cvxpy.Problem(cvxpy.Minimize(t - s * (needed or 0.0)), constraints)
    run = _run(model, solver, time_limit, "the interior multipliers")
    least = float(run.reported if run.reported is not None else 0.0)
    Z = {n: _symmetric(dual, False) + least * np.eye(len(dual)) for n, dual in zip(names, run.duals, strict=False)}
    for name, dual in zip(form.equalities, run.duals[len(names) + 1 :], strict=False):
        Z[name] = np.asarray(dual)
    for variable, value in zip(model.variables(), run.values, strict=True):
        variable.value = value
    return Interior(Z, least, {n: np.asarray(M.value) for n, M in N.items()})


def on_faces(faced: Faced, needed: float | None, solver: str, time_limit: float) -> tuple[Faced, Interior]:
    """Interior multipliers, on faces of faces where there is no interior; what was found best, and where.

    Raises NotProvenError only if the first search gives no point.
    """
    best = (faced, interior_multipliers(faced, needed, solver, time_limit))
    for _ in range(ROUNDS):
        if best[1].least > SINGULAR:
            break
        tried = best
        for tolerance in RECOGNISED:
            smaller = exposed_faces(best[0], best[1].exposing, tolerance)
            try:
                if smaller and all(W.shape[1] for W in smaller.values()):
                    narrowed = Faced(faced.problem, smaller)
                    tried = (narrowed, interior_multipliers(narrowed, needed, solver, time_limit))
            except NotProvenError:
                continue
            if tried[1].least > SINGULAR:
                break
        if tried is best:
            break
        best = tried
    return best


def _run(model: Any, solver: str, time_limit: float, what: str) -> solvers.Run:
    run = solvers.run(model, solvers.profile(solver), time_limit)
    if run.outcome not in (solvers.OPTIMAL, solvers.INACCURATE) or any(v is None for v in run.values):
        raise NotProvenError(f"{solver} gave no point for {what}: {run.words}")
    return run


def _symmetric(dual: Any, equality: bool) -> np.ndarray:
    Z = np.atleast_2d(np.asarray(dual, dtype=float))
    return Z if equality else (Z + Z.T) / 2
