"""Multipliers of matrix inequalities: found in floats by a solver, rounded, and repaired exactly.

Everything runs on the exact affine form M_c(x) = M_c0 + sum_i x_i M_ci of the conditions c. Multipliers Z_c >= 0 with
sum_c <Z_c, M_ci> = c_i prove a lower bound of c'x; with c = 0, infeasibility.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.errors import RecontrolError
from recontrol.exact import ball, linalg, rational
from recontrol.lmi import solvers
from recontrol.lmi.affine import CONSTANT, AffineMatrix
from recontrol.lmi.problem import Problem


class NotProvenError(RecontrolError, ArithmeticError):
    """A statement could not be proven: the message says which step failed. It is no refutation."""


@dataclass(frozen=True)
class Multipliers:
    """Exact multipliers by condition, and the names of slack conditions whose multiplier follows from the others."""

    matrices: dict[str, np.ndarray]
    slack: tuple[str, ...]


def slack_conditions(problem: Problem) -> dict[str, set[int]]:
    """Conditions that say just "V > 0" for a symmetric variable (or scalar) V: their names and V's unknowns.

    Only the first such condition of a variable counts; unknowns with a box are left to the box.
    """
    out: dict[str, set[int]] = {}
    taken = set(unknown_boxes(problem))
    for c in problem.named:
        form = problem.forms[c.name]
        coefficients = form.coefficients()
        if c.is_equality or CONSTANT in form.terms or not coefficients or taken & set(coefficients):
            continue
        places: set[tuple[int, int]] = set()
        if all(_is_unit(M, places) for M in coefficients.values()):
            out[c.name] = set(coefficients)
            taken |= set(coefficients)
    return out


def _is_unit(M: np.ndarray, places: set[tuple[int, int]]) -> bool:
    found = {(i, j) for (i, j), x in np.ndenumerate(M) if i <= j and not (type(x) is fmpq and x == 0)}
    if len(found) != 1 or found & places or any(isinstance(x, arb) for x in M.flat):
        return False
    places |= found
    return M[next(iter(found))] == 1


def unknown_boxes(problem: Problem) -> dict[int, tuple[fmpq, fmpq]]:
    """Box of every scalar unknown whose variable has one, in original units."""
    out: dict[int, tuple[fmpq, fmpq]] = {}
    for name, (low, high) in problem.boxes.items():
        v, first = problem.variables[name], problem.offsets[name]
        for k, (lo, hi) in enumerate(zip(v.exact_vector(low), v.exact_vector(high), strict=True)):
            out[first + k] = (lo, hi)
    return out


# -- floats -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FloatForm:
    """Scaled float coefficients of the conditions: constants and, per condition, a sparse (n n, unknowns) matrix."""

    constants: dict[str, np.ndarray]
    coefficients: dict[str, Any]
    costs: np.ndarray
    boxes: dict[int, tuple[float, float]]
    equalities: frozenset[str]


Support = Mapping[str, list[int]]


def float_form(problem: Problem, support: Support | None = None) -> FloatForm:
    """Coefficients in scaled units (unknowns and rows), for a solver.

    ``support`` keeps only the principal block of these rows of a condition (no condition: all rows).
    """
    import scipy.sparse

    units = [float(rational.to_float(u)) for u in problem.unknown_units]
    constants, coefficients = {}, {}
    for c in problem.named:
        form, s = problem.forms[c.name], rational.to_float(np.array(problem.row_units[c.name], dtype=object))
        if support and c.name in support:
            form, s = restricted(form, support[c.name]), s[support[c.name]]
        w = np.outer(s, s) if not c.is_equality else np.ones(form.shape)
        constants[c.name] = ball.midpoint(form.constant()) * w
        rows, columns, entries = [], [], []
        for i, M in form.coefficients().items():
            scaled = (ball.midpoint(M) * w * units[i]).ravel()
            at = np.flatnonzero(scaled)
            rows.append(at)
            columns.append(np.full(len(at), i))
            entries.append(scaled[at])
        shape = (form.shape[0] * form.shape[1], problem.size)
        triple = [np.concatenate(x) if x else np.zeros(0, dtype=int) for x in (entries, rows, columns)]
        coefficients[c.name] = scipy.sparse.csc_array((triple[0].astype(float), (triple[1], triple[2])), shape=shape)
    costs = np.zeros(problem.size)
    for i, cost in problem.costs[1].items():
        costs[i] = float(ball.midpoint(cost)) * units[i]
    boxes = {
        i: (float(rational.to_float(lo)) / units[i], float(rational.to_float(hi)) / units[i])
        for i, (lo, hi) in unknown_boxes(problem).items()
    }
    return FloatForm(constants, coefficients, costs, boxes, frozenset(c.name for c in problem.named if c.is_equality))


def held_off_bound(
    problem: Problem, margin: float, dual_margin: float, solver: str, time_limit: float
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Scaled primal point with M_s >= margin I and scaled multipliers Z_s >= dual_margin I, from one solve.

    Minimising c'x - dual_margin sum tr M_s(x) shifts the multipliers by dual_margin I: they become the dual variables
    plus dual_margin I, interior by construction. Raises NotProvenError if the solver finds no point.
    """
    import cvxpy

    form = float_form(problem)
    x = cvxpy.Variable(problem.size)
    size = max(float(np.abs(form.costs).max()), 1e-300)
    objective, constraints, names = form.costs @ x / size, [], list(form.constants)
    for name in names:
        M, n = _matrix(form, name, x), form.constants[name].shape[0]
        if name in form.equalities:
            constraints.append(M == 0)
            continue
        constraints.append(M - margin * np.eye(n) >> 0)
        objective = objective - dual_margin * cvxpy.trace(M)
    for i, (lo, hi) in form.boxes.items():
        constraints += [x[i] >= lo, x[i] <= hi]
    model = cvxpy.Problem(cvxpy.Minimize(objective), constraints)
    run = _run(model, solver, time_limit, "the bound")
    Z = {}
    for name, dual in zip(names, run.duals, strict=False):
        n = form.constants[name].shape[0]
        shift = 0.0 if name in form.equalities else dual_margin
        Z[name] = (_symmetric(dual, name in form.equalities) + shift * np.eye(n)) * size
    return np.asarray(run.values[0], dtype=float), Z


def farkas_floats(
    problem: Problem, solver: str, time_limit: float, support: Support | None = None
) -> tuple[dict[str, np.ndarray], float, Support]:
    """Scaled multipliers in the interior of the face that contradicts the conditions, and their least eigenvalue.

    First t* = min t with M_s(x) + t I >= 0; then the multipliers with sum of traces 1 and contradiction of at least
    t*/2 whose least eigenvalue is largest (the optimal ones are singular and would not survive rounding). If that
    eigenvalue is zero, rows in which every multiplier vanishes are left out and the search repeated. Returns the
    multipliers of the rows of the support, the eigenvalue and the support. Raises NotProvenError if the conditions look
    feasible.
    """
    import cvxpy

    form = float_form(problem)
    x, t = cvxpy.Variable(problem.size), cvxpy.Variable()
    constraints = [
        _matrix(form, n, x) + t * np.eye(M.shape[0]) >> 0 for n, M in form.constants.items() if n not in form.equalities
    ]
    constraints += [_matrix(form, name, x) == 0 for name in form.equalities]
    constraints += [e for i, (lo, hi) in form.boxes.items() for e in (x[i] >= lo, x[i] <= hi)]
    model = cvxpy.Problem(cvxpy.Minimize(t), [*constraints, t >= -1])
    run = _run(model, solver, time_limit, "the least violation")
    violation = float(run.reported if run.reported is not None else -1.0)
    if violation < -1e-7:
        raise NotProvenError(
            f"{problem.name}: not infeasible as far as {solver} sees: a point has margin {-violation:.3g}"
        )
    found = dict(support or {})
    for _ in range(3):
        Z, least = _interior(problem, float_form(problem, found), max(violation, 0.0) / 2, solver, time_limit)
        if least > 1e-9 or not (smaller := _shrunk(problem, Z, found)):
            break
        found = smaller
    return Z, least, found


def _shrunk(problem: Problem, Z: Mapping[str, np.ndarray], support: Support) -> dict[str, list[int]]:
    """Support without the rows whose multiplier vanishes; empty if there are none to leave out."""
    out, fewer = dict(support), False
    for name, M in Z.items():
        if _is_equality(problem, name):
            continue
        rows = support.get(name, list(range(len(M))))
        kept = [r for r, size in zip(rows, np.diag(M), strict=True) if size > 1e-7]
        fewer |= len(kept) < len(rows)
        out[name] = kept
    return out if fewer else {}


def _interior(
    problem: Problem, form: FloatForm, needed: float, solver: str, time_limit: float
) -> tuple[dict[str, np.ndarray], float]:
    """Multipliers of largest least eigenvalue: the dual of min t - s needed over s M_0 + sum x_i M_i + t I >= 0."""
    import cvxpy

    x, t, s = cvxpy.Variable(problem.size), cvxpy.Variable(), cvxpy.Variable(nonneg=True)
    names = [n for n, M in form.constants.items() if n not in form.equalities and M.size]
    matrices = {n: _matrix(form, n, x, s) + t * np.eye(form.constants[n].shape[0]) for n in names}
    constraints = [matrices[n] >> 0 for n in names]
    constraints.append(sum(cvxpy.trace(M) for M in matrices.values()) == 1)
    constraints += [_matrix(form, n, x, s) == 0 for n in form.equalities]
    constraints += [e for i, (lo, hi) in form.boxes.items() for e in (x[i] >= s * lo, x[i] <= s * hi)]
    model = cvxpy.Problem(cvxpy.Minimize(t - s * needed), constraints)
    run = _run(model, solver, time_limit, "the interior multipliers")
    least = float(run.reported if run.reported is not None else 0.0)
    Z = {n: _symmetric(dual, False) + least * np.eye(len(dual)) for n, dual in zip(names, run.duals, strict=False)}
    for name, dual in zip(form.equalities, run.duals[len(names) + 1 :], strict=False):
        Z[name] = np.asarray(dual)
    return Z, least


def _matrix(form: FloatForm, name: str, x: Any, s: Any = 1.0) -> Any:
    import cvxpy

    M = form.constants[name]
    return s * M + cvxpy.reshape(form.coefficients[name] @ x, M.shape, order="C")


def _run(model: Any, solver: str, time_limit: float, what: str) -> solvers.Run:
    run = solvers.run(model, solvers.profile(solver), time_limit)
    if run.outcome not in (solvers.OPTIMAL, solvers.INACCURATE) or any(v is None for v in run.values):
        raise NotProvenError(f"{solver} gave no point for {what}: {run.words}")
    return run


def _symmetric(dual: Any, equality: bool) -> np.ndarray:
    Z = np.atleast_2d(np.asarray(dual, dtype=float))
    return Z if equality else (Z + Z.T) / 2


# -- exact ------------------------------------------------------------------------------------------------------------


def rationalise(
    problem: Problem, scaled: Mapping[str, np.ndarray], decimals: int, support: Support | None = None
) -> Multipliers:
    """Scaled float multipliers as exact ones in original units that satisfy sum <Z_c, M_ci> = c_i exactly.

    Rounded to ``decimals`` decimals in scaled units; then as many entries as there are equations are solved for in
    rationals, chosen by a pivoted QR among the large ones. Slack conditions are left out: they absorb their variable.
    Raises NotProvenError if the equations cannot be met (balls among their coefficients, dependent equations).
    """
    slack, support = slack_conditions(problem), support or {}
    exact: dict[str, np.ndarray] = {}
    for c in problem.named:
        if c.name not in slack:
            rounded = rational.zeros(*problem.forms[c.name].shape)
            rows = support.get(c.name, list(range(rounded.shape[0])))
            if rows:
                inner = np.ix_(rows, list(range(rounded.shape[1])) if c.is_equality else rows)
                rounded[inner] = rational.rounded(scaled[c.name], decimals)
            exact[c.name] = _unscaled(problem, c.name, rounded, c.is_equality)
    free = set(unknown_boxes(problem))
    for name, unknowns in slack.items():
        coefficients = problem.forms[name].coefficients()
        rows = support.get(name, list(range(problem.forms[name].shape[0])))
        free |= {i for i in unknowns if all(k in rows for k in np.argwhere(coefficients[i] != 0)[0])}
    equations = [i for i in range(problem.size) if i not in free]
    if equations:
        _repair(problem, exact, equations)
    return Multipliers(exact, tuple(slack))


def _unscaled(problem: Problem, name: str, Z: np.ndarray, equality: bool) -> np.ndarray:
    if equality:
        return Z
    s = rational.diagonal(problem.row_units[name])
    return s @ rational.symmetric_part(Z) @ s


def _repair(problem: Problem, Z: dict[str, np.ndarray], equations: list[int]) -> None:
    """Change entries of the Z in place so that the equations hold exactly."""
    import scipy.linalg

    places, weights = _places(problem, Z)
    A = rational.zeros(len(equations), len(places))
    row_of = {i: r for r, i in enumerate(equations)}
    for column, (name, i, j) in enumerate(places):
        form, equality = problem.forms[name], _is_equality(problem, name)
        for k, M in form.coefficients().items():
            if k in row_of and not (type(M[i, j]) is fmpq and M[i, j] == 0):
                if isinstance(M[i, j], arb):
                    raise NotProvenError(
                        f"{problem.name}: unknown {problem.unknowns[k]} has balls in {name}: give it a box or a slack"
                    )
                A[row_of[k], column] = M[i, j] * (1 if i == j or equality else 2)
    z = np.array([[Z[name][i, j]] for name, i, j in places], dtype=object)
    right = rational.zeros(len(equations), 1)
    for i, cost in problem.costs[1].items():
        if i in row_of:
            right[row_of[i], 0] = cost
    right = right - A @ z
    floats = rational.to_float(A) * weights[None, :]
    norms = np.linalg.norm(floats, axis=1)
    rows = [r for r in range(len(equations)) if norms[r] > 0]
    if any(right[r, 0] != 0 for r in range(len(equations)) if norms[r] == 0):
        raise NotProvenError(f"{problem.name}: an unknown appears in the objective only")
    _, triangle, pivots = scipy.linalg.qr(floats[rows] / norms[rows, None], mode="economic", pivoting=True)
    diagonal = np.abs(np.diag(triangle))
    count = int((diagonal > 1e-10 * diagonal[0]).sum()) if len(diagonal) else 0
    rows = [rows[r] for r in linalg.independent_rows(A[rows])] if count < len(rows) else rows
    columns = list(pivots[:count])
    if len(rows) != count:
        raise NotProvenError(f"{problem.name}: the equations of the multipliers are too close to dependent")
    step = linalg.solve(A[np.ix_(rows, columns)], right[rows])
    for column, change in zip(columns, step[:, 0], strict=True):
        name, i, j = places[column]
        Z[name][i, j] += change
        if i != j and not _is_equality(problem, name):
            Z[name][j, i] += change


def _places(problem: Problem, Z: Mapping[str, np.ndarray]) -> tuple[list[tuple[str, int, int]], np.ndarray]:
    """Entries that may be changed, and how much they may: the geometric mean of the diagonal."""
    places, weights = [], []
    for name, M in Z.items():
        equality = _is_equality(problem, name)
        for i, j in np.ndindex(M.shape):
            size = 1.0 if equality else float(rational.to_float(abs(M[i, i] * M[j, j]))) ** 0.5
            if equality or (i <= j and size > 0):
                places.append((name, i, j))
                weights.append(size)
    return places, np.array(weights)


def _is_equality(problem: Problem, name: str) -> bool:
    return next(c for c in problem.named if c.name == name).is_equality


def restricted(form: AffineMatrix, rows: list[int]) -> AffineMatrix:
    """Principal block of a form: what is infeasible for it is infeasible for the whole."""
    at = np.ix_(rows, rows)
    return AffineMatrix((len(rows), len(rows)), {i: M[at] for i, M in form.terms.items()})
