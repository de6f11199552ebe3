"""BibTeX entries of the papers and of cited artifacts."""

from __future__ import annotations

import re
import tomllib
from importlib import metadata
from pathlib import Path
from typing import Any

from recontrol.report.collect import Paper
from recontrol.report.tex import escape, markdown


def version() -> str:
    """Return the version of this project: that of pyproject.toml beside the sources, else the installed one."""
    project = Path(__file__).parents[3] / "pyproject.toml"
    if project.is_file():
        return str(tomllib.loads(project.read_text(encoding="utf-8"))["project"]["version"])
    try:
        return metadata.version("recontrol")
    except metadata.PackageNotFoundError:
        return "unknown"


def entry(kind: str, key: str, fields: dict[str, str]) -> str:
    """Return one BibTeX entry with its fields in the given order; empty ones are left out."""
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items() if value]
    return "\n".join([f"@{kind}{{{key},", *lines, "}"])


def of_paper(paper: Paper) -> str:
    """Return the entry of a paper from its paper.yaml."""
    about: dict[str, Any] = paper.about
    given = dict(about.get("bibtex") or {})
    kind, key = given.pop("type", "misc"), given.pop("key", paper.key)
    fields = {
        "title": "{" + markdown(about.get("title", paper.key)) + "}",
        "author": " and ".join(escape(name) for name in about.get("authors") or []),
        "year": str(about.get("year", "")),
    }
    fields |= {name: escape(str(value)) for name, value in given.items()}
    return entry(kind, key, fields | {"doi": about.get("doi") or ""})


def of_artifact(identity: str, title: str, digest: str) -> str:
    """Return the entry of a claim or artifact of this project."""
    key = "recontrol-" + re.sub(r"[^A-Za-z0-9]+", "-", identity)
    fields = {
        "title": "{" + markdown(f"{identity}: {title}" if title else identity) + "}",
        "author": "{recontrol contributors}",
        "howpublished": f"recontrol, version {escape(version())}",
        "note": f"SHA-256 {digest}",
    }
    return entry("misc", key, fields)
