"""Numbers of the artifacts as text: decoding, rounding to a printed form, and the digits that differ.

Only the standard library is used, in exact fractions, so that the command line starts fast and the pages have the same
bytes everywhere.  Nothing here decides a verdict.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

_REAL = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_REAL_ONLY = re.compile(_REAL)
DECIMAL = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+(?:[eE][+-]?\d{1,3})?|[eE][+-]?\d{1,3})(?=[ij]?(?:[^\w.]|\.(?!\d)|$))")
_COMPLEX = re.compile(rf"(?P<re>{_REAL})(?P<sign>\+-|\+/-|±|[+-])(?P<im>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[ij]")


@dataclass(frozen=True)
class Cell:
    """One decoded number: real and imaginary part as fractions, and the radius or error bound beside it."""

    re: Fraction
    im: Fraction | None = None
    radius: Fraction | None = None


@dataclass(frozen=True)
class Print:
    """One printed real number: its text, value, decimals and exponent (``None`` without e-notation)."""

    text: str
    value: Fraction
    decimals: int
    exponent: int | None

    @property
    def unit(self) -> Fraction:
        """One unit of the last printed place."""
        return Fraction(10) ** ((self.exponent or 0) - self.decimals)


def parse_print(text: str) -> Print | None:
    """Return the printed real number in ``text``, or ``None`` if it is not one."""
    if not _REAL_ONLY.fullmatch(text):
        return None
    mantissa, _, exponent = text.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return Print(text, Fraction(text), decimals, int(exponent) if exponent else None)


def split_pair(text: str) -> tuple[str, str, str] | None:
    """Return (real text, sign text, imaginary text) of a printed complex number or conjugate pair."""
    match = _COMPLEX.fullmatch(text.replace(" ", ""))
    return (match["re"], match["sign"], match["im"]) if match else None


def is_number(text: str) -> bool:
    """Say whether ``text`` is one printed number, real or complex."""
    return parse_print(text) is not None or split_pair(text) is not None


def cells_of_text(text: str | None) -> list[list[str]] | None:
    """Return the rows of a printed number or matrix, or ``None`` when the text is words.

    A cell ``.`` (nothing printed there, or not part of the claim) is allowed in a matrix.
    """
    if not isinstance(text, str) or not text.strip():
        return None
    rows = [re.sub(r"\s*,\s*", " ", line).split() for line in text.strip().splitlines() if line.strip()]
    cells = [cell for row in rows for cell in row]
    if not any(is_number(cell) for cell in cells) or not all(is_number(cell) or cell == "." for cell in cells):
        return None
    return rows


def to_fraction(value: Any) -> Fraction | None:
    """Return a scalar of an artifact (number or text such as ``p/q``) as a fraction, ``None`` if it is not one."""
    if isinstance(value, bool) or value is None:
        return None
    if isinstance(value, int):
        return Fraction(value)
    if isinstance(value, float):
        return Fraction(repr(value)) if value == value and abs(value) != float("inf") else None
    if isinstance(value, str):
        try:
            return Fraction(value.strip())
        except (ValueError, ZeroDivisionError):
            return None
    return None


def _nested(value: Any) -> list[list[Any]] | None:
    """Return scalars, vectors and matrices alike as rows; ``None`` for deeper nesting or ragged mixtures."""
    if not isinstance(value, list):
        return [[value]]
    if not value:
        return None
    if all(isinstance(row, list) for row in value):
        return value if all(not isinstance(cell, list) for row in value for cell in row) else None
    return [value] if all(not isinstance(cell, list) for cell in value) else None


def _zip_cells(mid: Any, radius: Any = None, imaginary: Any = None) -> list[list[Cell]] | None:
    grids = [None if part is None else _nested(part) for part in (mid, radius, imaginary)]
    if grids[0] is None:
        return None
    rows: list[list[Cell]] = []
    for i, row in enumerate(grids[0]):
        rows.append([])
        for j, value in enumerate(row):
            parts = [_at(grid, i, j) for grid in grids]
            if isinstance(value, dict):
                inner = decode(value)
                if inner is None or len(inner) != 1 or len(inner[0]) != 1:
                    return None
                cell = inner[0][0]
                rows[-1].append(cell if parts[2] is None else Cell(cell.re, parts[2], cell.radius))
                continue
            if parts[0] is None:
                return None
            rows[-1].append(Cell(parts[0], parts[2], parts[1]))
    return rows


def _at(grid: list[list[Any]] | None, i: int, j: int) -> Fraction | None:
    if grid is None:
        return None
    row = grid[min(i, len(grid) - 1)]
    value = row[min(j, len(row) - 1)] if row else None
    if isinstance(value, dict):
        inner = decode(value)
        return inner[0][0].re if inner else None
    return to_fraction(value)


def _cell_of_text(text: str) -> Cell | None:
    pair = split_pair(text)
    if pair is None:
        return None if text == "." else Cell(Fraction(text))
    return Cell(Fraction(pair[0]), Fraction(pair[2]) * (-1 if pair[1] == "-" else 1))


def decode_text(text: str | None) -> list[list[Cell | None]] | None:
    """Return a found value that verdicts.json gives as text; a cell ``.`` is one that was not compared."""
    rows = cells_of_text(text)
    return None if rows is None else [[_cell_of_text(cell) for cell in row] for row in rows]


def decode(value: Any) -> list[list[Cell]] | None:
    """Return an encoded number or matrix of an artifact as rows of cells; ``None`` if it is something else."""
    if not isinstance(value, dict):
        return _zip_cells(value)
    if "exact" in value:
        return _zip_cells(value["exact"])
    if "ball" in value and isinstance(value["ball"], dict):
        return _zip_cells(value["ball"].get("mid"), value["ball"].get("rad"))
    if "complex" in value and isinstance(value["complex"], dict):
        return _zip_cells(value["complex"].get("re"), None, value["complex"].get("im"))
    if set(value) == {"re", "im"}:
        return _zip_cells(value["re"], None, value["im"])
    if set(value) == {"value", "error"}:
        inner = value["value"]
        if isinstance(inner, dict):
            return decode(inner)
        return _zip_cells(inner, value["error"])
    return None


def fixed(value: Fraction, decimals: int) -> str:
    """Return ``value`` with that many decimals, ties to even, ``-0`` written as ``0``."""
    scaled = round(value * 10**decimals)
    sign, digits = "-" if scaled < 0 else "", str(abs(scaled)).rjust(decimals + 1, "0")
    return f"{sign}{digits[:-decimals]}.{digits[-decimals:]}" if decimals else sign + digits


def rounded_text(text: str, digits: int = 6) -> str:
    """Return a text with every decimal number rounded to that many significant digits.

    Integers, rationals and what only looks like a number inside a word (a digest) stay as they are.
    """
    return DECIMAL.sub(lambda match: significant(Fraction(match[0]), digits), text)


def magnitude(value: Fraction) -> int:
    """Return e with 10^e <= abs(value) < 10^(e+1); 0 for zero."""
    if value == 0:
        return 0
    value = abs(value)
    exponent = len(str(value.numerator)) - len(str(value.denominator))
    while Fraction(10) ** exponent > value:
        exponent -= 1
    while Fraction(10) ** (exponent + 1) <= value:
        exponent += 1
    return exponent


def significant(value: Fraction, digits: int = 6) -> str:
    """Return ``value`` to that many significant digits, in e-notation when it is very large or small."""
    if value == 0:
        return "0"
    exponent = magnitude(value)
    if -5 <= exponent < max(digits, 7):
        text = fixed(value, max(digits - 1 - exponent, 0))
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa = fixed(value / Fraction(10) ** exponent, digits - 1)
    if mantissa.lstrip("-").startswith("10"):
        exponent, mantissa = exponent + 1, mantissa.replace("10.", "1.0", 1)[:-1]
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return f"{mantissa}e{exponent:+03d}"


def like(value: Fraction, model: Print, extra: int = 0) -> str:
    """Return ``value`` written as ``model`` is printed, with ``extra`` further decimals."""
    if model.exponent is None:
        return fixed(value, model.decimals + extra)
    tail = re.sub(r"^[^eE]*", "", model.text)
    return fixed(value / Fraction(10) ** model.exponent, model.decimals + extra) + tail


def write_like(cell: Cell, printed: str, extra: int = 0) -> str:
    """Return a found number written in the form of the printed one (complex pairs part by part)."""
    pair = split_pair(printed)
    if pair:
        re_print, im_print = parse_print(pair[0]), parse_print(pair[2])
        if re_print and im_print:
            imaginary = abs(cell.im or Fraction(0)) if pair[1] in ("+-", "+/-", "±") else (cell.im or Fraction(0))
            sign = "±" if pair[1] in ("+-", "+/-", "±") else ("-" if imaginary < 0 else "+")
            return f"{like(cell.re, re_print, extra)}{sign}{like(abs(imaginary), im_print, extra)}i"
    model = parse_print(printed)
    return like(cell.re, model, extra) if model and cell.im is None else write(cell)


def write(cell: Cell, digits: int = 6) -> str:
    """Return a found number to a sensible number of digits, not more than its radius allows."""
    if cell.im is None:
        return significant(cell.re, _trusted(cell.re, cell.radius, digits))
    sign = "-" if cell.im < 0 else "+"
    return f"{significant(cell.re, digits)}{sign}{significant(abs(cell.im), digits)}i"


def _trusted(value: Fraction, radius: Fraction | None, digits: int) -> int:
    if not radius or value == 0:
        return digits
    return max(1, min(digits, magnitude(value) - magnitude(radius)))


def pretty_print(text: str) -> str:
    """Return a printed cell with the conjugate pair sign written as one character."""
    return text.replace("+/-", "±").replace("+-", "±")


def distance(cell: Cell, printed: str) -> Fraction | None:
    """Return found minus printed in units of the last printed place (the larger part of a complex number)."""
    pair = split_pair(printed)
    if pair:
        re_print, im_print = parse_print(pair[0]), parse_print(pair[2])
        if re_print is None or im_print is None:
            return None
        conjugate = pair[1] in ("+-", "+/-", "±")
        im_value = -im_print.value if pair[1] == "-" else im_print.value
        im_found = cell.im or Fraction(0)
        parts = (
            (cell.re - re_print.value) / re_print.unit,
            ((abs(im_found) if conjugate else im_found) - im_value) / im_print.unit,
        )
        return max(parts, key=abs)
    model = parse_print(printed)
    if model is None or cell.im is not None:
        return None
    return (cell.re - model.value) / model.unit


def mark(text: str, other: str) -> list[tuple[str, bool]]:
    """Split ``text`` into (piece, differs) against ``other``: all that follows the first differing place differs.

    The two are aligned at the decimal point; a different sign makes everything differ.
    """
    if text == other:
        return [(text, False)]
    if text[-1:] == other[-1:] == "i":
        return [*mark(text[:-1], other[:-1]), ("i", False)]
    if text.startswith("-") != other.startswith("-"):
        return [(text, True)]
    head, other_head = re.split(r"[.e]", text, maxsplit=1)[0], re.split(r"[.e]", other, maxsplit=1)[0]
    if len(head) != len(other_head):
        return [(text, True)]
    same = 0
    while same < min(len(text), len(other)) and text[same] == other[same]:
        same += 1
    pieces = [(text[:same], False), (text[same:], True)]
    return [piece for piece in pieces if piece[0]]
