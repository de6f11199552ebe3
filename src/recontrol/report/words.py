"""The vocabulary shown to readers: verdicts, strengths, kinds of reading and ways to compare, each in plain words."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Verdict:
    """A verdict as shown: its sign (never colour alone), what a reader may conclude, and the rule that gives it."""

    name: str
    label: str
    sign: str
    meaning: str
    rule: str


VERDICTS = {
    verdict.name: verdict
    for verdict in (
        Verdict(
            "reproduced",
            "reproduced",
            "✓",
            "The paper's own formulas and data give what is printed.",
            "rule 3: a definition reading says yes",
        ),
        Verdict(
            "reproduced-under-assumption",
            "under assumption",
            "✓?",
            "The paper leaves something open; with the named assumption the print comes out.",
            "rule 4: an assumption reading says yes, and no definition reading does",
        ),
        Verdict(
            "certified",
            "certified",
            "◆",
            "The answer is not unique, so digits are not judged; the published value is proven to satisfy the "
            "paper's condition.",
            "rule 3 or 4 for a claim whose answer is not unique: the published value itself is proven",
        ),
        Verdict(
            "erratum",
            "erratum",
            "≠",
            "The paper's own formulas and data give something else than what is printed.",
            "rule 5: every definition reading says no, or there is none, every assumption says no and an explanation "
            "says yes",
        ),
        Verdict(
            "not-reproduced",
            "not reproduced",
            "✗",
            "No reading that was tried gives what is printed, and none was left undecided.",
            "rule 6: every reading said no and nothing is open",
        ),
        Verdict(
            "unspecified",
            "unspecified",
            "–",
            "The paper does not give enough to compare with; what is missing is listed.",
            "rule 2: the claim has nothing to compare",
        ),
        Verdict(
            "failed",
            "failed",
            "!",
            "The computation broke or stayed undecided. This says nothing about the paper.",
            "rule 1: a reading broke, or nothing fits because something stayed open",
        ),
    )
}

STRENGTHS = {
    "exact": "Rational arithmetic: no rounding anywhere.",
    "ball": "Rigorous ball arithmetic: every rounding error is enclosed.",
    "float": "Floating point with a stated error bound.",
}

KINDS = {
    "definition": "Computes what the paper's own formulas and data say.",
    "assumption": "Fills what the paper leaves open; the assumption is named.",
    "explanation": "A hypothesis how the print came about. It explains an erratum, it never excuses one.",
}

ORIGINS = {"print-or-ocr": "may be the scan's"}

COMPARISONS = {
    "digits": "rounds to the printed digits",
    "cut": "cut off at the printed digits",
    "identity": "exact identity",
    "size": "size of a matrix",
    "statement": "a statement, true or false with a margin",
    "bound": "a printed bound against an enclosure",
    "range": "a word or figure read as an interval",
    "membership": "some member of the rounding boxes satisfies the condition",
    "none": "nothing to compare",
}

AGREES = {
    "yes": ("✓", "agrees"),
    "no": ("✗", "differs"),
    "open": ("?", "undecided"),
    "shown": ("–", "shown"),
    "broken": ("!", "broke"),
}


def counted(name: str) -> str:
    """Return the label of a count, errata that may be the scan's apart."""
    return "erratum (may be the scan's)" if name == "erratum-scan" else verdict(name).label


def verdict(name: str | None) -> Verdict:
    """Return the words for a verdict; an unknown one is shown as it is, never dropped."""
    if name in VERDICTS:
        return VERDICTS[name]
    return Verdict(str(name), str(name), "?", "An unknown verdict.", "no rule")
