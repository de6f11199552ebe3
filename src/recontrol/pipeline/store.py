"""The artifact store: unique temporary names, rename, and a record of every artifact's digest.

A record (run/provenance/<path>.json) is written before the artifact is renamed into place. Whatever happens in between,
an artifact whose bytes differ from its record is never read: it is named, set aside and rebuilt by the plain run.
"""

from __future__ import annotations

import json
import os
import tempfile
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from recontrol.errors import ArtifactError, MissingArtifactError
from recontrol.pipeline.encode import loads, sha256

RECORDS = Path("run/provenance")
SET_ASIDE = Path("run/set-aside")
KEPT = ("results", "figures")
CLOCK_SLACK = 60.0
"""Seconds that a time stamp may lie ahead of the clock."""


def record_path(path: Path | str) -> Path:
    """Where the record of an artifact lies."""
    return RECORDS / f"{Path(path).as_posix()}.json"


def publish(contents: Mapping[str, bytes], made_by: Mapping[str, Any]) -> None:
    """Write several artifacts: all temporary files first, then record and rename one by one.

    A full disk or a kill leaves either the old or the new artifact, never half of one. Raises ArtifactError if the run
    that started this stage is no longer the current one, or if nothing can be written.
    """
    _refuse_orphan()
    temporary: dict[str, Path] = {}
    try:
        for name, content in contents.items():
            temporary[name] = _write_temporary(Path(name), content)
        for name, content in contents.items():
            record = {"artifact": name, "sha256": sha256(content), "bytes": len(content), **made_by}
            text = json.dumps(record, sort_keys=True, indent=1) + "\n"
            os.replace(_write_temporary(record_path(name), text.encode()), record_path(name))
            os.replace(temporary.pop(name), name)
    except OSError as error:
        raise ArtifactError(
            f"{error.filename or next(iter(contents))}: cannot be written ({error.strerror}); free some space or mend "
            "the permissions, then run the same command again"
        ) from None
    finally:
        for leftover in temporary.values():
            leftover.unlink(missing_ok=True)


def _write_temporary(path: Path, content: bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(name, 0o644)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise
    return Path(name)


def _refuse_orphan() -> None:
    """A stage that outlived its killed run must not overwrite what a newer run made."""
    mine = os.environ.get("RECONTROL_RUN")
    current = Path("run/current")
    if mine and current.exists() and current.read_text() != mine:
        raise ArtifactError("this stage belongs to a run that has ended; a newer run is going on, nothing was written")


def read_bytes(path: Path | str) -> bytes:
    """Bytes of an artifact that match its record.

    Raises MissingArtifactError if it does not exist, ArtifactError if it has no record or differs from it.
    """
    path = Path(path)
    if not path.exists():
        raise MissingArtifactError(f"{path}: missing; an earlier stage failed or has not run (snakemake builds it)")
    content = path.read_bytes()
    trouble = mismatch(path, content)
    if trouble:
        raise ArtifactError(f"{path}: {trouble}; run the same command again, it is set aside and rebuilt")
    return content


def mismatch(path: Path, content: bytes | None = None) -> str | None:
    """Why an artifact cannot be trusted, or None."""
    record_file = record_path(path)
    try:
        record = json.loads(record_file.read_text())
    except FileNotFoundError:
        return "has no record of who made it"
    except (OSError, ValueError):
        return f"its record {record_file} cannot be read"
    content = path.read_bytes() if content is None else content
    if record.get("sha256") != sha256(content):
        return "differs from its record (edited by hand, truncated or half-written)"
    return None


def read_json(path: Path | str) -> Any:
    """Decoded artifact. Raises ArtifactError as `read_bytes`, and for content that is not JSON."""
    content = read_bytes(path)
    try:
        return loads(content.decode("utf-8"))
    except (ValueError, KeyError, TypeError) as error:
        raise ArtifactError(f"{path}: not a readable artifact ({error}); delete it and run again") from None


def read_certificate(path: Path | str) -> Any:
    """A certificate as it was written, plain JSON: its digest covers every entry, so nothing may become an array.

    Raises ArtifactError as `read_bytes`, and for content that is not JSON.
    """
    content = read_bytes(path)
    try:
        return json.loads(content.decode("utf-8"))
    except ValueError as error:
        raise ArtifactError(f"{path}: not a readable certificate ({error}); delete it and run again") from None


def digest_of(path: Path | str) -> str:
    """Recorded digest of an artifact. Raises MissingArtifactError without a record."""
    try:
        return str(json.loads(record_path(path).read_text())["sha256"])
    except (OSError, ValueError, KeyError):
        raise MissingArtifactError(f"{path}: has no record of who made it") from None


def retract(paths: Iterable[Path]) -> None:
    """Remove conclusions that a stage about to run may overturn; the chain draws them anew after it."""
    for path in paths:
        record_path(path).unlink(missing_ok=True)
        path.unlink(missing_ok=True)


def untrusted(tops: Iterable[str] = KEPT) -> list[tuple[Path, str]]:
    """All artifacts under results/ and figures/ that cannot be trusted, with the reason."""
    found = []
    limit = time.time() + CLOCK_SLACK
    for top in tops:
        for path in sorted(Path(top).rglob("*")):
            if path.is_file() and not path.name.startswith("."):
                reason = mismatch(path)
                if not reason and path.stat().st_mtime > limit:
                    reason = "carries a time in the future, so that edits of its inputs would go unnoticed"
                if reason:
                    found.append((path, reason))
    return found


def set_aside(path: Path) -> Path:
    """Move an artifact out of the way, keeping it under run/set-aside; returns its new place."""
    target = SET_ASIDE / path
    number = 0
    while target.exists():
        number += 1
        target = SET_ASIDE / path.with_name(f"{path.name}.{number}")
    target.parent.mkdir(parents=True, exist_ok=True)
    os.replace(path, target)
    record_path(path).unlink(missing_ok=True)
    return target
