"""A page and `recontrol explain` lead from a claim to the line of its reading."""

from __future__ import annotations

import pytest

from recontrol import paper as papers
from recontrol.claims import schema
from recontrol.pipeline import inputs
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
