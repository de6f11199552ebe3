"""Stable identities of everything a run made: unit, place, digests, producing stage and inputs (results/index.json)."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from recontrol.errors import UnknownNameError
from recontrol.report import numbers
from recontrol.report.claim import Claim
from recontrol.report.collect import Paper, read_json

SCHEMA = "recontrol/index/1"
DIGITS = 6
"""Significant digits that a canonical digest keeps, so that it survives another processor."""

TINY = 1e-12
DEPTH = 4
CLAIM_KEYS = ("id", "where", "printed", "unit", "verdict", "strength", "reading", "found", "explained_by", "origin")
Entry = dict[str, Any]


def index(root: Path, papers: list[str]) -> dict[str, Any]:
    """Return the content of results/index.json: one entry an identity, and the files with their stages and inputs."""
    entries = [entry for key in papers for entry in _of_paper(Paper(Path(root), key))]
    files = {entry["file"]: _file(Path(root), entry["file"]) for entry in entries}
    return {"schema": SCHEMA, "artifacts": sorted(entries, key=lambda entry: entry["identity"]), "files": files}


def lookup(root: Path, identity: str) -> Entry:
    """Return the entry of an identity with that of its file; ``paper/name`` is enough where it is unambiguous.

    Raises UnknownNameError for an unknown or ambiguous one.
    """
    key = identity.partition("/")[0]
    if not (Path(root) / "papers" / key / "paper.yaml").is_file():
        raise UnknownNameError(f"no paper {key!r}; `recontrol list` shows the papers")
    known = index(root, [key])
    entries = {entry["identity"]: entry | known["files"][entry["file"]] for entry in known["artifacts"]}
    if identity in entries:
        return entries[identity]
    name = identity.partition("/")[2]
    claims = [f"{key}/claims/{name}"] if f"{key}/claims/{name}" in entries else []
    found = claims or [other for other in entries if name and other.endswith("/" + name)]
    if len(found) == 1:
        return entries[found[0]]
    near = found or [other for other in entries if name.lower() in other.lower()]
    what = "is ambiguous" if found else "is unknown"
    hint = f"there are: {', '.join(near[:6])}" if near else f"`recontrol show {key}` and results/index.json list them"
    raise UnknownNameError(f"identity {identity!r} {what}; {hint}")


def _of_paper(paper: Paper) -> Iterator[Entry]:
    yield from _claims(paper)
    yield from _quantities(paper)
    for path in sorted(paper.results.rglob("*.json")):
        relative = path.relative_to(paper.results)
        if relative.parts[0] in ("model.json", "synthesis", "simulation", "certificates"):
            yield from _json_artifact(paper, path, "/".join(relative.with_suffix("").parts))
    for path in sorted((paper.results / "simulation").glob("*.npz")):
        identity = f"{paper.key}/simulation/{path.stem}/series"
        yield _entry(paper, identity, "series", path, None, _series_digest(path))
    for figure in paper.figures:
        if figure["files"]:
            yield _figure(paper, figure)


def _claims(paper: Paper) -> Iterator[Entry]:
    path = paper.results / "verdicts.json"
    for claim in paper.claims if path.is_file() else []:
        record = _claim_record(claim)
        entry = _entry(paper, claim.identity, "claim", path, digest(record), digest(canonical(record)))
        yield entry | {"unit": claim.unit or None, "where": claim.where, "title": claim.title, "verdict": claim.verdict}


def _claim_record(claim: Claim) -> dict[str, Any]:
    return {key: claim.raw.get(key) for key in CLAIM_KEYS}


def _quantities(paper: Paper) -> Iterator[Entry]:
    path = paper.results / "quantities.json"
    for row in paper.quantities:
        identity = "/".join(filter(None, [paper.key, "quantities", row["name"], row.get("case")]))
        value = row.get("value")
        entry = _entry(paper, identity, "quantity", path, digest(value), digest(canonical(value)))
        yield entry | {"unit": row.get("unit"), "title": row.get("description"), "value": value}


def _json_artifact(paper: Paper, path: Path, name: str) -> Iterator[Entry]:
    content = read_json(path)
    yield _entry(paper, f"{paper.key}/{name}", name.split("/")[0], path, digest(content), digest(canonical(content)))
    if not name.startswith("certificates"):
        for place, value in _values(content, DEPTH):
            identity = f"{paper.key}/{name}/{place}"
            yield _entry(paper, identity, "value", path, digest(value), digest(canonical(value))) | {"pointer": place}


def _values(content: Any, depth: int) -> Iterator[tuple[str, Any]]:
    if not isinstance(content, dict):
        return
    for name, value in content.items():
        if numbers.decode(value) is None and isinstance(value, dict) and depth > 1:
            yield from ((f"{name}/{place}", inner) for place, inner in _values(value, depth - 1))
        else:
            yield name, value


def _figure(paper: Paper, figure: dict[str, Any]) -> Entry:
    folder = paper.root / "figures" / paper.key
    files = {suffix: _sha256(folder / f"{figure['name']}.{suffix}") for suffix in figure["files"]}
    path = folder / f"{figure['name']}.{'csv' if 'csv' in files else figure['files'][0]}"
    rounded = digest(canonical(path.read_text(encoding="utf-8"))) if path.suffix == ".csv" else None
    entry = _entry(paper, f"{paper.key}/figures/{figure['name']}", "figure", path, None, rounded)
    return entry | {"title": figure.get("title"), "files": files}


def _entry(paper: Paper, identity: str, kind: str, path: Path, value: str | None, rounded: str | None) -> Entry:
    return {
        "identity": identity,
        "kind": kind,
        "paper": paper.key,
        "unit": None,
        "where": None,
        "title": None,
        "file": path.relative_to(paper.root).as_posix(),
        "digest": value,
        "canonical_digest": rounded,
    }


def _file(root: Path, name: str) -> dict[str, Any]:
    """Digest of a file, and from its record the stage that made it and the digests of what went in."""
    record = read_json(root / "run" / "provenance" / f"{name}.json") or {}
    return {"sha256": _sha256(root / name), "stage": record.get("stage"), "inputs": record.get("inputs") or {}}


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def digest(value: Any) -> str:
    """Return the SHA-256 of a JSON value in canonical text (sorted keys, no spaces)."""
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()


def canonical(value: Any) -> Any:
    """Return a JSON value with every decimal number rounded to six significant digits, in texts too.

    Integers and rationals stay as they are: they do not depend on the processor.
    """
    if isinstance(value, dict):
        return {name: canonical(item) for name, item in value.items()}
    if isinstance(value, list):
        return [canonical(item) for item in value]
    if isinstance(value, float):
        return _rounded(value)
    return numbers.DECIMAL.sub(lambda match: _rounded(float(match[0])), value) if isinstance(value, str) else value


def _rounded(value: float) -> str:
    return "0" if abs(value) < TINY else f"{value:.{DIGITS - 1}e}"


def _series_digest(path: Path) -> str:
    import numpy as np

    total = hashlib.sha256()
    with np.load(path, allow_pickle=False) as archive:
        for name in sorted(archive.files):
            array = np.atleast_1d(archive[name])
            parts = [array.real, array.imag] if np.iscomplexobj(array) else [array]
            total.update(f"{name}{array.shape}".encode())
            for part in parts:
                total.update(_rounded_bytes(part.astype(float)))
    return total.hexdigest()


def _rounded_bytes(array: Any) -> bytes:
    import numpy as np

    small = np.abs(array) < TINY
    size = np.where(small, 1.0, np.abs(array))
    exponent = np.floor(np.log10(size)).astype(int)
    mantissa = np.round(np.where(small, 0.0, array) / 10.0 ** (exponent - DIGITS + 1)).astype(np.int64)
    return mantissa.tobytes() + exponent.astype(np.int64).tobytes()
