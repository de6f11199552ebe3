"""The verdict rules, row by row."""

from __future__ import annotations

import pytest

from recontrol.claims.verdict import Finding, derive

D, A, E = "definition", "assumption", "explanation"


def findings(*pairs):
    return [Finding(f"r{i}", kind, agrees, strength) for i, (kind, agrees, strength) in enumerate(pairs)]


@pytest.mark.parametrize(
    ("compare", "unique", "pairs", "verdict", "strength"),
    [
        ("digits", True, [(D, "yes", "exact")], "reproduced", "exact"),
        ("digits", True, [(D, "yes", "ball"), (A, "no", "float")], "reproduced", "ball"),
        ("digits", True, [(D, "no", "exact"), (D, "yes", "float")], "reproduced", "float"),
        ("digits", True, [(D, "no", "exact"), (A, "yes", "ball")], "reproduced-under-assumption", "ball"),
        ("digits", True, [(D, "open", "float"), (A, "yes", "ball")], "reproduced-under-assumption", "ball"),
        ("digits", False, [(D, "yes", "exact")], "certified", "exact"),
        ("digits", False, [(A, "yes", "ball")], "certified", "ball"),
        ("digits", True, [(D, "no", "exact")], "erratum", "exact"),
        ("digits", True, [(D, "no", "exact"), (D, "no", "float")], "erratum", "float"),
        ("digits", True, [(D, "no", "exact"), (A, "no", "float"), (E, "no", "float")], "erratum", "exact"),
        ("digits", False, [(D, "no", "exact"), (E, "yes", "ball")], "erratum", "exact"),
        ("digits", True, [(D, "no", "exact"), (D, "open", "float")], "failed", None),
        ("digits", True, [(A, "no", "exact"), (E, "yes", "ball")], "erratum", "ball"),
        ("digits", True, [(E, "yes", "exact")], "erratum", "exact"),
        ("digits", True, [(A, "open", "float"), (E, "yes", "ball")], "failed", None),
        ("digits", True, [(A, "no", "exact"), (A, "no", "float")], "not-reproduced", "float"),
        ("digits", True, [(A, "no", "exact"), (E, "no", "exact")], "not-reproduced", "exact"),
        ("digits", True, [(A, "no", "exact"), (E, "open", "exact")], "failed", None),
        ("digits", True, [(D, "open", "float")], "failed", None),
        ("digits", True, [(D, "yes", "exact"), (A, "broken", "float")], "failed", None),
        ("digits", True, [], "failed", None),
        ("none", True, [], "unspecified", None),
        ("none", True, [(A, "shown", "float")], "unspecified", None),
        ("none", True, [(A, "broken", "float")], "failed", None),
    ],
)
def test_first_rule_that_fits(compare, unique, pairs, verdict, strength):
    result = derive(compare, unique, findings(*pairs))
    assert (result.verdict, result.strength) == (verdict, strength)


def test_all_agreeing_explanations_are_listed():
    result = derive(
        "digits", True, findings((D, "no", "exact"), (E, "yes", "ball"), (E, "no", "ball"), (E, "yes", "float"))
    )
    assert result.explanations == ("r1", "r3")
