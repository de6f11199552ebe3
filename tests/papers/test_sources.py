"""Readings: a page and `recontrol explain` lead to their line, and no stage depends on them."""

from __future__ import annotations

import pytest

from recontrol import paper as papers
from recontrol.claims import schema
from recontrol.pipeline import closure, inputs
from tests.conftest import ROOT


@pytest.mark.parametrize("key", papers.discover(ROOT))
def test_every_reading_stands_where_its_source_line_says(key: str) -> None:
    """A definition, or the assignment of one that another function made."""
    for claim in schema.load(papers.load(ROOT / "papers" / key)):
        for reading in claim.readings:
            name = reading.function.rpartition(".")[2]
            found = inputs.source_of(inputs.function_of(key, "readings", reading.function), name)
            line = (ROOT / found["file"]).read_text().splitlines()[found["line"] - 1]
            assert line.startswith((f"def {name}(", f"{name} = ", "@"))


@pytest.mark.parametrize("key", papers.discover(ROOT))
def test_no_stage_depends_on_readings(key: str) -> None:
    """An edit of a reading remakes the verdicts, and no artifact that they rest on."""
    files = closure.code_of(closure.ORDER[-1], key, ROOT)
    assert f"papers/{key}/model.py" in files
    assert not [name for name in files if name.startswith(f"papers/{key}/readings")]
