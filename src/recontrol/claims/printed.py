"""Printed text -> exact decimals and closed rounding intervals.

A printed result stands for the closed interval of half a unit of its last place either side; exact text (problem data,
set-points) stands for the decimal itself. Nothing passes through a float.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import flint
import numpy as np

from recontrol.errors import PaperError

_DECIMAL = r"[+-]?\d+(?:\.\d*)?(?:[eE][+-]?\d{1,3})?"
_NUMBER = re.compile(_DECIMAL, re.ASCII)
_COMPLEX = re.compile(
    rf"(?P<re>{_DECIMAL})(?P<sign>\+-|\+|-)(?P<im>\d+(?:\.\d*)?(?:[eE][+-]?\d{{1,3}})?)[ij]", re.ASCII
)
MAX_DIGITS = 60


@dataclass(frozen=True)
class Number:
    """One printed decimal: `value` exact, `unit` one unit of its last printed place, `digits` significant digits."""

    text: str
    value: flint.fmpq
    unit: flint.fmpq
    digits: int

    @staticmethod
    def parse(text: str) -> Number:
        """Raises ValueError for anything but a plain or scientific decimal."""
        if not _NUMBER.fullmatch(text) or len(text) > MAX_DIGITS:
            raise ValueError(f"{text!r} is not a decimal number")
        mantissa, _, exponent = text.lower().partition("e")
        whole, _, fraction = mantissa.lstrip("+-").partition(".")
        power = int(exponent or 0) - len(fraction)
        scale = flint.fmpq(10) ** power
        sign = -1 if mantissa.startswith("-") else 1
        significant = len((whole + fraction).lstrip("0"))
        return Number(text, sign * int(whole + fraction) * scale, scale, significant)


@dataclass(frozen=True)
class Cell:
    """One cell of a printed matrix: a number, or a complex number, or a conjugate pair (`pair`)."""

    text: str
    real: Number
    imag: Number | None = None
    pair: bool = False

    @staticmethod
    def parse(text: str) -> Cell:
        """A decimal, or a pair a+-bi of conjugates. Raises ValueError for anything else."""
        match = _COMPLEX.fullmatch(text)
        if match is None:
            return Cell(text, Number.parse(text))
        pair = match["sign"] == "+-"
        imag = Number.parse(match["im"] if match["sign"] != "-" else "-" + match["im"])
        return Cell(text, Number.parse(match["re"]), imag, pair)

    @property
    def parts(self) -> tuple[Number, ...]:
        """The real part, and the imaginary part of a pair."""
        return (self.real,) if self.imag is None else (self.real, self.imag)


@dataclass(frozen=True)
class Printed:
    """A printed scalar or matrix. `rows` holds the cells; `exact` says that the decimals are meant exactly."""

    rows: tuple[tuple[Cell, ...], ...]
    exact: bool = False

    @staticmethod
    def parse(text: str, exact: bool = False) -> Printed:
        """Rows are lines, cells are separated by white space. Raises PaperError for ragged or unreadable text."""
        rows = []
        for line in text.strip().splitlines():
            try:
                rows.append(tuple(Cell.parse(word) for word in line.split()))
            except ValueError as error:
                raise PaperError(f"printed text: {error}; expected decimals like -0.0250, 3.036e+02 or a+-bi") from None
        if not rows or not rows[0]:
            raise PaperError("printed text: empty; expected at least one number")
        widths = {len(row) for row in rows}
        if len(widths) > 1:
            raise PaperError(f"printed text: rows have {sorted(widths)} cells; every row needs the same number")
        return Printed(tuple(rows), exact)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return len(self.rows), len(self.rows[0])

    @property
    def is_scalar(self) -> bool:
        """One row, one column."""
        return self.shape == (1, 1)

    @property
    def is_complex(self) -> bool:
        """Whether any cell has an imaginary part."""
        return any(cell.imag is not None for row in self.rows for cell in row)

    @cached_property
    def values(self) -> Any:
        """Exact decimals, object array (rows, columns) of fmpq. Raises PaperError if a cell is complex."""
        return self._array(lambda number: number.value)

    @cached_property
    def halves(self) -> Any:
        """Half units of the last printed places (zero where exact), object array of fmpq."""
        zero = flint.fmpq(0)
        return self._array(lambda number: zero if self.exact else number.unit / 2)

    def _array(self, pick: Any) -> Any:
        if self.is_complex:
            raise PaperError("printed text holds complex cells; use Data.printed(name) for these")
        array = np.empty(self.shape, dtype=object)
        for i, row in enumerate(self.rows):
            for j, cell in enumerate(row):
                array[i, j] = pick(cell.real)
        return array

    def patched(self, patch: dict[str, str]) -> Printed:
        """A copy with single cells replaced; keys are 1-based "row,column". Raises PaperError for a wrong place."""
        rows = [list(row) for row in self.rows]
        for place, text in patch.items():
            i, j = parse_place(place, self.shape)
            try:
                rows[i][j] = Cell.parse(text)
            except ValueError as error:
                raise PaperError(f"patch {place}: {error}") from None
        return replace(self, rows=tuple(tuple(row) for row in rows))


def parse_place(place: str, shape: tuple[int, int]) -> tuple[int, int]:
    """1-based "row,column" -> 0-based indices. Raises PaperError if malformed or outside `shape`."""
    match = re.fullmatch(r"\s*(\d{1,6})\s*,\s*(\d{1,6})\s*", place)
    if match is None:
        raise PaperError(f"entry {place!r}; expected 'row,column' counted from 1")
    i, j = int(match[1]) - 1, int(match[2]) - 1
    if not (0 <= i < shape[0] and 0 <= j < shape[1]):
        raise PaperError(f"entry {place!r} lies outside the {shape[0]} x {shape[1]} matrix")
    return i, j


def parse_mask(entries: str | None, without: str | None, shape: tuple[int, int]) -> Any:
    """Boolean array of the entries that count.

    `entries` and `without` are lists "rows,columns" separated by ";", each an index, a range a:b or ":" (1-based, ends
    included). Raises PaperError if malformed, outside the matrix or if nothing is left.
    """
    mask = np.zeros(shape, dtype=bool) if entries else np.ones(shape, dtype=bool)
    if entries:
        for part in entries.split(";"):
            mask[_region(part, shape)] = True
    if without:
        for part in without.split(";"):
            mask[_region(part, shape)] = False
    if not mask.any():
        raise PaperError(f"mask entries={entries!r} except={without!r} leaves no entry to compare")
    return mask


def _region(part: str, shape: tuple[int, int]) -> tuple[slice, slice]:
    pieces = [piece.strip() for piece in part.split(",")]
    if len(pieces) != 2:
        raise PaperError(f"mask {part!r}; expected 'rows,columns' such as '1:4,1' or '2,:'")
    slices = []
    for piece, size, axis in zip(pieces, shape, ("row", "column"), strict=True):
        match = re.fullmatch(r"(\d{1,6})(?::(\d{1,6}))?|:", piece)
        if match is None:
            raise PaperError(f"mask {part!r}: {piece!r} is not an index, a range a:b or ':'")
        first = int(match[1]) if match[1] else 1
        last = int(match[2]) if match[2] else (first if match[1] else size)
        if not 1 <= first <= last <= size:
            raise PaperError(f"mask {part!r}: {axis} range {piece!r} does not fit a {shape[0]} x {shape[1]} matrix")
        slices.append(slice(first - 1, last))
    return slices[0], slices[1]
