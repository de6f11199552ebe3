"""One claim and its findings as the report shows them: verdicts.json merged with the entry of claims.yaml."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from recontrol.report import numbers, words
from recontrol.report.mask import selected


@dataclass
class Finding:
    """What one reading found, merged from verdicts.json and the reading's entry in claims.yaml."""

    raw: dict[str, Any]
    entry: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.name: str = str(self.raw.get("reading") or self.entry.get("name") or "?")
        self.kind: str = str(self.raw.get("kind") or self.entry.get("kind") or "?")
        self.agrees: str = _agrees(self.raw.get("agrees"))
        self.value: Any = self.raw.get("value")
        self.strength: str | None = self.raw.get("strength")
        self.error: str | None = self.raw.get("error")
        self.note: str | None = self.raw.get("note") or self.entry.get("note")
        self.compare: str | None = self.raw.get("compare") or self.entry.get("compare")
        self.function: str | None = self.raw.get("function") or self.entry.get("function")
        self.certificate: str | None = self.raw.get("certificate") or self.entry.get("certificate")
        self.evidence: Any = self.raw.get("evidence")
        self.cases: list[tuple[str, dict[str, Any]]] = _cases(self.raw.get("cases"))

    @cached_property
    def source(self) -> tuple[str, int] | None:
        """File (relative to the project) and line of the reading's function."""
        source = self.raw.get("source")
        if isinstance(source, dict) and source.get("file"):
            return str(source["file"]), int(source.get("line") or 1)
        return None

    @cached_property
    def cells(self) -> list[list[numbers.Cell | None]] | None:
        """The numbers found; over cases, those of the first case that disagrees, else of the first."""
        return numbers.decode_text(self.shown.get("value"))

    @cached_property
    def shown(self) -> dict[str, Any]:
        """The record whose numbers stand for the reading: its own, or one of its cases."""
        worst = sorted(self.cases, key=lambda item: item[1].get("agrees") == "yes")
        return worst[0][1] if worst else self.raw

    @cached_property
    def case(self) -> str:
        """The name of the case that stands for the reading; empty without cases."""
        return next((name for name, record in self.cases if record is self.shown), "")

    @cached_property
    def entries(self) -> dict[tuple[int, int], dict[str, Any]]:
        """Compared cells by (row, column) counted from one."""
        found = {}
        for entry in self.shown.get("entries") or []:
            row, _, column = str(entry.get("place", "1,1")).partition(",")
            found[int(row), int(column)] = entry
        return found


def _agrees(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if value in words.AGREES else "open"


def _cases(value: Any) -> list[tuple[str, dict[str, Any]]]:
    if isinstance(value, dict):
        items = [(str(name), case) for name, case in value.items()]
    elif isinstance(value, list):
        items = [
            (str(case.get("case", k)), case) if isinstance(case, dict) else (str(case), {})
            for k, case in enumerate(value, 1)
        ]
    else:
        return []
    return [(name, case if isinstance(case, dict) else {"agrees": case}) for name, case in items]


@dataclass
class Claim:
    """One claim of a paper as the report shows it."""

    paper: str
    raw: dict[str, Any]
    entry: dict[str, Any]
    printed: str | None

    def __post_init__(self) -> None:
        self.id: str = str(self.raw.get("id") or self.entry.get("id") or "?")
        self.where: str = str(self.raw.get("where") or self.entry.get("where") or "")
        self.title: str = str(self.raw.get("title") or self.entry.get("title") or self.id)
        self.unit: str = str(self.raw.get("unit") or self.entry.get("unit") or "")
        self.verdict: str = str(self.raw.get("verdict") or "failed")
        expected = self.raw.get("expected", self.entry.get("expected"))
        self.expected: str | None = expected.get("verdict") if isinstance(expected, dict) else expected
        self.strength: str | None = self.raw.get("strength")
        self.reading: str | None = self.raw.get("reading")
        self.origin: str = str(self.raw.get("origin") or self.entry.get("origin") or "print")
        self.because: str = str(self.raw.get("because") or self.entry.get("because") or "")
        self.compare: str = str(self.raw.get("compare") or self.entry.get("compare") or "")
        self.missing: list[str] = _texts(self.raw.get("missing") or self.entry.get("missing"))
        self.explained_by: list[str] = _texts(self.raw.get("explained_by"))
        self.notes: list[str] = _texts(self.entry.get("notes"))
        entries = {reading.get("name"): reading for reading in dicts(self.entry.get("readings"))}
        self.findings = [Finding(raw, entries.get(raw.get("reading"), {})) for raw in dicts(self.raw.get("findings"))]

    @property
    def identity(self) -> str:
        """The stable identity, such as ``hashim2015/claims/eq55-11``."""
        return f"{self.paper}/claims/{self.id}"

    @property
    def words(self) -> words.Verdict:
        """The verdict in words."""
        return words.verdict(self.verdict)

    @property
    def scanned(self) -> bool:
        """Whether an erratum may be the scan's rather than the print's."""
        return self.origin == "print-or-ocr"

    @property
    def drifted(self) -> bool:
        """Whether the verdict differs from the reviewed one."""
        return self.expected is not None and self.expected != self.verdict

    @cached_property
    def rows(self) -> list[list[str]] | None:
        """The printed cells; ``None`` for words."""
        return None if self.compare in ("statement", "size", "none") else numbers.cells_of_text(self.printed)

    @cached_property
    def mask(self) -> list[list[bool]] | None:
        """Which printed cells the claim is about."""
        if self.rows is None:
            return None
        shape = (len(self.rows), max(map(len, self.rows)))
        return selected(self.entry.get("entries"), self.entry.get("except"), shape)

    @cached_property
    def decisive(self) -> Finding | None:
        """The finding to show first: what contradicts an erratum, else the reading that carries the verdict."""
        named = [finding for finding in self.findings if finding.name == self.reading]
        definitions = [finding for finding in self.findings if finding.kind == "definition"]
        against = [finding for finding in self.findings if finding.kind != "explanation" and finding.agrees == "no"]
        against.sort(key=lambda finding: finding.kind != "definition")
        return next(iter((against if self.verdict == "erratum" else []) + named + definitions + self.findings), None)

    def evidence(self, *names: str) -> str:
        """The first text that a finding gives under one of the names; empty if none does."""
        given = [finding.evidence for finding in self.findings if isinstance(finding.evidence, dict)]
        given += [case for evidence in given for case in dicts(list(evidence.values()))]
        return next((str(found[name]) for found in given for name in names if isinstance(found.get(name), str)), "")

    @property
    def correct(self) -> str:
        """The correct form of an erratum in words or symbols, where a reading names it."""
        return self.evidence("correct form", "correct")

    @property
    def numbers_used(self) -> str:
        """Whether the paper's own numbers used the correct form, where a reading says so."""
        return self.evidence("numbers")

    @cached_property
    def explanations(self) -> list[Finding]:
        """Explanations that agree with the print, the reviewed one first."""
        agreeing = [f for f in self.findings if f.kind == "explanation" and f.agrees == "yes"]
        return sorted(agreeing, key=lambda finding: finding.name not in self.explained_by)


def _texts(value: Any) -> list[str]:
    if value is None or value == "":
        return []
    return [str(item) for item in value] if isinstance(value, list) else [str(value)]


def dicts(value: Any) -> list[dict[str, Any]]:
    """Return the mappings of a list; none for anything else."""
    return [item for item in value if isinstance(item, dict)] if isinstance(value, list) else []
