"""The page of environments shows every difference that was measured."""

from __future__ import annotations

import copy
import json
import platform
import sys

import pytest

from tools import tree

sys.path.insert(0, str(tree.ROOT / "tools"))

import matrix

REFERENCE = {
    "environment": {"python": "3.11.7", "threads": "1", "kernel": "Haswell", "solver": "CLARABEL"},
    "code": 0,
    "verdicts": {"hashim2015/eq9": "reproduced", "hashim2015/eq10": "erratum"},
    "book": ["| eq9 | 1.25 |", "| eq10 | 2 |"],
    "bytes": {"results/hashim2015/model.json": "a", "figures/hashim2015/fig3.csv": "b"},
    "digits": {"results/hashim2015/model.json": "c"},
}


def changed(**changes):
    return copy.deepcopy(REFERENCE) | changes


def test_equal_environments_leave_nothing_to_list():
    page = matrix.page({"reference": REFERENCE, "two threads": changed()})
    assert "| two threads | 2 of 2 | equal | all | all |" in page
    assert page.count("\nNone.\n") == 3
    assert matrix.wrong({"reference": REFERENCE, "two threads": changed(), "Python 3.13": None}) == []


def test_each_difference_is_counted_and_listed():
    other = changed(
        verdicts={"hashim2015/eq9": "erratum", "hashim2015/eq10": "erratum"},
        book=["| eq9 | 1.26 |", "| eq10 | 2 |"],
        bytes={"results/hashim2015/model.json": "x"},
        digits={"results/hashim2015/model.json": "x"},
    )
    table = {"reference": REFERENCE, "kernel SkylakeX": other, "Python 3.13": None}
    page = matrix.page(table)
    assert "| kernel SkylakeX | 1 of 2 | lines that differ: 1 | 0 of 2 | 0 of 1 |" in page
    assert "- kernel SkylakeX: hashim2015/eq9: erratum, in the reference reproduced" in page
    assert "- kernel SkylakeX: `| eq9 | 1.26 |`" in page
    assert "- kernel SkylakeX: figures/hashim2015/fig3.csv" in page
    assert "| Python 3.13 | not run: no such interpreter" in page
    assert matrix.wrong(table) == ["kernel SkylakeX"]


def test_a_run_that_failed_or_made_no_book_counts_as_a_difference():
    assert matrix.wrong({"reference": REFERENCE, "two threads": changed(code=1)}) == ["two threads"]
    without = changed(book=[])
    assert matrix.wrong({"reference": without, "two threads": without}) == ["reference", "two threads"]
    assert "## What follows" not in matrix.page({"reference": without})


def test_a_job_that_ran_under_another_environment_stops_the_program(tmp_path):
    chosen = matrix.PINNED | {"threads": "2", "python": "3.11.7"}
    record = tmp_path / "run/provenance/model.json.json"
    record.parent.mkdir(parents=True)
    record.with_name("figure.json").write_text(json.dumps({"environment": chosen | {"solver": ""}}))
    record.with_name("export.json").write_text("{}")
    with pytest.raises(SystemExit, match="no job noted"):
        matrix.check_jobs(tmp_path, chosen)
    record.write_text(json.dumps({"environment": chosen}))
    matrix.check_jobs(tmp_path, chosen)
    for changed_part in ({"threads": "1"}, {"solver": "SDPA"}, {"kernel": ""}):
        record.write_text(json.dumps({"environment": chosen | changed_part}))
        with pytest.raises(SystemExit, match=next(iter(changed_part))):
            matrix.check_jobs(tmp_path, chosen)


def test_every_job_notes_its_threads_kernel_and_python(fresh_toy, monkeypatch):
    """Snakemake sets the thread variables of a job itself; the project's own variable counts."""
    monkeypatch.setenv("RECONTROL_THREADS", "2")
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Sandybridge")
    project = fresh_toy("threads")
    project.snakemake("results/toy2024/synthesis/gain.json")
    for name in ("model", "synthesis/gain"):
        noted = json.loads((project.folder / f"run/provenance/results/toy2024/{name}.json.json").read_text())[
            "environment"
        ]
        assert (noted["threads"], noted["kernel"]) == ("2", "Sandybridge")
        assert noted["python"] == platform.python_version()
