"""Record the files of a directory that a command just made (the report, exports) as artifacts."""

from __future__ import annotations

from pathlib import Path

from recontrol.pipeline import store


def run(stage: str, folders: list[Path]) -> None:
    """Publish every file below the folders (or the files named) in place."""
    files: dict[str, bytes] = {}
    for folder in folders:
        paths = sorted(folder.rglob("*")) if folder.is_dir() else [folder]
        files |= {path.as_posix(): path.read_bytes() for path in paths if path.is_file()}
    store.publish(files, {"stage": stage, "paper": None})
