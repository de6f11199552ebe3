"""A misprint in a digit that agrees is noticed."""

from __future__ import annotations

import dataclasses

import numpy as np
from flint import fmpq

from recontrol.claims import compare as comparing
from recontrol.claims import scalars, sensitivity
from recontrol.claims.schema import Claim


def test_every_changed_digit_changes_the_verdict():
    reading = {"name": "r", "kind": "definition", "function": "f"}
    claim = Claim.model_validate(
        {
            "id": "x",
            "where": "(1)",
            "title": "t",
            "compare": "digits",
            "printed": "-1.1790 0.0974\n3.036e+02 0",
            "because": "b",
            "readings": [reading],
            "expected": {"verdict": "reproduced"},
        }
    )
    value = np.array([[fmpq(-11790123, 10**7), fmpq(97400001, 10**9)], [fmpq(303601, 1000), fmpq(0)]], dtype=object)
    outcome = comparing.compare(claim, "digits", value, None)
    assert outcome.agrees == "yes"
    entries = [dataclasses.asdict(entry) for entry in outcome.entries]
    record = {"findings": [{"agrees": "yes", "strength": "exact", "cases": [], "entries": entries}]}
    changes = list(sensitivity.misprints(claim, None))
    assert len(changes) == 9 * (5 + 5 + 4 + 1)
    assert {sensitivity.verdict_with(claim, record, change) for change in changes} == {"erratum"}


def test_enclosure_is_rounded_outward():
    for value in (fmpq(1, 3), fmpq(-2, 3), fmpq(10**30, 7), fmpq(-1, 7 * 10**30), fmpq(1), fmpq(999999, 1000)):
        low, high = scalars.decimal_end(value, down=True), scalars.decimal_end(value, down=False)
        below, above = sensitivity._rational(low), sensitivity._rational(high)
        assert below <= value <= above
        assert above - below <= abs(value) / fmpq(10) ** 22


def test_a_looser_bound_is_kept_and_counted_with_its_reason():
    """0.30 is kept by 0.25; so are the eight bounds above it and those whose first digit grew, and 0.2x is not."""
    claim = Claim.model_validate(
        {
            "id": "b",
            "where": "(1)",
            "title": "t",
            "compare": "bound",
            "bound": "<=",
            "printed": "0.30",
            "because": "b",
            "readings": [{"name": "r", "kind": "definition", "function": "f"}],
            "expected": {"verdict": "reproduced"},
        }
    )
    outcome = comparing.compare(claim, "bound", fmpq(1, 4), None)
    entries = [dataclasses.asdict(entry) for entry in outcome.entries]
    findings = [{"agrees": "yes", "strength": "exact", "cases": [], "entries": entries}]
    found = sensitivity.survey(None, [claim], {"b": {"verdict": "reproduced", "findings": findings}})
    assert found.changed == 3  # 0.00, 0.10, 0.20
    assert len(found.kept) == 3 * 9 - 3
    assert {reason for _, _, reason in found.kept} == {sensitivity.REASONS["bound"]}
