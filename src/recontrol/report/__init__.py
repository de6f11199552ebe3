"""Reports, exports and citable artifacts of a finished run."""

from __future__ import annotations

from pathlib import Path


def build(root: Path, papers: list[str]) -> None:
    """Write ``results/report`` of the project at ``root`` for the named papers (see ``recontrol.report.site``)."""
    from recontrol.report.site import build as build_site

    build_site(root, papers)
