"""Would a misprint be noticed? Every printed digit of the claims that agree is changed in turn, to each other digit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from flint import fmpq

from recontrol.claims.compare import agreement, combine
from recontrol.claims.printed import Cell, Number, Printed, parse_mask
from recontrol.claims.schema import Claim
from recontrol.claims.verdict import Finding, derive
from recontrol.paper import Paper

AGREEING = ("reproduced", "reproduced-under-assumption", "certified")
DIGITWISE = ("digits", "cut")
"""Ways to compare in which every digit decides."""
REASONS = {
    "bound": "a bound: with this digit it is another bound that the found value also keeps",
    "range": "a figure that is read as a stated interval",
    "identity": "a formula: the identity is decided from its symbols",
    "size": "a size in words, compared as two whole numbers",
    "statement": "a sentence: its margins are compared, and its figures stand in the reading",
    "membership": "a question about whole rounding boxes: another digit would need another proof",
}


@dataclass(frozen=True)
class Misprint:
    """One digit of one cell replaced: the claim's print as it would then stand."""

    place: str
    cell: str
    printed: Printed


def misprints(claim: Claim, paper: Paper) -> Iterator[Misprint]:
    """Every print that differs from the claim's in one digit of one compared cell."""
    printed = claim.printed_value(paper)
    mask = parse_mask(claim.entries, claim.except_, printed.shape)
    for i, row in enumerate(printed.rows):
        for j, cell in enumerate(row):
            if mask[i, j]:
                for text in _changed(cell.text):
                    cells = [list(r) for r in printed.rows]
                    cells[i][j] = Cell.parse(text)
                    yield Misprint(f"{i + 1},{j + 1}", text, replace(printed, rows=tuple(map(tuple, cells))))


def _changed(text: str) -> Iterator[str]:
    mantissa = text.lower().partition("e")[0] if "j" not in text and "i" not in text else text
    for position, character in enumerate(mantissa):
        if character.isdigit():
            yield from (text[:position] + digit + text[position + 1 :] for digit in "0123456789" if digit != character)


def verdict_with(claim: Claim, record: dict[str, Any], misprint: Misprint) -> str:
    """The verdict that the recorded findings would give if the paper printed the misprint instead."""
    findings = []
    for reading, finding in zip(claim.readings, record["findings"], strict=True):
        how = reading.compare or claim.compare
        groups = [case["entries"] for case in finding["cases"]] or [finding["entries"]]
        agrees = finding["agrees"]
        if how in (*DIGITWISE, "bound") and any(groups):
            holds = reading.over.holds if reading.over else "all"
            agrees = combine([_agrees(claim, how, entries, misprint) for entries in groups], holds)
        findings.append(Finding(reading.name, reading.kind, agrees, finding["strength"]))
    return derive(claim.compare, claim.unique, findings).verdict


@dataclass
class Survey:
    """What changing the digits of a paper's agreeing claims did.

    changed: prints with one other digit whose verdict differs. kept: (claim, print, reason) of those whose verdict
    stays. aside: claim -> reason, for agreeing claims whose print is not compared as a number.
    """

    claims: int = 0
    changed: int = 0
    kept: list[tuple[str, str, str]] = field(default_factory=list)
    aside: dict[str, str] = field(default_factory=dict)


def survey(paper: Paper, claims: list[Claim], records: dict[str, dict[str, Any]]) -> Survey:
    """Change every digit of every agreeing claim; ``records`` are those of verdicts.json by claim."""
    found = Survey()
    for claim in claims:
        verdict = records[claim.id]["verdict"]
        if verdict not in AGREEING:
            continue
        if claim.compare not in (*DIGITWISE, "bound"):
            found.aside[claim.id] = REASONS[claim.compare]
            continue
        found.claims += 1
        for misprint in misprints(claim, paper):
            if verdict_with(claim, records[claim.id], misprint) != verdict:
                found.changed += 1
            else:
                found.kept.append((claim.id, misprint.cell, REASONS.get(claim.compare, "")))
    return found


def _agrees(claim: Claim, how: str, entries: list[dict[str, Any]], misprint: Misprint) -> str:
    results = []
    for entry in entries:
        if entry["place"] != misprint.place:
            results.append(entry["agrees"])
            continue
        parts = Cell.parse(misprint.cell).parts
        ends = [(_rational(low), _rational(high)) for low, high in entry["enclosure"]]
        exact = misprint.printed.exact
        for number, (low, high) in zip(parts, ends, strict=True):
            results.append(agreement(claim, how, number, low, high, exact))
    return combine(results)


def _rational(text: str) -> fmpq:
    return Number.parse(text).value
