"""The contract of every paper folder, found on disk: files, names, functions, references, notes."""

from __future__ import annotations

import ast
import json
import re
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

from recontrol import paper as papers
from recontrol.claims import schema
from recontrol.pipeline import closure, regression

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = [ROOT / "papers" / key for key in papers.discover(ROOT)] + [ROOT / "tests/toy/toy2024"]
sys.path.insert(0, str(ROOT / "tools"))

pytestmark = pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)


def functions(folder: Path, module: str) -> set[str]:
    """Names that papers/<key>/<module> defines or re-exports, `topic.name` for the modules of a package."""
    found: set[str] = set()
    single, package = folder / f"{module}.py", folder / module
    for path, prefix in [(single, "")] + [
        (p, "" if p.stem == "__init__" else f"{p.stem}.") for p in package.glob("*.py")
    ]:
        if path.exists():
            for node in ast.parse(path.read_text()).body:
                if isinstance(node, ast.FunctionDef):
                    found.add(prefix + node.name)
                elif isinstance(node, ast.ImportFrom):
                    found |= {prefix + (alias.asname or alias.name) for alias in node.names}
                elif isinstance(node, ast.Assign):
                    found |= {prefix + target.id for target in node.targets if isinstance(target, ast.Name)}
    return found


def missing_parts(folder: Path, module: str, parts: Iterable[str]) -> set[str]:
    """Parts of paper.yaml for which neither the module nor a topic of it has a function."""
    known = {name.rpartition(".")[2] for name in functions(folder, module)}
    return {part for part in parts if part.replace("-", "_") not in known}


def test_files_are_valid_and_complete(folder):
    paper = papers.load(folder)
    assert schema.load(paper)
    assert (folder / "NOTES.md").exists()


def test_the_bibtex_entry_is_plain_text(folder):
    """Escaping is done where the entry is written: a backslash here would be printed as one."""
    assert "\\" not in "".join(map(str, papers.load(folder).file.bibtex.model_dump().values()))


def test_every_named_function_exists(folder):
    paper = papers.load(folder)
    readings = functions(folder, "readings")
    missing = [r.function for claim in schema.load(paper) for r in claim.readings if r.function not in readings]
    assert not missing
    for stage in papers.STAGES_WITH_PARTS:
        assert not missing_parts(folder, closure.MODULES[stage], paper.parts(stage))
    assert not missing_parts(folder, "figures", paper.file.figures)
    for module in (closure.MODULES["campaign"], closure.BOUNDS):
        assert not missing_parts(folder, module, paper.file.campaigns)
    assert "model" in functions(folder, "model")
    assert not paper.file.quantities or "quantities" in functions(folder, "quantities")


def test_every_figure_has_reviewed_data(folder):
    paper = papers.load(folder)
    for name in paper.file.figures:
        assert regression.read(folder / "reference" / f"{name}.csv")
    assert (folder / "reference" / "REASONS.md").exists() or not paper.file.figures or folder.name == "toy2024"


def test_notes_are_cited_and_words_are_ours(folder):
    paper = papers.load(folder)
    claims = schema.load(paper)
    ids = schema.note_ids(folder)
    cited = {note for claim in claims for note in claim.notes}
    cited |= {reading.note for claim in claims for reading in claim.readings if reading.note}
    assert cited <= ids


def test_stage_modules_do_no_work_at_import_and_touch_no_files(folder):
    heavy = {"cvxpy", "control", "matplotlib", "sympy", "snakemake"}
    for path in folder.rglob("*.py"):
        for node in ast.parse(path.read_text()).body:
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = [node.module or ""]
            assert not {name.split(".")[0] for name in names} & heavy, f"{path}: import it inside the function"
            assert not isinstance(node, (ast.For, ast.While, ast.With)), f"{path}: work at import"
        text = path.read_text()
        assert not re.search(r"\bopen\(|read_text|read_bytes|np\.load\b|pickle", text), f"{path}: file access"


def test_nothing_reads_outside_the_tree(folder):
    for path in [*folder.rglob("*.py"), *folder.rglob("*.yaml"), *folder.rglob("*.md")]:
        assert "../shared" not in path.read_text(), path


def test_json_schemas_are_in_step(folder):
    import schemas

    for name, text in schemas.documents().items():
        assert (ROOT / name).read_text() == text, f"{name} is stale; run `make schemas`"
        json.loads(text)
