"""Compare two runs: verdicts, findings, quantities and figure data that are not the same."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from recontrol.errors import MissingArtifactError
from recontrol.report import artifacts, values
from recontrol.report.collect import read_json


def between(first: Path, second: Path) -> list[str]:
    """Return one line for each difference, none if the runs agree.

    A run is a project folder, or its results folder. Floats count as equal when they agree to six significant digits.
    Raises MissingArtifactError for a folder without results.
    """
    a, b = _load(first), _load(second)
    lines = []
    for name in sorted(a.keys() | b.keys()):
        if name not in a or name not in b:
            lines.append(f"{name:<44} only in {first if name in a else second}")
        elif artifacts.canonical(a[name]) != artifacts.canonical(b[name]):
            lines.append(f"{name:<44} {_short(a[name])}  ->  {_short(b[name])}")
    return lines


def _load(run: Path) -> dict[str, Any]:
    results = run / "results" if (run / "results").is_dir() else run
    papers = sorted(path.parent for path in results.glob("*/verdicts.json"))
    if not papers:
        raise MissingArtifactError(f"{run}: holds no results/<paper>/verdicts.json; give the folder of a finished run")
    found: dict[str, Any] = {}
    for folder in papers:
        found |= _claims(folder) | _quantities(folder)
        found |= _figures(results.parent / "figures" / folder.name)
    return found


def _claims(folder: Path) -> dict[str, Any]:
    claims = (read_json(folder / "verdicts.json") or {}).get("claims") or []
    return {
        f"{folder.name}/claims/{claim['id']}": {
            key: claim.get(key) for key in ("verdict", "strength", "reading", "found")
        }
        for claim in claims
    }


def _quantities(folder: Path) -> dict[str, Any]:
    rows = read_json(folder / "quantities.json") or []
    names = ("/".join(filter(None, [folder.name, "quantities", row["name"], row.get("case")])) for row in rows)
    return {name: row.get("value") for name, row in zip(names, rows, strict=True)}


def _figures(folder: Path) -> dict[str, str]:
    files = sorted(folder.glob("*.csv"))
    return {f"{folder.name}/figures/{path.stem}": path.read_text(encoding="utf-8") for path in files}


def _short(value: Any) -> str:
    if isinstance(value, dict) and "verdict" in value:
        found = values.one_line(value.get("found"))
        return f"{value['verdict']} [{value.get('strength')}] {found}".strip()
    text = values.one_line(value)
    return text if len(text) <= 60 else text[:57] + "..."
