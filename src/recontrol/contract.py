"""The contract of a paper folder, checked without importing or running anything of it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from recontrol import paper as papers
from recontrol.claims import schema
from recontrol.errors import PaperError

EARLIER = {
    "model": (),
    "synthesis": ("model",),
    "certificates": ("model", "synthesis"),
    "simulation": ("model", "synthesis", "certificates"),
}
"""Artifacts that a stage may ask for, beside data and config."""

ALL = (*EARLIER["simulation"], "simulation")


@dataclass(frozen=True)
class Wanted:
    """A function that paper.yaml or claims.yaml asks for: module, name, who asks, and arguments it may have."""

    module: str
    name: str
    asked_by: str
    arguments: tuple[str, ...]


def check(folder: Path | str) -> int:
    """Validate a paper folder and return its number of claims.

    Raises PaperError with one line a problem: malformed paper.yaml or claims.yaml, a stage, figure, quantity or reading
    without its function, or a function whose argument names mean nothing to the runner.
    """
    paper = papers.load(folder)
    claims = schema.load(paper)
    problems = [problem for wanted in functions(paper, claims) if (problem := _trouble(paper.folder, wanted))]
    if problems:
        raise PaperError("\n".join(dict.fromkeys(problems)))
    return len(claims)


def functions(paper: papers.Paper, claims: list[schema.Claim]) -> Iterator[Wanted]:
    """Return every function that the two files ask for."""
    yield Wanted("model", "model", "the first stage of every paper", ())
    for stage in papers.STAGES_WITH_PARTS:
        for part in paper.parts(stage):
            yield Wanted(stage, part, f"paper.yaml: stages.{stage}.{part}", EARLIER[stage])
    for figure in paper.file.figures:
        yield Wanted("figures", figure, f"paper.yaml: figures.{figure}", ALL)
    if paper.file.quantities:
        yield Wanted("quantities", "quantities", "paper.yaml: quantities", ALL)
    for claim in claims:
        for reading in claim.readings:
            allowed = (*ALL, "case") if reading.over else ALL
            yield Wanted("readings", reading.function, f"claims.yaml: {claim.id}, reading {reading.name!r}", allowed)


def _trouble(folder: Path, wanted: Wanted) -> str | None:
    topic, _, name = wanted.name.rpartition(".")
    name = name.replace("-", "_")
    module = f"{wanted.module}/{topic}" if topic else wanted.module
    path = next((p for p in (folder / f"{module}.py", folder / module / "__init__.py") if p.is_file()), None)
    if path is None:
        return f"{folder / module}.py: missing; {wanted.asked_by} asks for its function {name}"
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"), filename=str(path))
    except SyntaxError as error:
        return f"{path}:{error.lineno}: {error.msg}"
    if name not in _defined(tree):
        return f"{path}: has no function {name}; {wanted.asked_by} asks for it"
    definition = next((node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == name), None)
    return _arguments(path, definition, wanted) if definition else None


def _arguments(path: Path, definition: ast.FunctionDef, wanted: Wanted) -> str | None:
    allowed = ("data", "config", *wanted.arguments)
    listed = definition.args
    optional = len(listed.defaults)
    required = (listed.posonlyargs + listed.args)[: -optional or None]
    required += [a for a, default in zip(listed.kwonlyargs, listed.kw_defaults, strict=True) if default is None]
    for argument in required:
        if argument.arg not in allowed:
            place = f"{path}:{definition.lineno}: argument {argument.arg!r} of {definition.name} is unknown here"
            return f"{place}; allowed: {', '.join(allowed)}"
    return None


def _defined(tree: ast.Module) -> set[str]:
    names: set[str] = set()
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            names |= {(alias.asname or alias.name).split(".")[0] for alias in node.names}
        elif isinstance(node, ast.Assign):
            names |= {target.id for target in node.targets if isinstance(target, ast.Name)}
    return names
