"""Gather what a report shows of one paper: artifacts and paper folder; a missing file is shown, never a crash."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import yaml

from recontrol.report import numbers, words
from recontrol.report.mask import selected


def read_yaml(path: Path) -> Any:
    """Return a YAML file with every scalar as text; ``None`` if the file is missing or broken."""
    try:
        return yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.BaseLoader)
    except (OSError, yaml.YAMLError):
        return None


def read_json(path: Path) -> Any:
    """Return a JSON artifact; ``None`` if the file is missing or broken."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


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
        entries = {reading.get("name"): reading for reading in _dicts(self.entry.get("readings"))}
        self.findings = [Finding(raw, entries.get(raw.get("reading"), {})) for raw in _dicts(self.raw.get("findings"))]

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


def _dicts(value: Any) -> list[dict[str, Any]]:
    return [item for item in value if isinstance(item, dict)] if isinstance(value, list) else []


@dataclass
class Paper:
    """All that the report shows of one paper."""

    root: Path
    key: str

    @property
    def folder(self) -> Path:
        """The paper folder."""
        return self.root / "papers" / self.key

    @property
    def results(self) -> Path:
        """The folder of its artifacts."""
        return self.root / "results" / self.key

    @cached_property
    def about(self) -> dict[str, Any]:
        """The content of paper.yaml, all scalars text."""
        content = read_yaml(self.folder / "paper.yaml")
        return content if isinstance(content, dict) else {}

    @cached_property
    def claims(self) -> list[Claim]:
        """Every claim of claims.yaml in its order; one without a verdict is shown as failed."""
        entries = _dicts(read_yaml(self.folder / "claims.yaml"))
        content = read_json(self.results / "verdicts.json")
        found = {raw.get("id"): raw for raw in _dicts((content or {}).get("claims"))}
        missing = "No verdict was made: the run stopped before it."
        claims = []
        for entry in entries:
            raw = found.pop(entry.get("id"), None) or {"verdict": "failed", "because": missing}
            claims.append(Claim(self.key, raw, entry, self._printed(raw, entry)))
        claims += [Claim(self.key, raw, {}, self._printed(raw, {})) for raw in found.values()]
        return claims

    def _printed(self, raw: dict[str, Any], entry: dict[str, Any]) -> str | None:
        text = raw.get("printed") or entry.get("printed")
        name = entry.get("data")
        if isinstance(text, list):
            return "\n".join(" ".join(map(str, row)) if isinstance(row, list) else str(row) for row in text)
        if name and (text is None or text == name):
            return self.printed_datum(name)
        return None if text is None else str(text)

    def printed_datum(self, name: str) -> str | None:
        """Return the printed text of a datum or variant of paper.yaml."""
        data, variants = self.about.get("data") or {}, self.about.get("variants") or {}
        if name in variants:
            rows = numbers.cells_of_text(self.printed_datum(variants[name].get("of", "")))
            for place, text in (variants[name].get("patch") or {}).items():
                i, j = (int(part) - 1 for part in place.split(","))
                if rows:
                    rows[i][j] = text
            return "\n".join(" ".join(row) for row in rows) if rows else None
        return (data.get(name) or {}).get("printed")

    @cached_property
    def counts(self) -> dict[str, int]:
        """How many claims have each verdict; errata that may be the scan's are counted apart as ``erratum-scan``."""
        counter = Counter(c.verdict + ("-scan" if c.verdict == "erratum" and c.scanned else "") for c in self.claims)
        order = [name for verdict in words.VERDICTS for name in (verdict, f"{verdict}-scan")]
        return {name: counter[name] for name in [*order, *sorted(set(counter) - set(order))] if counter[name]}

    @cached_property
    def quantities(self) -> list[dict[str, Any]]:
        """The rows of quantities.json."""
        return _dicts(read_json(self.results / "quantities.json"))

    @cached_property
    def certificates(self) -> dict[str, dict[str, Any]]:
        """Certificates by name."""
        files = sorted((self.results / "certificates").glob("*.json"))
        return {path.stem: content for path in files if isinstance(content := read_json(path), dict)}

    @cached_property
    def synthesis(self) -> dict[str, Any]:
        """Synthesis artifacts by part."""
        return {path.stem: read_json(path) for path in sorted((self.results / "synthesis").glob("*.json"))}

    @cached_property
    def figures(self) -> list[dict[str, Any]]:
        """Figures named in paper.yaml, with the files that exist."""
        folder = self.root / "figures" / self.key
        rows = []
        for name, entry in (self.about.get("figures") or {}).items():
            files = [suffix for suffix in ("svg", "pdf", "png", "csv") if (folder / f"{name}.{suffix}").is_file()]
            words_of = entry if isinstance(entry, dict) else {}
            rows.append({"name": name, "title": name, "caption": "", "of": "finding", "files": files, **words_of})
        return rows

    @cached_property
    def notes(self) -> str:
        """The text of NOTES.md."""
        path = self.folder / "NOTES.md"
        return path.read_text(encoding="utf-8") if path.is_file() else ""

    @cached_property
    def solvers(self) -> list[dict[str, Any]]:
        """Every solver record found in the synthesis artifacts, with the place where it stands."""
        return list(_records(self.synthesis, "", _is_solver))

    @cached_property
    def agreements(self) -> list[dict[str, Any]]:
        """Every comparison of solvers found in the synthesis artifacts, with its place."""
        return list(_records(self.synthesis, "", lambda value: {"agrees", "spread", "solvers"} <= set(value)))


def _records(value: Any, place: str, wanted: Callable[[dict[str, Any]], bool]) -> Iterator[dict[str, Any]]:
    if isinstance(value, list):
        items = [(str(k + 1), item) for k, item in enumerate(value)]
    elif isinstance(value, dict):
        items = list(value.items())
        if wanted(value):
            yield {"place": place, **value}
    else:
        return
    for name, item in items:
        yield from _records(item, f"{place}/{name}" if place else str(name), wanted)


def _is_solver(value: dict[str, Any]) -> bool:
    return "solver" in value and bool({"outcome", "status"} & set(value))
