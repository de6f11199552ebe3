"""Print and finding of a claim in a line, for tables: the verdict book and the page of a paper."""

from __future__ import annotations

import re

from recontrol.report import numbers, present
from recontrol.report.claim import Claim

DIGITS = 4
"""Significant digits of a margin. Margins are given only where they refute a print beyond rounding errors: others may
depend on the point that a solver happened to return."""


def printed(claim: Claim) -> str:
    """Return the print in short: the cells of the claim, or words."""
    cells = present.printed_cells(claim)
    if not cells:
        return " ".join((claim.printed or "").split())
    if len(cells) > 4:
        return f"{len(cells)} entries"
    return ", ".join(numbers.pretty_print(cell) for cell in cells)


def found(claim: Claim) -> str:
    """Return what was found in short, to digits that do not depend on the solver."""
    finding = claim.decisive
    if finding is None or claim.verdict == "unspecified":
        return ""
    if present.mixed(finding):
        return present.cases_text(finding)
    compared = present.compared(claim, finding)
    if 0 < len(compared) <= 4:
        # The places of a printed limit say nothing about what was found.
        bound = (finding.compare or claim.compare) == "bound"
        return ", ".join(numbers.write(c, DIGITS) if bound else numbers.write_like(c, text) for c, text in compared)
    text = numbers.rounded_text(present.found_text(claim, finding), DIGITS)
    if " = " not in text:
        return text.partition("; ")[0]  # what a certificate was rebuilt from stands in the claim's evidence
    margin = re.search(r" = \S*\d", text) is not None
    if margin and (claim.verdict != "erratum" or claim.strength == "float"):
        return {"yes": "holds", "no": "does not hold"}.get(finding.agrees, finding.agrees)
    return text
