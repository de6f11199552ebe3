"""Messages about claims.yaml: they name the claim by its id, with file and line."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from recontrol import paper as papers
from recontrol.claims import schema
from recontrol.errors import PaperError

TOY = Path(__file__).resolve().parents[1] / "toy" / "toy2024"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return Path(shutil.copytree(TOY, tmp_path / "toy2024"))


def message(folder: Path, old: str, new: str) -> tuple[str, int]:
    """What is said after one edit of claims.yaml, and the line of the edit."""
    path = folder / "claims.yaml"
    text = path.read_text()
    assert text.count(old) >= 1
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(PaperError) as caught:
        schema.load(papers.load(folder))
    return str(caught.value), text[: text.index(old)].count("\n") + 1


def last_id(folder: Path) -> str:
    return re.findall(r"^- id: (\S+)", (folder / "claims.yaml").read_text(), re.MULTILINE)[-1]


def test_an_unknown_key_is_reported_with_the_id_of_its_claim(folder: Path) -> None:
    name = last_id(folder)
    said, line = message(folder, f"- id: {name}\n", f"- id: {name}\n  colour: red\n")
    assert f"claims.yaml:{line + 1}: claim {name}: colour: " in said


def test_a_claim_that_contradicts_itself_is_reported_by_its_id(folder: Path) -> None:
    name = last_id(folder)
    said, line = message(folder, f"- id: {name}\n", f'- id: {name}\n  bound: "<="\n')
    assert re.search(rf"claims.yaml:{line}: claim {name}: Value error, 'bound' goes with compare", said)


def test_a_claim_without_an_id_is_counted(folder: Path) -> None:
    name = last_id(folder)
    count = (folder / "claims.yaml").read_text().count("\n- id:") + 1
    said, _ = message(folder, f"- id: {name}\n", "- identity: 7\n")
    assert f"claim number {count}: id: " in said
