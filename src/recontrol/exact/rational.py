"""Exact rational matrices: numpy object arrays of ``flint.fmpq``.

Decimals of a paper are exact numbers; they are parsed as text and never pass through a float. The arrays work with
``@``, ``.T``, ``+``, ``-`` and products with ``fmpq`` or ``int`` scalars. A float in an operation raises ``TypeError``,
which is wanted: it keeps rounding errors out of a proof.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from flint import arb_mat, fmpq, fmpq_mat, fmpz

_DECIMAL = re.compile(r"([+-]?)(\d*)(?:\.(\d*))?(?:[eE]([+-]?\d+))?")
_FRACTION = re.compile(r"([+-]?\d+)/(\d+)")

ExactLike: TypeAlias = fmpq | fmpz | int | str | Fraction


class NotExactError(TypeError):
    """A value that should be rational is a float, a ball or something else."""


def decimal(text: str) -> fmpq:
    """Rational value of a decimal (``"-0.0250"``, ``"3.036e+02"``, ``"7"``) or fraction (``"1/3"``) given as text.

    Raises ValueError if the text is neither.
    """
    stripped = text.strip()
    if match := _FRACTION.fullmatch(stripped):
        return fmpq(int(match[1]), int(match[2]))
    match = _DECIMAL.fullmatch(stripped)
    if match is None or not (match[2] or match[3]):
        raise ValueError(f"expected a decimal such as '-0.0250' or '3.0e+02', found {text!r}")
    sign, whole, fraction, exponent = match[1], match[2] or "", match[3] or "", int(match[4] or 0)
    shift = exponent - len(fraction)
    digits = int(whole + fraction) * (-1 if sign == "-" else 1)
    return fmpq(digits * 10**shift) if shift >= 0 else fmpq(digits, 10**-shift)


def rational(value: ExactLike) -> fmpq:
    """``value`` (int, fmpz, fmpq, Fraction or decimal text) as fmpq; raises NotExactError for floats and balls."""
    if isinstance(value, fmpq):
        return value
    if isinstance(value, str):
        return decimal(value)
    if isinstance(value, bool):
        raise NotExactError("expected an exact number, found a truth value")
    if isinstance(value, (int, fmpz, np.integer)):
        return fmpq(int(value))
    if isinstance(value, Fraction):
        return fmpq(value.numerator, value.denominator)
    raise NotExactError(f"expected an exact number (int, fmpq, decimal text), found {type(value).__name__} {value!r}")


def matrix(rows: str | Sequence[Any] | np.ndarray) -> np.ndarray:
    """Exact matrix (m, n) from a text block (rows are lines, cells white space), nested sequences or an array.

    Cells are anything `rational` takes. A flat sequence gives one row. Raises ValueError for ragged rows.
    """
    if isinstance(rows, str):
        cells: list[list[Any]] = [line.split() for line in rows.strip().splitlines() if line.strip()]
    else:
        nested = list(rows)
        cells = [list(r) for r in nested] if nested and _is_row(nested[0]) else [nested]
    lengths = {len(row) for row in cells}
    if len(lengths) != 1:
        raise ValueError(f"expected rows of equal length, found lengths {[len(row) for row in cells]}")
    out = np.empty((len(cells), lengths.pop()), dtype=object)
    for i, row in enumerate(cells):
        for j, cell in enumerate(row):
            out[i, j] = rational(cell)
    return out


def _is_row(item: Any) -> bool:
    return isinstance(item, (list, tuple)) or (isinstance(item, np.ndarray) and item.ndim == 1)


def zeros(m: int, n: int | None = None) -> np.ndarray:
    """Exact zero matrix (m, n), square if ``n`` is left out."""
    out = np.empty((m, m if n is None else n), dtype=object)
    out[...] = fmpq(0)
    return out


def identity(n: int) -> np.ndarray:
    """Exact identity matrix (n, n)."""
    out = zeros(n)
    for i in range(n):
        out[i, i] = fmpq(1)
    return out


def diagonal(entries: Iterable[ExactLike]) -> np.ndarray:
    """Exact diagonal matrix of ``entries``."""
    values = [rational(e) for e in entries]
    out = zeros(len(values))
    for i, value in enumerate(values):
        out[i, i] = value
    return out


def to_float(A: Any) -> Any:
    """Nearest double of an fmpq, or of each entry of an exact array (float64 array of the same shape)."""
    if isinstance(A, np.ndarray):
        return np.array([_float(x) for x in A.flat], dtype=float).reshape(A.shape)
    return _float(A)


def _float(x: ExactLike) -> float:
    q = rational(x)
    return int(q.p) / int(q.q)


def from_float(A: Any) -> Any:
    """The exact (dyadic) value of each float: no rounding. Raises ValueError for NaN and infinity."""
    if isinstance(A, np.ndarray):
        return _like(A, [from_float(float(x)) for x in A.flat])
    return fmpq(*float(A).as_integer_ratio())


def rounded(A: Any, decimals: int) -> Any:
    """Floats or rationals rounded to ``decimals`` decimals (ties to even), as fmpq or exact array.

    This is the way from a solver's point to a rational witness. Raises ValueError for NaN and infinity.
    """
    if isinstance(A, np.ndarray):
        return _like(A, [rounded(x, decimals) for x in A.flat])
    exact = A if isinstance(A, fmpq) else from_float(A)
    scale = 10**decimals
    return fmpq(round(Fraction(int(exact.p) * scale, int(exact.q))), scale)


def _like(A: np.ndarray, values: list[Any]) -> np.ndarray:
    out = np.empty(A.size, dtype=object)
    out[:] = values
    return out.reshape(A.shape)


def symmetric_part(A: np.ndarray) -> np.ndarray:
    """(A + A') / 2 of a square exact matrix."""
    return (A + A.T) * fmpq(1, 2)


def trace_product(A: np.ndarray, B: np.ndarray) -> Any:
    """Tr(A' B), the inner product <A, B> of two object matrices of one shape; exact zeros of ``A`` are skipped."""
    total: Any = fmpq(0)
    for x, y in zip(A.flat, B.flat, strict=True):
        if type(x) is not fmpq or x != 0:
            total = total + x * y
    return total


def to_fmpq_mat(A: np.ndarray) -> fmpq_mat:
    """The flint matrix of an exact object matrix; raises NotExactError for other entries."""
    return fmpq_mat([[rational(x) for x in row] for row in A])


def from_flint(M: fmpq_mat | arb_mat) -> np.ndarray:
    """Object matrix of the entries of a flint matrix."""
    out = np.empty((M.nrows(), M.ncols()), dtype=object)
    out[...] = M.tolist()
    return out


def text(A: Any) -> Any:
    """``"p/q"`` of a rational, nested lists of such text for an array."""
    if isinstance(A, np.ndarray):
        return [text(row) for row in A]
    q = rational(A)
    return f"{q.p}" if q.q == 1 else f"{q.p}/{q.q}"
