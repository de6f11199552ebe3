"""Small proofs about ball matrices that the bounds of ensembles share."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import acb_mat, arb

from recontrol.exact.linalg import is_positive_definite
from recontrol.exact.rational import from_float, identity

Array = Any


def largest_eigenvalue(form: Array) -> arb:
    """Proven upper bound of the largest eigenvalue of a positive semidefinite ball matrix (n, n), stored symmetric."""
    largest = max(float(np.linalg.eigvalsh(_middle(form)).max()), 1e-300)
    for slack in (1e-12, 1e-9, 1e-6, 1e-3, 1.0):
        level = arb(from_float(largest * (1 + slack)))
        if is_positive_definite(level * identity(len(form)) - form):
            return level
    return sum((arb(abs(form[i, i]).upper()) for i in range(len(form))), arb(0))


def least_eigenvalue(form: Array) -> arb:
    """Proven lower bound, at least 0, of the least eigenvalue of a positive semidefinite ball matrix (n, n)."""
    least = float(np.linalg.eigvalsh(_middle(form)).min())
    for slack in (1e-9, 1e-6, 1e-3, 0.1):
        level = arb(from_float(max(least, 0.0) * (1 - slack)))
        if level > 0 and is_positive_definite(form - level * identity(len(form))):
            return level
    return arb(0)


def spectral_norm(A: Array) -> arb:
    """Proven upper bound of the largest singular value of a ball or exact matrix."""
    product = A.T @ A if A.shape[0] >= A.shape[1] else A @ A.T
    return arb(largest_eigenvalue(mirrored(product + arb(0))).sqrt().upper())


def mirrored(form: Array) -> Array:
    """A matrix that is symmetric but for rounding, with both halves the same balls."""
    form = form.copy()
    for i, j in zip(*np.tril_indices(len(form), -1), strict=True):
        form[j, i] = form[i, j]
    return form


def row_norm(A: acb_mat, row: int) -> arb:
    """Upper bound of the length of a row; of the sum's upper end, since a ball around zero has no real root."""
    return arb(sum((abs(A[row, j]) ** 2 for j in range(A.ncols())), arb(0)).upper()).sqrt()


def diagonal(entries: list[Any]) -> list[list[Any]]:
    """Rows of a diagonal matrix."""
    return [[x if i == j else 0 * x for j, x in enumerate(entries)] for i in range(len(entries))]


def _middle(form: Array) -> Array:
    return np.array([[float(x.mid()) for x in row] for row in form])
