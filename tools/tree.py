"""Copies of the tree without anything that was made, to run the chain in."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CHAIN = ("Snakefile", "rules", "config", "profiles", "environment.lock", "src")
"""What the chain needs beside paper folders."""
WHOLE = (*CHAIN, "papers", "environment-test.lock", "pyproject.toml", "README.md", "docs", "CITATION.cff")
"""What a user has, for the report's words and the verdict book too."""


def copy(folder: Path, names: Iterable[str] = WHOLE) -> None:
    """Copy files and folders of the tree into ``folder``, which may exist."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        copy_into(ROOT / name, folder / name)


def copy_into(source: Path, target: Path) -> None:
    """Copy one file or folder to the path ``target``, without compiled modules."""
    if source.is_dir():
        shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
    else:
        shutil.copy2(source, target)
