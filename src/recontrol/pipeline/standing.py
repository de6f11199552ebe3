"""Whether a large campaign still belongs to the present code and artifacts.

`all` neither makes nor renews large campaigns, so the report shows what is there, says how large it is, and marks what
an edit has overtaken. The rule `report` takes `large_campaigns` as a parameter: it runs again when one appears or ages.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from recontrol.pipeline import closure, store
from recontrol.pipeline.encode import sha256
from recontrol.pipeline.layout import distribution_file


def overtaken(key: str, name: str, root: Path | str = ".") -> str | None:
    """Why the large campaign of a paper no longer describes it, or None if it does. Call it for one that exists."""
    base = Path(root)
    record = _record(base, distribution_file(key, name, "campaign"))
    if record is None:
        return "it has no record of how it was made"
    if record.get("code") != code_digest(key, base):
        return "its code was edited since"
    for path, digest in record.get("inputs", {}).items():
        if "/ensemble/" in path:
            continue
        present = _record(base, Path(path))
        if present is None or present.get("sha256") != digest:
            return f"{path} was made anew since"
    return None


@cache
def code_digest(key: str, root: Path) -> str:
    """Digest of the code of a paper's campaigns, as the runner records it."""
    return closure.digest_of(closure.code_of("campaign", key, root), root)


def large_campaigns(targets: Iterable[str]) -> list[str]:
    """One line for each large campaign (`paper/name`) that exists: its digest, and whether it is overtaken."""
    lines = []
    for target in targets:
        key, name = target.split("/", 1)
        path = distribution_file(key, name, "campaign")
        if path.is_file():
            lines.append(f"{target} {sha256(path.read_bytes())} {overtaken(key, name) or 'current'}")
    return lines


def _record(root: Path, path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads((root / store.record_path(path)).read_text())
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None
