"""Exact affine coefficients of a condition: matrices that carry one sparse coefficient matrix for each unknown.

A condition called with these instead of numbers returns M(x) = M_0 + sum_i x_i M_i, with M_0 and M_i in rationals (or
balls, where the data are balls). A product of two matrices that both depend on the unknowns is refused, so the result
is affine by construction, and a constant never touches a coefficient: balls do not widen by cancellation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from flint import arb, fmpq, fmpz

from recontrol.exact import ball, rational

Entries = dict[tuple[int, int], Any]
"""Nonzero entries of a matrix by (row, column)."""


class NotAffineError(ValueError):
    """A condition multiplies two matrices that both depend on the unknowns."""


class AffineMatrix:
    """M_0 + sum_i x_i M_i of shape (m, n).

    `constant` is M_0 as an object matrix; `coefficients` maps i to the nonzero entries of M_i.
    """

    __array_ufunc__ = None  # numpy hands `array @ affine` to __rmatmul__

    def __init__(self, shape: tuple[int, int], constant: np.ndarray | None, coefficients: Mapping[int, Entries]):
        self.shape = shape
        self.constant = rational.zeros(*shape) if constant is None else constant
        self.coefficients = {i: M for i, M in sorted(coefficients.items()) if M}

    def _mapped(self, constant: np.ndarray, change: Callable[[Entries], Entries]) -> AffineMatrix:
        m, n = constant.shape
        return AffineMatrix((m, n), constant, {i: change(M) for i, M in self.coefficients.items()})

    @property
    def T(self) -> AffineMatrix:
        return self._mapped(self.constant.T, lambda M: {(j, i): x for (i, j), x in M.items()})

    def __neg__(self) -> AffineMatrix:
        return self._mapped(-self.constant, lambda M: {place: -x for place, x in M.items()})

    def __getitem__(self, index: Any) -> AffineMatrix:
        if not (isinstance(index, tuple) and len(index) == 2 and all(isinstance(k, slice) for k in index)):
            raise TypeError("index an unknown matrix by two slices, as in Y[0:1, :]")
        rows, columns = (range(size)[k] for size, k in zip(self.shape, index, strict=True))
        at_row, at_column = ({k: p for p, k in enumerate(kept)} for kept in (rows, columns))

        def kept(M: Entries) -> Entries:
            return {(at_row[i], at_column[j]): x for (i, j), x in M.items() if i in at_row and j in at_column}

        return self._mapped(self.constant[index], kept)

    def __add__(self, other: Any) -> AffineMatrix:
        right = lift(other, self.shape)
        if right.shape != self.shape:
            raise ValueError(f"shapes {self.shape} and {right.shape} do not fit a sum; a scalar needs eye(n)")
        total = {i: dict(M) for i, M in self.coefficients.items()}
        for i, M in right.coefficients.items():
            _add(total.setdefault(i, {}), M)
        return AffineMatrix(self.shape, self.constant + right.constant, total)

    def __sub__(self, other: Any) -> AffineMatrix:
        return self + (-lift(other, self.shape))

    def __rsub__(self, other: Any) -> AffineMatrix:
        return (-self) + other

    __radd__ = __add__

    def __matmul__(self, other: Any) -> AffineMatrix:
        right = lift(other)
        if self.shape[1] != right.shape[0]:
            raise ValueError(f"shapes {self.shape} and {right.shape} do not fit a product")
        _check_affine(self, right)
        product = self.constant @ right.constant
        if right.coefficients:
            columns = _lines(self.constant.T)
            return right._mapped(product, lambda M: _times_left(columns, M))
        rows = _lines(right.constant)
        return self._mapped(product, lambda M: _times_right(M, rows))

    def __rmatmul__(self, other: Any) -> AffineMatrix:
        return lift(other) @ self

    def __mul__(self, other: Any) -> AffineMatrix:
        right = lift(other)
        if (1, 1) not in (self.shape, right.shape):
            raise ValueError(f"expected a scalar factor, found shapes {self.shape}, {right.shape}; @ is the product")
        scalar, M = (right, self) if right.shape == (1, 1) else (self, right)
        _check_affine(scalar, M)
        factor, product = scalar.constant[0, 0], scalar.constant[0, 0] * M.constant
        if not scalar.coefficients:
            return M._mapped(product, lambda N: {place: factor * x for place, x in N.items()})
        base = _nonzero(M.constant)
        parts = {i: {p: e[0, 0] * x for p, x in base.items()} for i, e in scalar.coefficients.items()}
        return AffineMatrix(M.shape, product, parts)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> AffineMatrix:
        return self * (1 / _entry(other))

    def trace(self) -> AffineMatrix:
        """Trace as a 1 x 1 affine matrix."""
        total = np.array([[sum(self.constant.diagonal(), fmpq(0))]], dtype=object)

        def diagonal(M: Entries) -> Entries:
            found = [x for (i, j), x in M.items() if i == j]
            return {(0, 0): sum(found, fmpq(0))} if found else {}

        return self._mapped(total, diagonal)

    @staticmethod
    def assemble(rows: list[list[Any]]) -> AffineMatrix:
        """Block matrix of affine and constant blocks whose shapes fit."""
        lifted = [[lift(b) for b in row] for row in rows]
        total: dict[int, Entries] = {}
        top = 0
        for row in lifted:
            left = 0
            for b in row:
                for k, M in b.coefficients.items():
                    total.setdefault(k, {}).update({(top + i, left + j): x for (i, j), x in M.items()})
                left += b.shape[1]
            top += row[0].shape[0]
        return AffineMatrix((top, left), np.block([[b.constant for b in row] for row in lifted]), total)

    def at(self, x: Mapping[int, Any] | list[Any] | np.ndarray) -> np.ndarray:
        """Value at the unknowns ``x``, an object matrix."""
        total = self.constant.copy()
        for i, M in self.coefficients.items():
            for place, entry in M.items():
                total[place] += x[i] * entry
        return total

    def float_at(self, x: Sequence[float] | np.ndarray) -> np.ndarray:
        """Value at float unknowns, midpoints of balls."""
        total = ball.midpoint(self.constant)
        for i, M in self.coefficients.items():
            for place, entry in M.items():
                total[place] += x[i] * ball.midpoint(entry)
        return total

    def congruent(self, W: np.ndarray) -> AffineMatrix:
        """W' M W for an exact W (n, r)."""
        return W.T @ self @ W

    def has_balls(self) -> bool:
        """Whether any entry is a ball."""
        entries = (x for M in self.coefficients.values() for x in M.values())
        return any(isinstance(x, arb) for x in self.constant.flat) or any(isinstance(x, arb) for x in entries)

    def is_symmetric(self) -> bool:
        """Whether constant and coefficients are symmetric (exactly; balls: overlapping)."""
        pairs = [(x, self.constant[j, i]) for (i, j), x in np.ndenumerate(self.constant) if j < i]
        for M in self.coefficients.values():
            pairs += [(x, M.get((j, i), fmpq(0))) for (i, j), x in M.items() if i != j]
        return self.shape[0] == self.shape[1] and all(
            arb(x).overlaps(arb(y)) if isinstance(x, arb) or isinstance(y, arb) else x == y for x, y in pairs
        )


def lift(x: Any, shape: tuple[int, int] | None = None) -> AffineMatrix:
    """A constant as an affine matrix; scalars become 1 x 1 (the integer 0: zero of ``shape``)."""
    if isinstance(x, AffineMatrix):
        return x
    if isinstance(x, int) and x == 0 and shape is not None:
        return AffineMatrix(shape, None, {})
    if isinstance(x, (fmpq, fmpz, int, np.integer, arb)):
        return AffineMatrix((1, 1), np.array([[_entry(x)]], dtype=object), {})
    if isinstance(x, np.ndarray) and x.ndim == 2 and x.dtype.kind in "Oi":
        M = np.empty(x.shape, dtype=object)
        for index in np.ndindex(x.shape):
            M[index] = _entry(x[index])
        return AffineMatrix((x.shape[0], x.shape[1]), M, {})
    raise TypeError(f"expected rationals or balls next to an unknown, found {type(x).__name__}")


def magnitudes(form: AffineMatrix, units: list[fmpq]) -> np.ndarray:
    """Largest modulus of each entry over constant and scaled coefficients."""
    total = np.abs(ball.midpoint(form.constant))
    for i, M in form.coefficients.items():
        unit = float(rational.to_float(units[i]))
        for place, x in M.items():
            total[place] = max(total[place], abs(ball.midpoint(x)) * unit)
    return total


def is_zero(x: Any) -> bool:
    """Whether an entry is the rational zero (a ball never is)."""
    return not isinstance(x, arb) and x == 0


def _entry(x: Any) -> Any:
    return x if isinstance(x, (arb, fmpq)) else rational.rational(x)


def _nonzero(M: np.ndarray) -> Entries:
    return {(i, j): x for (i, j), x in np.ndenumerate(M) if not is_zero(x)}


def _lines(M: np.ndarray) -> list[list[tuple[int, Any]]]:
    """Nonzero entries of every row as (column, value)."""
    return [[(j, x) for j, x in enumerate(row) if not is_zero(x)] for row in M]


def _times_left(columns: list[list[tuple[int, Any]]], M: Entries) -> Entries:
    out: Entries = {}
    for (k, j), x in M.items():
        _add(out, {(i, j): a * x for i, a in columns[k]})
    return out


def _times_right(M: Entries, rows: list[list[tuple[int, Any]]]) -> Entries:
    out: Entries = {}
    for (i, k), x in M.items():
        _add(out, {(i, j): x * a for j, a in rows[k]})
    return out


def _add(total: Entries, M: Entries) -> None:
    """Add entries in place; rational zeros are dropped."""
    for place, x in M.items():
        value = total[place] + x if place in total else x
        if is_zero(value):
            total.pop(place, None)
        else:
            total[place] = value


def _check_affine(a: AffineMatrix, b: AffineMatrix) -> None:
    if a.coefficients and b.coefficients:
        raise NotAffineError("a product of two matrices that both depend on the unknowns: the condition is not affine")
