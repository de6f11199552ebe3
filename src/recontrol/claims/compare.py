"""Ways to compare: a value and a printed text -> agrees yes, no or open, with strength and distances."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import flint
import numpy as np

from recontrol.claims.printed import Cell, Number, Printed, parse_mask
from recontrol.claims.scalars import as_matrix, decimal_end, describe, is_complex, matrix_text, middle, real_and_imag
from recontrol.claims.schema import Claim
from recontrol.claims.values import (
    Certified,
    Identity,
    Membership,
    Size,
    Statement,
    enclosure,
    strength_of,
    weakest,
)
from recontrol.errors import ValueContractError
from recontrol.paper import Paper

YES, NO, OPEN = "yes", "no", "open"


@dataclass(frozen=True)
class Entry:
    """One compared cell: where, printed text, found midpoint (text), distances.

    enclosure: outward-rounded decimal ends (low, high) of the found value, one pair for each part of the cell (real; or
    real and imaginary).
    """

    place: str
    printed: str
    found: str
    agrees: str
    difference: float
    units_in_last_place: float
    digits: int
    digits_printed: int
    enclosure: list[tuple[str, str]]


@dataclass(frozen=True)
class Outcome:
    """Agreement of one value with one claim."""

    agrees: str
    strength: str
    found: str
    units_in_last_place: float | None = None
    digits: int | None = None
    entries: list[Entry] = field(default_factory=list)


def compare(claim: Claim, how: str, value: Any, paper: Paper) -> Outcome:
    """Hold `value` against the claim. Raises ValueContractError if the value does not suit the way to compare."""
    if how == "none":
        return Outcome("shown", _strength(value), describe(value))
    if isinstance(value, Certified):
        if how != "statement":
            raise ValueContractError(f"a certificate answers compare: statement, not {how}")
        return Outcome(YES if value.holds else OPEN, value.strength, value.why)
    expected_type = {"identity": Identity, "size": Size, "statement": Statement, "membership": Membership}.get(how)
    if expected_type is not None:
        if not isinstance(value, expected_type):
            raise ValueContractError(f"compare: {how} needs a {expected_type.__name__}, got {type(value).__name__}")
        decide: Any = {"identity": _identity, "size": _size, "statement": _statement, "membership": _membership}[how]
        return decide(claim, value)
    if how == "range":
        return _range(claim, value)
    return _numeric(claim, how, value, claim.printed_value(paper))


def combine(agreements: list[str], holds: str = "all") -> str:
    """Yes, no or open of several parts that must hold in `all` or in `any`."""
    decisive, other = (NO, YES) if holds == "all" else (YES, NO)
    if decisive in agreements:
        return decisive
    return OPEN if OPEN in agreements else other


def _numeric(claim: Claim, how: str, value: Any, printed: Printed) -> Outcome:
    found = as_matrix(value, printed.shape)
    mask = parse_mask(claim.entries, claim.except_, printed.shape)
    places = list(zip(*(axis.tolist() for axis in np.nonzero(mask)), strict=True))
    strengths = [strength_of(found[place]) for place in places]
    entries = []
    for i, j in places:
        entries.append(_entry(claim, how, printed.rows[i][j], found[i, j], f"{i + 1},{j + 1}", printed.exact))
    return Outcome(
        agrees=combine([entry.agrees for entry in entries]),
        strength=weakest(strengths),
        found=matrix_text(
            [
                [describe(found[i, j]) if mask[i, j] else "." for j in range(printed.shape[1])]
                for i in range(printed.shape[0])
            ]
        ),
        units_in_last_place=max(entry.units_in_last_place for entry in entries),
        digits=min((entry.digits for entry in entries if entry.digits_printed), default=None),
        entries=entries,
    )


def _entry(claim: Claim, how: str, cell: Cell, found: Any, place: str, exact: bool) -> Entry:
    parts = _parts(cell, found)
    ends = [enclosure(part) for _, part in parts]
    agrees = combine([agreement(claim, how, number, *end, exact) for (number, _), end in zip(parts, ends, strict=True)])
    distances = [abs(middle(part) - number.value) for number, part in parts]
    units = [float(d / number.unit) for d, (number, _) in zip(distances, parts, strict=True)]
    return Entry(
        place=place,
        printed=cell.text,
        found=describe(found),
        agrees=agrees,
        difference=float(max(distances)),
        units_in_last_place=max(units),
        digits=min((_digits(n, d) for d, (n, _) in zip(distances, parts, strict=True) if n.digits), default=0),
        digits_printed=min((number.digits for number, _ in parts if number.digits), default=0),
        enclosure=[(decimal_end(low, down=True), decimal_end(high, down=False)) for low, high in ends],
    )


def _parts(cell: Cell, found: Any) -> list[tuple[Number, Any]]:
    if cell.imag is None:
        if is_complex(found):
            raise ValueContractError(f"printed {cell.text!r} is real, the reading returned a complex value")
        return [(cell.real, found)]
    real, imag = real_and_imag(found)
    return [(cell.real, real), (cell.imag, imag)]


def agreement(claim: Claim, how: str, number: Number, low: Any, high: Any, exact: bool) -> str:
    """Yes, no or open: an enclosure [low, high] of rationals against one printed number."""
    if how == "cut":
        return _agrees_cut(number, low, high)
    half = flint.fmpq(0) if exact else number.unit / 2
    below, above = number.value - half, number.value + half
    if how == "bound":
        if claim.bound == "<=":
            return YES if high <= above else NO if low > above else OPEN
        return YES if low >= below else NO if high < below else OPEN
    if low >= below and high <= above:
        return YES
    return NO if high < below or low > above else OPEN


def _agrees_cut(number: Number, low: Any, high: Any) -> str:
    if number.value == 0:
        if -number.unit < low and high < number.unit:
            return YES
        return NO if low >= number.unit or high <= -number.unit else OPEN
    if number.value < 0:
        low, high = -high, -low
    size = abs(number.value)
    if low >= size and high < size + number.unit:
        return YES
    return NO if high < size or low >= size + number.unit else OPEN


def _range(claim: Claim, value: Any) -> Outcome:
    assert claim.range is not None
    below, above = (Number.parse(text).value for text in claim.range)
    low, high = enclosure(value)
    agrees = YES if low >= below and high <= above else NO if high < below or low > above else OPEN
    return Outcome(agrees, strength_of(value), describe(value))


def _statement(claim: Claim, value: Statement) -> Outcome:
    margins = value.named()
    if not margins:
        raise ValueContractError("a statement without margins states nothing")
    agreements = []
    for margin in margins.values():
        low, high = enclosure(margin)
        holds = low > 0 or (not value.strict and low >= 0)
        fails = high < 0 or (value.strict and high <= 0)
        agreements.append(YES if holds else NO if fails else OPEN)
    strength = weakest([strength_of(margin) for margin in margins.values()])
    found = "; ".join(f"{name} = {describe(margin)}" for name, margin in margins.items())
    return Outcome(combine(agreements, "any" if value.any else "all"), strength, found)


def _identity(claim: Claim, value: Identity) -> Outcome:
    from recontrol.claims.identity import equal

    same = equal(value.left, value.right)
    return Outcome(YES if same else NO, "exact", "equal" if same else "differs")


def _size(claim: Claim, value: Size) -> Outcome:
    words = (claim.printed or "").lower().replace("×", "x").split("x")
    try:
        rows, columns = (int(word) for word in words)
    except ValueError:
        raise ValueContractError(f"compare: size needs printed like '4x1', found {claim.printed!r}") from None
    same = (rows, columns) == (value.rows, value.columns)
    return Outcome(YES if same else NO, "exact", f"{value.rows}x{value.columns}")


def _membership(claim: Claim, value: Membership) -> Outcome:
    words = {True: "found", False: "proven impossible", None: "open"}[value.inside]
    return Outcome({True: YES, False: NO, None: OPEN}[value.inside], value.strength, value.why or words)


def _digits(number: Number, distance: Any) -> int:
    """Leading significant digits of the print with which a value at this distance agrees."""
    for dropped in range(number.digits):
        if distance <= number.unit * 10**dropped / 2:
            return number.digits - dropped
    return 0


def _strength(value: Any) -> str:
    if isinstance(value, (Membership, Certified)):
        return value.strength
    if isinstance(value, Statement):
        return weakest([strength_of(margin) for margin in value.named().values()])
    if isinstance(value, (Identity, Size)):
        return "exact"
    if isinstance(value, np.ndarray):
        return weakest([strength_of(scalar) for scalar in value.ravel()])
    return strength_of(value)
