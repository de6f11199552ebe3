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
def test_every_printed_digit_that_agrees_matters(key, record_property):
    """Every digit of every agreeing claim changed to each other digit: the verdict changes, or it is a looser bound"""
    paper = papers.load(ROOT / "papers" / key)
    claims, found = schema.load(paper), records(key)
    survey = sensitivity.survey(paper, claims, found)
    by_id = {claim.id: claim for claim in claims}
    agreeing = [claim for claim in claims if found[claim.id]["verdict"] in sensitivity.AGREEING]
    assert survey.claims + len(survey.aside) == len(agreeing)
    assert not [row for row in survey.kept if by_id[row[0]].compare != "bound"]
    assert all(by_id[id].compare not in schema.NUMERIC for id in survey.aside)
    assert survey.changed > 9 or not survey.claims
    record_property("cases", survey.changed + len(survey.kept))
    record_property("changed", survey.changed)
    for id in survey.aside:
        record_property("aside", f"{key}/{id}: {survey.aside[id]}")
    for id in dict.fromkeys(id for id, _, _ in survey.kept):
        rows = [row for row in survey.kept if row[0] == id]
        record_property("kept", f"{key}/{id}: {len(rows)} of its digits' changes; {rows[0][2]}")


@pytest.mark.parametrize("key", KEYS)
def test_verdicts_are_those_of_the_review_and_none_failed(key):
    for record in records(key).values():
        assert record["verdict"] == record["expected"] != "failed", record["id"]
        assert record["verdict"] in ("unspecified",) or record["strength"] in ("exact", "ball", "float"), record["id"]
        for finding in record["findings"]:
            assert finding["source"], f"{record['id']}: {finding['reading']} has no source line"


@pytest.mark.parametrize("key", KEYS)
def test_no_definition_contradicts_a_reproduced_claim(key):
    """One agreeing definition carries `reproduced`: another one must not hide a condition that does not hold"""
    for record in records(key).values():
        said = {f["agrees"] for f in record["findings"] if f["kind"] == "definition"}
        assert record["verdict"] != "reproduced" or said <= {"yes"}, record["id"]


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
