"""Tests on a finished run of all papers. `tools/test.sh all` builds one and names it in RECONTROL_BUILT."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from projects import ROOT, Project, make_project

from recontrol import paper as papers
from recontrol.claims import schema, sensitivity
from recontrol.report import present

BUILT = os.environ.get("RECONTROL_BUILT", "")
pytestmark = pytest.mark.skipif(not BUILT, reason="RECONTROL_BUILT names no finished run (tools/test.sh makes one)")
KEYS = papers.discover(ROOT)


def records(key: str) -> dict[str, dict]:
    content = json.loads(Path(BUILT, "results", key, "verdicts.json").read_text())
    return {record["id"]: record for record in content["claims"]}


@pytest.mark.parametrize("key", KEYS)
def test_every_printed_digit_that_agrees_matters(key):
    paper = papers.load(ROOT / "papers" / key)
    found = records(key)
    changed = 0
    for claim in schema.load(paper):
        record = found[claim.id]
        if claim.compare != "digits" or record["verdict"] not in (
            "reproduced",
            "reproduced-under-assumption",
            "certified",
        ):
            continue
        for misprint in sensitivity.misprints(claim, paper):
            verdict = sensitivity.verdict_with(claim, record, misprint)
            assert verdict != record["verdict"], f"{claim.id} entry {misprint.place} as {misprint.cell}"
            changed += 1
    assert changed or not any(claim.compare == "digits" for claim in schema.load(paper))


@pytest.mark.parametrize("key", KEYS)
def test_verdicts_are_those_of_the_review_and_none_failed(key):
    for record in records(key).values():
        assert record["verdict"] == record["expected"] != "failed", record["id"]
        assert record["verdict"] in ("unspecified",) or record["strength"] in ("exact", "ball", "float"), record["id"]
        for finding in record["findings"]:
            assert finding["source"], f"{record['id']}: {finding['reading']} has no source line"


def test_every_erratum_of_the_first_paper_says_what_its_numbers_used():
    """The errata sheet gives place, print, correct form or value, proof, and this."""
    from recontrol.report.collect import Paper

    claims = [claim for claim in Paper(Path(BUILT), "hashim2015").claims if claim.verdict == "erratum"]
    assert len(claims) > 30
    assert not [claim.id for claim in claims if not claim.numbers_used]
    assert not [claim.id for claim in claims if not present.correction(claim)]


@pytest.mark.parametrize("key", KEYS)
def test_quantities_have_value_unit_and_meaning(key):
    rows = json.loads(Path(BUILT, "results", key, "quantities.json").read_text())
    names = {row["name"] for row in rows}
    assert names == set(papers.load(ROOT / "papers" / key).file.quantities)
    for row in rows:
        assert row["description"]
        assert row["unit"]


def test_a_second_build_of_the_first_paper_has_identical_bytes(tmp_path):
    again = make_project(tmp_path / "again", {"hashim2015": ROOT / "papers/hashim2015"})
    again.snakemake("hashim2015", timeout=600)
    first = Project(Path(BUILT)).artifacts()
    second = again.artifacts()
    assert len(second) > 30
    different = [name for name in second if first.get(name) != second[name]]
    assert not different
