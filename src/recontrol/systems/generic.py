"""Matrix helpers that work on float arrays and on object arrays of rationals or balls alike.

The entry type of the argument decides: floats go to numpy, everything else to exact or ball linear algebra.
"""

from __future__ import annotations

import numpy as np

Array = np.ndarray


def zeros(like: Array, rows: int, columns: int) -> Array:
    """Zero matrix with the entry type of ``like``."""
    if like.dtype != object:
        return np.zeros((rows, columns))
    out = np.empty((rows, columns), dtype=object)
    out[...] = 0 * like.flat[0]
    return out


def eye(like: Array, n: int) -> Array:
    """Identity matrix with the entry type of ``like``."""
    out = zeros(like, n, n)
    for i in range(n):
        out[i, i] += 1
    return out


def diag(entries: Array) -> Array:
    """Diagonal matrix of a row, column or flat array, of its own entry type."""
    values = np.ravel(entries)
    out = zeros(values, len(values), len(values))
    for i, value in enumerate(values):
        out[i, i] = value
    return out


def solve(M: Array, right: Array) -> Array:
    """X with ``M X = right``: floats, exact, or an enclosure.

    Raises the error of numpy or of `recontrol.exact.linalg` for a singular matrix.
    """
    if M.dtype != object:
        return np.linalg.solve(M, right)
    from recontrol.exact.linalg import solve as exact_solve

    return exact_solve(M, right)


def inverse(M: Array) -> Array:
    """Inverse of a square matrix, see `solve`."""
    return solve(M, eye(M, len(M)))
