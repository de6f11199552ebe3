"""Write the report: an overview, one page per paper, sources of the readings, figures and certificates."""

from __future__ import annotations

import os
import shutil
import sys
from importlib import metadata
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from recontrol.report import brief, numbers, present, text, values, words
from recontrol.report.collect import Paper

LIBRARIES = (
    "numpy", "scipy", "cvxpy", "clarabel", "cvxopt", "scs", "sdpa-python", "control", "slycot", "python-flint", "sympy",
    "matplotlib", "snakemake",
)  # fmt: skip


def build(root: Path, papers: list[str]) -> None:
    """Write ``results/report`` from the artifacts of ``papers``; it is replaced as a whole when all pages are made."""
    target = Path(root) / "results" / "report"
    scratch = Path(root) / "run" / f"report-{os.getpid()}"
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    try:
        _write(scratch, [Paper(Path(root), key) for key in papers])
        shutil.rmtree(target, ignore_errors=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        scratch.rename(target)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _write(target: Path, papers: list[Paper]) -> None:
    environment = _environment()
    sources = {place[0] for paper in papers for place in _places(paper)}
    shown = {name for name in sources if papers and _inside(papers[0].root, name)}
    common: dict[str, Any] = {"papers": papers, "sources": shown, "versions": versions()}
    _page(environment, "index.html.j2", target / "index.html", **common)
    for paper in papers:
        _page(environment, "paper.html.j2", target / f"{paper.key}.html", paper=paper, **common)
        _copy(paper, target)
    for name in sorted(shown):
        code = Markup(_highlight((papers[0].root / name).read_text(encoding="utf-8")))
        up = "../" * (name.count("/") + 1)
        _page(
            environment,
            "source.html.j2",
            target / "source" / f"{name}.html",
            name=name,
            code=code,
            up=up,
            papers=papers,
        )
    with as_file(files("recontrol.report") / "assets") as assets:
        shutil.copytree(assets, target / "assets")
    (target / "assets" / "code.css").write_text(_code_style(), encoding="utf-8")


def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("recontrol.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters.update(md=text.inline, notes=text.notes, anchor=text.anchor, tree=values.tree)
    environment.globals.update(words=words, brief=brief, present=present, values=values, numbers=numbers, up="")
    return environment


def _page(environment: Environment, template: str, path: Path, **context: Any) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(environment.get_template(template).render(**context), encoding="utf-8", newline="\n")


def _places(paper: Paper) -> list[tuple[str, int]]:
    return [finding.source for claim in paper.claims for finding in claim.findings if finding.source]


def _inside(root: Path, name: str) -> bool:
    path = (root / name).resolve()
    return path.is_file() and path.is_relative_to(Path(root).resolve())


def _copy(paper: Paper, target: Path) -> None:
    for figure in paper.figures:
        for suffix in figure["files"]:
            _copy_file(
                paper.root / "figures" / paper.key / f"{figure['name']}.{suffix}", target / "figures" / paper.key
            )
    for ensemble in paper.ensembles:
        for size in ensemble["sizes"]:
            for suffix in size["files"]:
                source = paper.results / size["target"] / f"{ensemble['name']}.{suffix}"
                _copy_file(source, target / f"{size['target']}s" / paper.key)
    for name in paper.certificates:
        _copy_file(paper.results / "certificates" / f"{name}.json", target / "certificates" / paper.key)


def _copy_file(source: Path, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, folder / source.name)


def _highlight(code: str) -> str:
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import PythonLexer

    formatter = HtmlFormatter(linenos="inline", lineanchors="L", anchorlinenos=True, cssclass="code")
    return highlight(code, PythonLexer(), formatter)


def _code_style() -> str:
    from pygments.formatters import HtmlFormatter

    light = HtmlFormatter(style="default").get_style_defs(".code")
    dark = HtmlFormatter(style="github-dark").get_style_defs(".code")
    return f"{light}\n@media (prefers-color-scheme: dark) {{\n{dark}\n}}\n.code {{ background: none !important; }}\n"


def versions() -> list[tuple[str, str]]:
    """Return the versions of Python and the libraries whose results the report shows."""
    rows = [("Python", ".".join(map(str, sys.version_info[:3])))]
    for name in LIBRARIES:
        try:
            rows.append((name, metadata.version(name)))
        except metadata.PackageNotFoundError:
            rows.append((name, "not installed"))
    return rows
