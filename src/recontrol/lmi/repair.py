"""From float multipliers to exact ones: rounding, and restoring the equations that make every unknown drop out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from flint import arb, fmpq

from recontrol.exact import linalg, rational
from recontrol.lmi.affine import Entries, is_zero
from recontrol.lmi.duality import FloatForm, NotProvenError, float_form
from recontrol.lmi.faces import Faced
from recontrol.lmi.problem import Problem

PROJECTIONS = 4


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
    taken = set(problem.unknown_boxes)
    for c in problem.named:
        form = problem.forms[c.name]
        coefficients = form.coefficients
        if c.is_equality or not coefficients or taken & set(coefficients):
            continue
        if not all(is_zero(x) for x in form.constant.flat):
            continue
        places: set[tuple[int, int]] = set()
        if all(_is_unit(M, places) for M in coefficients.values()):
            out[c.name] = set(coefficients)
            taken |= set(coefficients)
    return out


def _is_unit(M: Entries, places: set[tuple[int, int]]) -> bool:
    found = {(i, j) for i, j in M if i <= j}
    if len(found) != 1 or found & places or any(isinstance(x, arb) or x != 1 for x in M.values()):
        return False
    places |= found
    return True


def rationalise(faced: Faced, scaled: Mapping[str, np.ndarray], decimals: int) -> Multipliers:
    """Scaled float multipliers as exact ones in original units that satisfy sum <Z_c, M_ci> = c_i exactly.

    Projected on the equations in floats, which keeps them definite; rounded to ``decimals`` decimals in scaled units;
    then as many entries as there are equations are solved for in rationals, chosen by a pivoted QR among the large
    ones. Slack conditions are left out: they absorb their variable.
    Raises NotProvenError if the equations cannot be met (balls among their coefficients, dependent equations).
    """
    problem = faced.problem
    slack = {name: unknowns for name, unknowns in slack_conditions(problem).items() if name not in faced.faces}
    absorbed = set(problem.unknown_boxes).union(*slack.values()) if slack else set(problem.unknown_boxes)
    equations = [i for i in range(problem.size) if i not in absorbed]
    unboxed = [i for i in range(problem.size) if i not in problem.unknown_boxes]
    scaled = projected(float_form(faced), dict(scaled), unboxed)
    exact: dict[str, np.ndarray] = {}
    for c in problem.named:
        if c.name in slack:
            continue
        size = faced.forms[c.name].shape
        rounded = rational.rounded(scaled[c.name], decimals) if min(size) else rational.zeros(*size)
        exact[c.name] = rounded if c.is_equality else faced.unscaled(c.name, rational.symmetric_part(rounded))
    if equations:
        _repair(faced, exact, equations)
    return Multipliers({name: faced.lifted(name, Y) for name, Y in exact.items()}, tuple(slack))


def projected(form: FloatForm, Z: dict[str, np.ndarray], equations: list[int]) -> dict[str, np.ndarray]:
    """Float multipliers closer to the equations, Z = L L' moved by the shortest L Y L' that meets them.

    In this metric, that of interior-point methods, a step is short relative to Z, so definiteness survives.
    """
    names = [n for n, M in Z.items() if M.size] if equations else []
    F = {n: form.coefficients[n][:, equations].toarray().T.reshape(len(equations), *Z[n].shape) for n in names}
    for _ in range(PROJECTIONS if names else 0):
        residual = _residual(form, F, Z, equations)
        roots = {n: (np.eye(len(Z[n])), np.eye(Z[n].shape[1])) if n in form.equalities else _root(Z[n]) for n in names}
        rows = np.hstack([(roots[n][0].T @ F[n] @ roots[n][1]).reshape(len(equations), -1) for n in names])
        short, _ = shortest(rows, residual)
        moved, start = dict(Z), 0
        for n in names:
            Y = short[start : start + Z[n].size].reshape(Z[n].shape)
            start += Z[n].size
            moved[n] = Z[n] + roots[n][0] @ (Y if n in form.equalities else (Y + Y.T) / 2) @ roots[n][1].T
        if not np.linalg.norm(_residual(form, F, moved, equations)) < np.linalg.norm(residual):
            break
        Z = moved
    return Z


def shortest(rows: np.ndarray, right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The shortest x with rows @ x = right, and an orthonormal basis Q of the span of the rows (as columns).

    Dependent rows are left out.
    """
    import scipy.linalg

    size = np.maximum(np.linalg.norm(rows, axis=1), 1e-300)
    scaled = (rows / size[:, None]).T
    Q, R = scipy.linalg.qr(scaled, mode="economic")
    order, pivots = np.arange(len(rows)), np.abs(np.diag(R))
    if scaled.shape[0] < scaled.shape[1] or pivots.min() <= 1e-12 * pivots.max():
        Q, R, order = scipy.linalg.qr(scaled, mode="economic", pivoting=True)
        pivots = np.abs(np.diag(R))
        kept = int((pivots > 1e-13 * pivots[0]).sum())
        Q, R, order = Q[:, :kept], R[:kept, :kept], order[:kept]
    return Q @ scipy.linalg.solve_triangular(R.T, (right / size)[order], lower=True), Q


def _residual(form: FloatForm, F: dict[str, np.ndarray], Z: dict[str, np.ndarray], equations: list[int]) -> np.ndarray:
    return form.costs[equations] - sum(np.einsum("kij,ij->k", F[n], Z[n]) for n in F)


def _root(Z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    values, vectors = np.linalg.eigh(Z)
    L = vectors * np.sqrt(np.maximum(values, 0.0))
    return L, L


def _repair(faced: Faced, Z: dict[str, np.ndarray], equations: list[int]) -> None:
    """Change entries of the Z in place so that the equations hold exactly."""
    problem = faced.problem
    places, weights = _places(problem, Z)
    A = _equations(faced, places, equations)
    z = np.array([[Z[name][i, j]] for name, i, j in places], dtype=object)
    costs = problem.costs[1]
    right = np.array([[costs.get(i, fmpq(0))] for i in equations], dtype=object) - A @ z
    rows, columns = _solvable(problem, A, weights, right)
    if not rows:
        return
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


def _equations(faced: Faced, places: list[tuple[str, int, int]], equations: list[int]) -> np.ndarray:
    """Exact matrix (equations, places) of sum_c <Z_c, M_ci> in the entries that may be changed."""
    A = rational.zeros(len(equations), len(places))
    column_of = {place: column for column, place in enumerate(places)}
    for row, k in enumerate(equations):
        for name, form in faced.forms.items():
            for (i, j), x in form.coefficients.get(k, {}).items():
                if (name, i, j) not in column_of:
                    continue
                if isinstance(x, arb):
                    unknown = faced.problem.unknowns[k]
                    raise NotProvenError(
                        f"{faced.problem.name}: {unknown} has balls in {name}: give it a box or a slack"
                    )
                A[row, column_of[name, i, j]] = x * (1 if i == j or _is_equality(faced.problem, name) else 2)
    return A


def _solvable(problem: Problem, A: np.ndarray, weights: np.ndarray, right: np.ndarray) -> tuple[list[int], list[int]]:
    """Independent rows and as many columns, chosen by a pivoted QR of the weighted matrix."""
    import scipy.linalg

    floats = rational.to_float(A) * weights[None, :]
    norms = np.linalg.norm(floats, axis=1)
    rows = [int(r) for r in np.flatnonzero(norms)]
    if any(right[r, 0] != 0 for r in np.flatnonzero(norms == 0)):
        raise NotProvenError(f"{problem.name}: an unknown of the objective is in no condition")
    if not rows:
        return [], []
    _, triangle, pivots = scipy.linalg.qr(floats[rows] / norms[rows, None], mode="economic", pivoting=True)
    diagonal = np.abs(np.diag(triangle))
    count = int((diagonal > 1e-10 * diagonal[0]).sum())
    if count < len(rows):
        rows = [rows[r] for r in linalg.independent_rows(A[rows])]
    if len(rows) != count:
        raise NotProvenError(f"{problem.name}: the equations of the multipliers are too close to dependent")
    return rows, [int(p) for p in pivots[:count]]


def _is_equality(problem: Problem, name: str) -> bool:
    return next(c for c in problem.named if c.name == name).is_equality
