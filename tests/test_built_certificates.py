"""Damaged certificates of a finished run: every one that is accepted must be true, and about the paper as it stands.

RECONTROL_CERTIFICATES sets how many damaged copies of each certificate are tried (default 4; `make faults` takes 20).
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest
from projects import ROOT

sys.path.insert(0, str(ROOT / "tests" / "lmi"))

import independent
from mutations import changes, mutated

from recontrol import paper as papers
from recontrol.lmi import verify

BUILT = os.environ.get("RECONTROL_BUILT", "")
pytestmark = pytest.mark.skipif(not BUILT, reason="RECONTROL_BUILT names no finished run (tools/test.sh makes one)")
COPIES = int(os.environ.get("RECONTROL_CERTIFICATES", "4"))
LARGEST = 150_000
"""Bytes; the second opinion computes in plain fractions, which takes minutes for the few larger files."""
FREE = ("says", "notes", "problem", "precision", "bound", "witness", "case", "source")
"""Keys that the arithmetic judges alone, and those after which the verifier names every datum that they do not give."""
NUMBERING = ("order", "variables")
"""How unknowns are numbered: a proof at a point does not use it, and the forms of all others must stay as they are."""


def certificates(key):
    files = sorted(Path(BUILT, "results", key, "certificates").glob("*.json"))
    return [json.loads(path.read_text()) for path in files if path.stat().st_size < LARGEST]


@pytest.mark.parametrize("key", papers.discover(ROOT))
@pytest.mark.timeout(7200)
def test_damaged_certificates_are_accepted_only_if_true(key, record_property):
    originals = certificates(key)
    count = accepted = 0
    for number, original in enumerate(originals):
        for copy in range(COPIES):
            altered = mutated(original, originals, f"{key} {number} {copy}")
            if altered == original:
                continue
            count += 1
            assert not verify.check(altered, ROOT).holds
            try:
                file = {**altered, "digest": verify.digest(altered)}
            except (TypeError, ValueError):
                continue
            found = verify.check(file, ROOT)
            if found.holds:
                accepted += 1
                assert independent.true_arithmetic(file) is not False, changes(original, file)
                assert about_the_paper(original, file, found.why), (found.why, changes(original, file))
    record_property("cases", count)
    record_property("accepted", accepted)
    assert count > COPIES


def about_the_paper(original, file, why):
    """Whether what changed is judged by arithmetic alone, or named as not the paper's, or no longer said of it.

    Keys that were added are read by nobody; "symmetric" only helps a solver; what arguments are bound to is part of the
    answer; at a point where a bound or a box is proven the conditions hold.
    """
    if "arithmetic alone" in why:
        return True
    named = why.partition("data that the paper does not give: ")[2].split(", ")
    for place in changes(original, file):
        where, _, what = place.partition(": ")
        top, _, rest = where.removeprefix("/").partition("/")
        harmless = what.startswith("None -> ") or where.endswith("/symmetric") or "/rename/" in where
        harmless |= original["proof"] == "point" and what in ("bound -> definite", "box -> definite")
        if not (top in (*FREE, *NUMBERING) or (top == "data" and rest.split("/")[0] in named) or harmless):
            return False
    return True
