"""The verdict: derived from the findings of a claim, by the first rule that fits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from recontrol.claims.values import weakest

BROKEN = "broken"


@dataclass(frozen=True)
class Finding:
    """What one reading found: agrees is yes, no, open, shown (nothing compared) or broken."""

    reading: str
    kind: str
    agrees: str
    strength: str
    value: Any = None
    units_in_last_place: float | None = None
    digits: int | None = None
    cases: list[dict[str, Any]] = field(default_factory=list)
    certificate: str | None = None


@dataclass(frozen=True)
class Verdict:
    """Verdict of a claim: which readings carry it, at which strength, and which explanations agree."""

    verdict: str
    strength: str | None
    reading: str | None
    explanations: tuple[str, ...] = ()


def derive(compare: str, unique: bool, findings: Sequence[Finding]) -> Verdict:
    """Apply the verdict rules in their order.

    1 failed, 2 unspecified, 3 reproduced, 4 reproduced-under-assumption (3 and 4 become certified where the answer is
    not unique), 5 erratum, 6 not-reproduced; whatever is left is failed because something stayed open.
    """
    definitions = [f for f in findings if f.kind == "definition"]
    assumptions = [f for f in findings if f.kind == "assumption"]
    explanations = [f for f in findings if f.kind == "explanation" and f.agrees == "yes"]
    explained = tuple(f.reading for f in explanations)
    if any(f.agrees == BROKEN for f in findings):
        return Verdict("failed", None, None)
    if compare == "none":
        return Verdict("unspecified", None, None)
    for group, name in ((definitions, "reproduced"), (assumptions, "reproduced-under-assumption")):
        agreeing = [f for f in group if f.agrees == "yes"]
        if agreeing:
            best = agreeing[0]
            return Verdict(name if unique else "certified", best.strength, best.reading, explained)
    if definitions and _all_no(definitions):
        return Verdict("erratum", weakest([f.strength for f in definitions]), definitions[0].reading, explained)
    if not definitions and _all_no(assumptions) and explanations:
        carrying = [*assumptions, *explanations]
        return Verdict("erratum", weakest([f.strength for f in carrying]), explained[0], explained)
    if findings and _all_no(findings):
        return Verdict("not-reproduced", weakest([f.strength for f in findings]), findings[0].reading)
    return Verdict("failed", None, None)


def _all_no(findings: Iterable[Finding]) -> bool:
    return all(f.agrees == "no" for f in findings)
