"""Linear algebra on exact and ball matrices (object arrays of fmpq and arb).

Everything here is decided without rounding: exact for rationals; for balls a statement holds for every real matrix
inside the box, or the answer is None.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, arb_mat, fmpq

from recontrol.exact.ball import assert_rigorous, has_balls, to_ball
from recontrol.exact.rational import from_flint, identity, to_fmpq_mat, zeros


class SingularError(ValueError):
    """A linear system has no unique solution, or the balls are too wide to exclude that."""


class NotSymmetricError(ValueError):
    """A matrix that should be symmetric is not."""


def _check_square(A: np.ndarray, name: str) -> int:
    if A.ndim != 2 or A.shape[0] != A.shape[1]:
        raise ValueError(f"{name}: expected a square matrix, found shape {A.shape}")
    return A.shape[0]


def check_symmetric(A: np.ndarray, name: str = "matrix") -> int:
    """Order of the symmetric matrix ``A``; rational entries must agree exactly, balls must overlap.

    Raises NotSymmetricError with the first entry that disagrees.
    """
    n = _check_square(A, name)
    for i in range(n):
        for j in range(i):
            x, y = A[i, j], A[j, i]
            same = x.overlaps(arb(y)) if isinstance(x, arb) else y.overlaps(arb(x)) if isinstance(y, arb) else x == y
            if not same:
                raise NotSymmetricError(f"{name}: entries ({i + 1},{j + 1}) and ({j + 1},{i + 1}) differ: {x} and {y}")
    return n


def ldl(A: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit lower triangular L (n, n) and pivots d (n,) with A = L diag(d) L', without pivoting.

    For rationals exact. For balls, L and d enclose the factors of every symmetric matrix in the box (lower triangle).
    Raises SingularError when a pivot is zero or its ball contains zero before the last column.
    """
    n = check_symmetric(A)
    work, L = A.copy(), identity(n)
    d = np.empty(n, dtype=object)
    for k in range(n):
        d[k] = work[k, k]
        if k + 1 == n:
            break
        if not (d[k] > 0 or d[k] < 0):
            raise SingularError(f"pivot {k + 1} is not separated from zero: {d[k]}")
        column = work[k + 1 :, k]
        L[k + 1 :, k] = column * (1 / d[k])
        for j in range(k + 1, n):
            factor = L[j, k]
            if type(factor) is fmpq and factor == 0:
                continue
            work[j:, j] -= factor * column[j - k - 1 :]
    return L, d


def definiteness(A: np.ndarray) -> bool | None:
    """Whether the symmetric matrix ``A`` is positive definite, by L D L'.

    True: proven (for balls: every symmetric matrix of the box). False: proven that it is not (for balls: none of the
    box is). None: the balls are too wide. Rationals never give None.
    """
    n = check_symmetric(A)
    work = A.copy()
    for k in range(n):
        pivot = work[k, k]
        if pivot <= 0:
            return False
        if not pivot > 0:
            return None
        column = work[k + 1 :, k]
        scaled = column * (1 / pivot)
        for j in range(k + 1, n):
            factor = scaled[j - k - 1]
            if type(factor) is fmpq and factor == 0:
                continue
            work[j:, j] -= factor * column[j - k - 1 :]
    return True


def is_positive_definite(A: np.ndarray) -> bool:
    """Proof that ``A`` > 0: rationals exactly; balls for every symmetric matrix of the box. False means "not proven".

    A rational matrix is tried in ball arithmetic first (cheap), exactly if the balls cannot tell.
    """
    assert_rigorous(A)
    check_symmetric(A)
    if has_balls(A):
        return definiteness(A) is True
    quick = definiteness(to_ball(A))
    return definiteness(A) is True if quick is None else quick


def _arb_mat(A: np.ndarray) -> arb_mat:
    return arb_mat(to_ball(A).tolist())


def solve(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """X (n, k) with A X = B, exact for rationals, an enclosure for balls. Raises SingularError."""
    _check_square(A, "A")
    try:
        if has_balls(A) or has_balls(B):
            return from_flint(_arb_mat(A).solve(_arb_mat(B)))
        return from_flint(to_fmpq_mat(A).solve(to_fmpq_mat(B)))
    except ZeroDivisionError as error:
        raise SingularError("the matrix is singular, or its balls do not exclude that") from error


def inverse(A: np.ndarray) -> np.ndarray:
    """Inverse (n, n), exact or enclosed. Raises SingularError."""
    return solve(A, identity(_check_square(A, "A")))


def determinant(A: np.ndarray) -> Any:
    """Determinant as fmpq or arb."""
    _check_square(A, "A")
    return _arb_mat(A).det() if has_balls(A) else to_fmpq_mat(A).det()


def rank(A: np.ndarray) -> int:
    """Rank of a rational matrix."""
    return to_fmpq_mat(A).rank()


def independent_rows(A: np.ndarray) -> list[int]:
    """Indices of the first maximal set of linearly independent rows of a rational matrix."""
    reduced, r = to_fmpq_mat(A.T).rref()
    pivots, row = [], 0
    for j in range(A.shape[0]):
        if row < r and reduced[row, j] != 0:
            pivots.append(j)
            row += 1
    return pivots


def nullspace(A: np.ndarray) -> np.ndarray:
    """Basis (n, n - rank) of the null space of a rational matrix, as columns."""
    reduced, r = to_fmpq_mat(A).rref()
    n = A.shape[1]
    pivots: list[int] = []
    for j in range(n):
        if len(pivots) < r and reduced[len(pivots), j] != 0:
            pivots.append(j)
    free = [j for j in range(n) if j not in pivots]
    basis = zeros(n, len(free))
    for column, j in enumerate(free):
        basis[j, column] = fmpq(1)
        for row, p in enumerate(pivots):
            basis[p, column] = -reduced[row, j]
    return basis


def lyapunov(A: np.ndarray, Q: np.ndarray) -> np.ndarray:
    """Symmetric X (n, n) with A X + X A' + Q = 0, for symmetric Q; exact or enclosed. Raises SingularError.

    Only the n(n+1)/2 different entries are unknowns, so the result is symmetric as stored.
    """
    n = _check_square(A, "A")
    check_symmetric(Q, "Q")
    pairs = [(i, j) for i in range(n) for j in range(i + 1)]
    place = {pair: k for k, pair in enumerate(pairs)} | {(j, i): k for k, (i, j) in enumerate(pairs)}
    operator, right = zeros(len(pairs)), zeros(len(pairs), 1)
    for row, (i, j) in enumerate(pairs):
        for k in range(n):
            operator[row, place[k, j]] += A[i, k]
            operator[row, place[i, k]] += A[j, k]
        right[row, 0] = -Q[i, j]
    x = solve(operator, right)
    out = np.empty((n, n), dtype=object)
    for (i, j), k in place.items():
        out[i, j] = x[k, 0]
    return out
