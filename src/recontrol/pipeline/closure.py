"""Which source files a stage loads: the transitive closure of imports, found without running anything.

Snakemake does not see edits of imported modules. Each rule therefore lists as input every file of src/ and of the paper
folder that its own stage and all earlier stages of the paper may import, function-level imports included.
"""

from __future__ import annotations

import ast
import json
import os
import re
from functools import cache
from pathlib import Path

from recontrol.pipeline.encode import sha256

MEMORY = Path("run/imports.json")
"""What each content of a source file imports, by its sha256: parsing all of them is what a small job would cost."""

ORDER = ("model", "synthesis", "certificates", "simulation")
"""Stages whose artifacts later stages read, in their order."""

MODULES = {
    "model": "model",
    "synthesis": "synthesis",
    "certificates": "certificates",
    "simulation": "simulation",
    "figure": "figures",
    "verdicts": "readings",
    "quantities": "quantities",
    "campaign": "campaign",
}
"""Stage -> module of the paper folder that holds its functions."""

BOUNDS = "campaign_bounds"
"""Module of the paper folder that says what is proven of each campaign."""

COMMANDS = dict.fromkeys(ORDER, "stage") | {
    "figure": "figure",
    "verdicts": "verdicts",
    "quantities": "quantities",
    "campaign": "campaign",
}
"""Stage -> module of recontrol.pipeline that runs it."""


def code_of(stage: str, paper: str, root: Path | str = ".", figure: str | None = None) -> list[str]:
    """Files, relative to `root`, that `stage` of `paper` and all earlier stages load, and the runner's own.

    Of the drawing code only the topic that defines `figure`, so that an edit redraws what it may change.
    """
    base = Path(root).resolve()
    earlier = ORDER[: ORDER.index(stage) + 1] if stage in ORDER else (*ORDER, stage)
    modules = {module for name in earlier for module in _stage_modules(paper, MODULES[name], base)}
    if figure is not None:
        modules -= set(_stage_modules(paper, MODULES[stage], base))
        modules |= {f"papers.{paper}.{MODULES[stage]}", home_of(paper, MODULES[stage], figure, base)}
    if stage == "campaign":
        modules |= set(_stage_modules(paper, BOUNDS, base))
    modules |= {f"recontrol.pipeline.{COMMANDS[name]}" for name in earlier} | {"recontrol.pipeline.__main__"}
    return files_of(frozenset(modules), base)


def _stage_modules(paper: str, name: str, base: Path) -> list[str]:
    """The module of a stage, and all topics of it where it is a package: claims name their functions as topic.name."""
    topics = sorted(path.stem for path in (base / "papers" / paper / name).glob("[!_]*.py"))
    return [f"papers.{paper}.{name}", *(f"papers.{paper}.{name}.{topic}" for topic in topics)]


def digest_of(names: list[str], root: Path | str = ".") -> str:
    """Digest of the names and contents of some files under `root`."""
    return sha256("".join(f"{name} {sha256(Path(root, name).read_bytes())}\n" for name in names).encode())


def home_of(paper: str, name: str, function: str, root: Path | str = ".") -> str:
    """The module that defines a function: papers.<paper>.<name>, else the topic of that package where it stands."""
    package, folder = f"papers.{paper}.{name}", Path(root, "papers", paper, name)
    start = re.compile(rf"^def {re.escape(function.replace('-', '_'))}\(", re.MULTILINE)
    for path in (folder / "__init__.py", *sorted(folder.glob("[!_]*.py"))):
        if path.is_file() and start.search(path.read_text(encoding="utf-8")):
            return package if path.stem == "__init__" else f"{package}.{path.stem}"
    return package


@cache
def files_of(modules: frozenset[str], base: Path) -> list[str]:
    """Transitive closure of `modules`, as sorted paths relative to `base`. Modules outside the tree are left out."""
    seen: dict[str, Path] = {}
    waiting = sorted(modules)
    while waiting:
        module = waiting.pop()
        path = find(module, base)
        if path is None or module in seen:
            continue
        seen[module] = path
        waiting += _imports(path, module, base)
    return sorted(path.relative_to(base).as_posix() for path in set(seen.values()))


@cache
def find(module: str, base: Path) -> Path | None:
    """File of a module of this tree, or None."""
    root = base / "src" if module.split(".")[0] == "recontrol" else base if module.startswith("papers.") else None
    if root is None:
        return None
    stem = root.joinpath(*module.split("."))
    for path in (stem.with_suffix(".py"), stem / "__init__.py"):
        if path.is_file():
            return path
    return None


@cache
def _imports(path: Path, module: str, base: Path) -> list[str]:
    package = (module if path.name == "__init__.py" else module.rpartition(".")[0]).split(".")
    found: list[str] = []
    for level, origin, names in _statements(path.read_bytes()):
        if level:
            anchor = package[: len(package) - level + 1]
            origin = ".".join([*anchor, *([origin] if origin else [])])
        found += _with_parents(origin)
        found += [f"{origin}.{name}" for name in names]
    return [name for name in found if find(name, base)]


def _statements(source: bytes) -> list[tuple[int, str, list[str]]]:
    """Import statements of a source: level, origin and names of each; none if it cannot be parsed."""
    memory, digest = _memory(), sha256(source)
    if digest not in memory:
        try:
            tree = ast.parse(source)
        except (SyntaxError, ValueError):
            return []
        found: list[tuple[int, str, list[str]]] = []
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                found += [(0, alias.name, []) for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                found.append((node.level, node.module or "", [alias.name for alias in node.names]))
        memory[digest] = found
    return memory[digest]


@cache
def _memory() -> dict[str, list[tuple[int, str, list[str]]]]:
    """What an earlier process remembered, or nothing: a memory that cannot be read is only slower."""
    try:
        rows = json.loads(MEMORY.read_text())
        return {digest: [(int(a), str(b), [str(n) for n in c]) for a, b, c in found] for digest, found in rows.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def remember() -> None:
    """Keep for the jobs of a run what this process has found."""
    MEMORY.parent.mkdir(parents=True, exist_ok=True)
    temporary = MEMORY.with_suffix(f".{os.getpid()}.part")
    temporary.write_text(json.dumps(_memory(), sort_keys=True))
    temporary.replace(MEMORY)


def _with_parents(module: str) -> list[str]:
    steps = module.split(".")
    return [".".join(steps[: i + 1]) for i in range(len(steps))]


def undeclared(loaded: dict[str, str], declared: list[str], root: Path | str = ".") -> list[str]:
    """Modules of this tree that were really imported but are not in the declared closure.

    loaded: module name -> file, as in sys.modules. Returns their paths relative to `root`.
    """
    base = Path(root).resolve()
    tops = tuple(f"{base / top}{os.sep}" for top in ("src", "papers"))
    files = {os.path.join(_real(folder), name) for folder, name in map(os.path.split, loaded.values())}
    surplus = {os.path.relpath(file, base) for file in files if file.endswith(".py") and file.startswith(tops)}
    return sorted({Path(name).as_posix() for name in surplus} - set(declared))


@cache
def _real(folder: str) -> str:
    return os.path.realpath(folder)
