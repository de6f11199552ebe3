"""Unknowns of a matrix inequality: shape, symmetry, structure, and how they unroll into a vector of scalars."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi.affine import AffineMatrix, Entries


@dataclass(frozen=True)
class Variable:
    """A matrix unknown: entry (i, j) is ``sign * x[k]`` for the triple of `entries`, else zero.

    ``shape == ()`` is a scalar. Made by `symmetric`, `full`, `scalar`, `diagonal`, `skew`, `patterned`.
    """

    shape: tuple[int, ...]
    entries: tuple[tuple[int, int, int, int], ...]  # (row, column, unknown, sign)
    size: int
    is_symmetric: bool = False

    @property
    def matrix_shape(self) -> tuple[int, int]:
        """(1, 1) for a scalar."""
        return (self.shape[0], self.shape[1]) if self.shape else (1, 1)

    def matrix(self, x: Any) -> Any:
        """Matrix (or scalar) of the vector of unknowns ``x`` (size,), floats or rationals."""
        exact = isinstance(x, list) or np.asarray(x).dtype == object
        out = rational.zeros(*self.matrix_shape) if exact else np.zeros(self.matrix_shape)
        for i, j, k, sign in self.entries:
            out[i, j] = x[k] if sign > 0 else -x[k]
        return out if self.shape else out[0, 0]

    def vector(self, M: Any) -> np.ndarray:
        """Unknowns (size,) of a float matrix, averaging the places that share one (projection on the structure)."""
        M = np.asarray(M, dtype=float).reshape(self.matrix_shape)
        total, count = np.zeros(self.size), np.zeros(self.size)
        for i, j, k, sign in self.entries:
            total[k] += sign * M[i, j]
            count[k] += 1
        return total / count

    def exact_vector(self, M: Any) -> list[fmpq]:
        """Unknowns of an exact matrix; raises ValueError if it does not have the structure."""
        M = M if isinstance(M, np.ndarray) else np.array([[rational.rational(M)]], dtype=object)
        if M.shape != self.matrix_shape:
            raise ValueError(f"expected shape {self.matrix_shape}, found {M.shape}")
        x: list[Any] = [None] * self.size
        for i, j, k, sign in self.entries:
            x[k] = M[i, j] * sign
        if any(M[index] != value for index, value in np.ndenumerate(np.atleast_2d(self.matrix(x)))):
            raise ValueError("the matrix does not have the structure (symmetry, zero pattern) of its variable")
        return x

    def affine(self, first: int) -> AffineMatrix:
        """The unknown as an affine matrix; its scalars are numbered from ``first``."""
        terms: dict[int, Entries] = {}
        for i, j, k, sign in self.entries:
            terms.setdefault(first + k, {})[i, j] = fmpq(sign)
        return AffineMatrix(self.matrix_shape, None, terms)

    def basis(self) -> Any:
        """Sparse (rows * columns, size) matrix with vec(V) = basis @ x, row-major."""
        import scipy.sparse

        (_, n) = self.matrix_shape
        rows = [i * n + j for i, j, _, _ in self.entries]
        columns = [k for _, _, k, _ in self.entries]
        signs = [float(sign) for _, _, _, sign in self.entries]
        return scipy.sparse.csc_array((signs, (rows, columns)), shape=(int(np.prod(self.matrix_shape)), self.size))

    def names(self, name: str) -> list[str]:
        """Names of the scalars: "eps", "X[1,2]" (1-based)."""
        if not self.shape:
            return [name]
        out = [""] * self.size
        for i, j, k, _ in reversed(self.entries):
            out[k] = f"{name}[{i + 1},{j + 1}]"
        return out


def scalar() -> Variable:
    """A scalar unknown."""
    return Variable((), ((0, 0, 0, 1),), 1)


def full(m: int, n: int) -> Variable:
    """A full matrix unknown (m, n)."""
    return patterned(np.ones((m, n), dtype=bool))


def symmetric(n: int) -> Variable:
    """A symmetric matrix unknown (n, n) with n(n+1)/2 scalars."""
    return patterned(np.ones((n, n), dtype=bool), symmetric=True)


def diagonal(n: int) -> Variable:
    """A diagonal matrix unknown (n, n) with n scalars."""
    return patterned(np.eye(n, dtype=bool), symmetric=True)


def repeated(sizes: list[int]) -> Variable:
    """A diagonal matrix unknown with one scalar for each block of ``sizes``, repeated along that block."""
    places = [k for k, size in enumerate(sizes) for _ in range(size)]
    n = len(places)
    return Variable((n, n), tuple((i, i, k, 1) for i, k in enumerate(places)), len(sizes), is_symmetric=True)


def skew(n: int) -> Variable:
    """A skew-symmetric matrix unknown (n, n) with n(n-1)/2 scalars."""
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    entries = [e for k, (i, j) in enumerate(pairs) for e in ((i, j, k, 1), (j, i, k, -1))]
    return Variable((n, n), tuple(entries), len(pairs))


def patterned(mask: Any, *, symmetric: bool = False) -> Variable:
    """A matrix unknown that is zero where ``mask`` (m, n) is false, symmetric if asked.

    Raises ValueError for a symmetric unknown whose mask is not.
    """
    mask = np.asarray(mask, dtype=bool)
    if symmetric and not (mask.shape[0] == mask.shape[1] and (mask == mask.T).all()):
        raise ValueError("the mask of a symmetric unknown must be square and symmetric")
    entries: list[tuple[int, int, int, int]] = []
    count = 0
    for i, j in np.ndindex(mask.shape):
        if not mask[i, j] or (symmetric and j < i):
            continue
        entries.append((i, j, count, 1))
        if symmetric and j > i:
            entries.append((j, i, count, 1))
        count += 1
    return Variable(mask.shape, tuple(entries), count, is_symmetric=symmetric)


def block_diagonal(variables: list[Variable]) -> Variable:
    """A matrix unknown with ``variables`` along its diagonal."""
    rows = columns = size = 0
    entries: list[tuple[int, int, int, int]] = []
    for v in variables:
        entries += [(rows + i, columns + j, size + k, sign) for i, j, k, sign in v.entries]
        rows, columns, size = rows + v.matrix_shape[0], columns + v.matrix_shape[1], size + v.size
    return Variable((rows, columns), tuple(entries), size, all(v.is_symmetric for v in variables))


def offsets(variables: Mapping[str, Variable]) -> dict[str, int]:
    """Number of the first scalar of each variable in the joint vector of unknowns."""
    out, count = {}, 0
    for name, variable in variables.items():
        out[name] = count
        count += variable.size
    return out
