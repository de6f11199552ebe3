"""The page of environments shows every difference that was measured."""

from __future__ import annotations

import copy
import sys

from tools import tree

sys.path.insert(0, str(tree.ROOT / "tools"))

import matrix

REFERENCE = {
    "python": "3.11.7",
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


def test_a_run_that_failed_counts_as_a_difference():
    assert matrix.wrong({"reference": REFERENCE, "two threads": changed(code=1)}) == ["two threads"]
