"""Exact affine coefficients of a condition: matrices that carry one coefficient matrix for each unknown.

A condition called with these instead of numbers returns M(x) = M_0 + sum_i x_i M_i, with M_0 and M_i in rationals (or
balls, where the data are balls). A product of two matrices that both depend on the unknowns is refused, so the result
is affine by construction, and a constant never touches a coefficient: balls do not widen by cancellation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from flint import arb, fmpq, fmpz

from recontrol.exact import rational

CONSTANT = -1


class NotAffineError(ValueError):
    """A condition multiplies two matrices that both depend on the unknowns."""


class AffineMatrix:
    """M_0 + sum_i x_i M_i of shape (m, n); `terms` maps i to M_i (object matrix), CONSTANT to M_0, zeros left out."""

    __array_ufunc__ = None  # numpy hands `array @ affine` to __rmatmul__

    def __init__(self, shape: tuple[int, int], terms: Mapping[int, np.ndarray]):
        self.shape = shape
        self.terms = {i: M for i, M in terms.items() if not _is_zero(M)}

    def _map(self, function: Callable[[np.ndarray], np.ndarray], shape: tuple[int, int]) -> AffineMatrix:
        return AffineMatrix(shape, {i: function(M) for i, M in self.terms.items()})

    @property
    def T(self) -> AffineMatrix:
        return self._map(lambda M: M.T, self.shape[::-1])

    def __neg__(self) -> AffineMatrix:
        return self._map(lambda M: -M, self.shape)

    def __getitem__(self, index: Any) -> AffineMatrix:
        if not (isinstance(index, tuple) and len(index) == 2):
            raise TypeError("index an unknown matrix by rows and columns, as in Y[0:1, :]")
        rows, columns = (slice(k, k + 1) if isinstance(k, int) and k != -1 else k for k in index)
        probe = np.empty(self.shape, dtype=bool)[rows, columns]
        if probe.ndim != 2:
            raise TypeError("index an unknown matrix by slices, as in Y[0:1, :]")
        return self._map(lambda M: M[rows, columns], probe.shape)

    def __add__(self, other: Any) -> AffineMatrix:
        right = lift(other, self.shape)
        if right.shape != self.shape:
            if self.shape == (1, 1):
                raise ValueError(f"a scalar plus a matrix of shape {right.shape}: multiply it by eye(n) first")
            raise ValueError(f"shapes {self.shape} and {right.shape} do not fit a sum")
        terms = dict(self.terms)
        for i, M in right.terms.items():
            terms[i] = terms[i] + M if i in terms else M
        return AffineMatrix(self.shape, terms)

    def __sub__(self, other: Any) -> AffineMatrix:
        return self + (-lift(other, self.shape))

    def __rsub__(self, other: Any) -> AffineMatrix:
        return (-self) + other

    __radd__ = __add__

    def __matmul__(self, other: Any) -> AffineMatrix:
        right = lift(other)
        if self.shape[1] != right.shape[0]:
            raise ValueError(f"shapes {self.shape} and {right.shape} do not fit a product")
        return _product(self, right, np.matmul, (self.shape[0], right.shape[1]))

    def __rmatmul__(self, other: Any) -> AffineMatrix:
        return lift(other) @ self

    def __mul__(self, other: Any) -> AffineMatrix:
        right = lift(other)
        if (1, 1) not in (self.shape, right.shape):
            raise ValueError(
                f"expected a scalar factor, found shapes {self.shape} and {right.shape}; use @ for products"
            )
        shape = right.shape if self.shape == (1, 1) else self.shape
        return _product(self, right, _scale, shape)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> AffineMatrix:
        return self * (1 / (other if isinstance(other, arb) else rational.rational(other)))

    def trace(self) -> AffineMatrix:
        """Trace as a 1 x 1 affine matrix."""
        return self._map(lambda M: np.array([[sum(M.diagonal(), fmpq(0))]], dtype=object), (1, 1))

    @staticmethod
    def assemble(rows: list[list[Any]]) -> AffineMatrix:
        """Block matrix of affine and constant blocks whose shapes fit."""
        lifted = [[lift(b) for b in row] for row in rows]
        heights, widths = [row[0].shape[0] for row in lifted], [b.shape[1] for b in lifted[0]]
        shape = (sum(heights), sum(widths))
        terms: dict[int, np.ndarray] = {}
        for i, row in enumerate(lifted):
            top = sum(heights[:i])
            for j, b in enumerate(row):
                left = sum(widths[:j])
                for k, M in b.terms.items():
                    if k not in terms:
                        terms[k] = rational.zeros(*shape)
                    terms[k][top : top + heights[i], left : left + widths[j]] = M
        return AffineMatrix(shape, terms)

    def at(self, x: Mapping[int, Any] | list[Any] | np.ndarray) -> np.ndarray:
        """Value at the rational unknowns ``x``, an object matrix."""
        total = self.constant().copy()
        for i, M in self.terms.items():
            if i != CONSTANT:
                total = total + x[i] * M
        return total

    def constant(self) -> np.ndarray:
        """M_0 as an object matrix."""
        return self.terms[CONSTANT] if CONSTANT in self.terms else rational.zeros(*self.shape)

    def coefficients(self) -> dict[int, np.ndarray]:
        """M_i by unknown, in order."""
        return {i: self.terms[i] for i in sorted(self.terms) if i != CONSTANT}


def lift(x: Any, shape: tuple[int, int] | None = None) -> AffineMatrix:
    """A constant as an affine matrix; scalars become 1 x 1 (the integer 0: zero of ``shape``)."""
    if isinstance(x, AffineMatrix):
        return x
    if isinstance(x, int) and x == 0 and shape is not None:
        return AffineMatrix(shape, {})
    if isinstance(x, (fmpq, fmpz, int, np.integer, arb)):
        return AffineMatrix((1, 1), {CONSTANT: np.array([[_entry(x)]], dtype=object)})
    if isinstance(x, np.ndarray) and x.ndim == 2 and x.dtype.kind in "Oi":
        M = np.empty(x.shape, dtype=object)
        for index in np.ndindex(x.shape):
            M[index] = _entry(x[index])
        return AffineMatrix(x.shape, {CONSTANT: M})
    raise TypeError(f"expected rationals or balls next to an unknown, found {type(x).__name__}")


def _entry(x: Any) -> Any:
    return x if isinstance(x, (arb, fmpq)) else rational.rational(x)


def _is_zero(M: np.ndarray) -> bool:
    return all(type(x) is fmpq and x == 0 for x in M.flat)


def _scale(M: np.ndarray, N: np.ndarray) -> np.ndarray:
    return M[0, 0] * N if M.shape == (1, 1) else M * N[0, 0]


def _product(
    a: AffineMatrix, b: AffineMatrix, times: Callable[..., np.ndarray], shape: tuple[int, int]
) -> AffineMatrix:
    if set(a.terms) - {CONSTANT} and set(b.terms) - {CONSTANT}:
        raise NotAffineError("a product of two matrices that both depend on the unknowns: the condition is not affine")
    terms: dict[int, np.ndarray] = {}
    for i, M in a.terms.items():
        for j, N in b.terms.items():
            k = i if j == CONSTANT else j
            value = times(M, N)
            terms[k] = terms[k] + value if k in terms else value
    return AffineMatrix(shape, terms)
