"""Gather what a report shows of one paper: artifacts and paper folder; a missing file is shown, never a crash."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import yaml

from recontrol.pipeline import standing
from recontrol.report import numbers, words
from recontrol.report.claim import Claim, dicts


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
        entries = dicts(read_yaml(self.folder / "claims.yaml"))
        content = read_json(self.results / "verdicts.json")
        found = {raw.get("id"): raw for raw in dicts((content or {}).get("claims"))}
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
        return dicts(read_json(self.results / "quantities.json"))

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
    def ensembles(self) -> list[dict[str, Any]]:
        """Robustness campaigns named in paper.yaml, with the distributions of every run and of a large one."""
        return [
            {"name": name, "sizes": [size for target in ("ensemble", "campaign") if (size := self._size(name, target))]}
            for name in self.about.get("campaigns") or {}
        ]

    def _size(self, name: str, target: str) -> dict[str, Any] | None:
        """Distributions of one size of a campaign, the picture files there are, and why it is out of date (or None)."""
        folder = self.results / target
        content = read_json(folder / f"{name}.json")
        if not isinstance(content, dict):
            return None
        files = [suffix for suffix in ("svg", "pdf", "png", "csv") if (folder / f"{name}.{suffix}").is_file()]
        old = standing.overtaken(self.key, name, self.root) if target == "campaign" else None
        return {"target": target, "files": files, "content": content, "overtaken": old}

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
