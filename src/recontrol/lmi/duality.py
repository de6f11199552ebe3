"""Multipliers of matrix inequalities in floats, from a solver, held off the boundary so that they survive rounding.

Everything runs on the exact affine form M_c(x) = M_c0 + sum_i x_i M_ci of the conditions c, in scaled units.
Multipliers Z_c >= 0 with sum_c <Z_c, M_ci> = c_i prove a lower bound of c'x; with c = 0, infeasibility.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from recontrol.errors import RecontrolError
from recontrol.exact import ball, rational
from recontrol.lmi import solvers
from recontrol.lmi.faces import Faced, Faces, exposed_faces
from recontrol.lmi.problem import Problem

# Violation below which conditions count as infeasible: homogeneous ones end at zero, not above.
FEASIBLE_BY = 1e-7
# Least eigenvalue of multipliers (of unit total trace) that counts as none.
SINGULAR = 1e-7
# Faces may have faces. A basis is known to the root of a solver's accuracy only: simple fractions are tried thrice.
ROUNDS, RECOGNISED = 3, (1e-6, 1e-4, 1e-2)
# The search for faces reads small numbers off the point: the solver goes as far as it can.
SHARP = {"CLARABEL": {"tol_gap_abs": 1e-13, "tol_gap_rel": 1e-13, "tol_feas": 1e-13}}


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
    units = [float(rational.to_float(u)) for u in faced.unknown_units]
    constants, coefficients = {}, {}
    for c in problem.named:
        form = faced.forms[c.name]
        s = rational.to_float(np.array(faced.row_units[c.name], dtype=object).reshape(-1))
        w = np.outer(s, s) if not c.is_equality else np.ones(form.shape)
        constants[c.name] = ball.midpoint(form.constant) * w
        m, n = form.shape
        triples = [
            (ball.midpoint(x) * w[place] * units[i], place[0] * n + place[1], i)
            for i, M in form.coefficients.items()
            for place, x in M.items()
        ]
        entries, rows, columns = (np.array(part) for part in zip(*triples, strict=True)) if triples else ([], [], [])
        coefficients[c.name] = scipy.sparse.csc_array((entries, (rows, columns)), shape=(m * n, problem.size))
        if c.name in faced.bases:
            B = rational.to_float(faced.bases[c.name])
            constants[c.name] = B.T @ constants[c.name] @ B
            dense = coefficients[c.name].toarray().T.reshape(problem.size, m, n)
            coefficients[c.name] = scipy.sparse.csc_array((B.T @ dense @ B).reshape(problem.size, m * n).T)
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
    """Unknowns in original units with M_s >= margin I, and scaled Z_s >= dual_margin I, from one solve.

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
    run = _run(cvxpy.Problem(cvxpy.Minimize(objective), constraints), solver, time_limit, "the bound", sharp=True)
    Z = {}
    for (name, constant), dual in zip(form.constants.items(), run.duals, strict=False):
        shift = 0.0 if name in form.equalities else dual_margin * np.eye(len(constant))
        Z[name] = (_symmetric(dual, name in form.equalities) + shift) * size
    units = rational.to_float(np.array(faced.unknown_units, dtype=object))
    return np.asarray(run.values[0], dtype=float) * units, Z


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
    run = _run(model, solver, time_limit, "the interior multipliers", sharp=True)
    least = float(run.reported if run.reported is not None else 0.0)
    Z = {n: _symmetric(dual, False) + least * np.eye(len(dual)) for n, dual in zip(names, run.duals, strict=False)}
    for name, dual in zip(form.equalities, run.duals[len(names) + 1 :], strict=False):
        Z[name] = np.asarray(dual)
    for variable, value in zip(model.variables(), run.values, strict=True):
        variable.value = value
    return Interior(Z, least, {n: np.asarray(M.value) for n, M in N.items()})


def candidates(faced: Faced, needed: float | None, solver: str, time_limit: float) -> Iterator[tuple[Faced, Interior]]:
    """Interior multipliers, then those on faces that they are forced to, widest interior first.

    Each is worth a try at an exact proof. Raises NotProvenError only if the first search gives no point.
    """
    level = [(faced, interior_multipliers(faced, needed, solver, time_limit))]
    for _ in range(ROUNDS):
        yield from level
        where, found = level[0]
        if abs(found.least) > SINGULAR:
            return
        level = []
        seen: list[dict[str, np.ndarray]] = []
        for tolerance in RECOGNISED:
            smaller = exposed_faces(where, found.exposing, found.multipliers, tolerance)
            if not smaller or any(_equal(smaller, other) for other in seen):
                continue
            seen.append(smaller)
            narrowed = Faced(faced.problem, smaller, faced.near)
            with suppress(NotProvenError):
                level.append((narrowed, interior_multipliers(narrowed, needed, solver, time_limit)))
        level = sorted((e for e in level if e[1].least > -SINGULAR), key=lambda e: -e[1].least)
        if not level:
            return


def _equal(a: Faces, b: Faces) -> bool:
    return a.keys() == b.keys() and all(a[n].shape == b[n].shape and bool(np.all(a[n] == b[n])) for n in a)


def _run(model: Any, solver: str, time_limit: float, what: str, *, sharp: bool = False) -> solvers.Run:
    attempts = [SHARP[solver], {}] if sharp and solver in SHARP else [{}]
    for options in attempts:
        run = solvers.run(model, solvers.profile(solver, fast=True, **options), time_limit)
        if run.outcome in (solvers.OPTIMAL, solvers.INACCURATE) and all(v is not None for v in run.values):
            return run
    raise NotProvenError(f"{solver} gave no point for {what}: {run.words}")


def _symmetric(dual: Any, equality: bool) -> np.ndarray:
    Z = np.atleast_2d(np.asarray(dual, dtype=float))
    return Z if equality else (Z + Z.T) / 2
