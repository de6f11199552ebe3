"""A claim in one line: what was found is shown to the digits that say something."""

from __future__ import annotations

from recontrol.report import brief, present
from recontrol.report.claim import Claim


def claim(compare, printed, verdict="reproduced", **finding):
    raw = {"verdict": verdict, "printed": printed, "compare": compare, "reading": "one", "strength": "float"}
    raw["findings"] = [{"reading": "one", "kind": "definition", "agrees": "yes", **finding}]
    return Claim("smith2024", raw, {"id": "eq1", "compare": compare}, printed)


def test_a_found_number_has_the_places_of_the_print_and_a_found_bound_its_own():
    assert brief.found(claim("digits", "2.0", value="2.0453")) == "2.0"
    assert brief.found(claim("bound", "2", value="0.44534")) == "0.4453"


def test_cases_that_disagree_are_counted():
    cases = {"a": {"agrees": "yes", "value": "19.2"}, "b": {"agrees": "no", "value": "20.97"}}
    assert brief.found(claim("bound", "20", cases=cases)) == "1 of 2 cases agree"
    cases["b"]["agrees"] = "yes"
    assert brief.found(claim("bound", "20", cases=cases)) == "19.2"


def test_a_certificate_is_told_without_what_it_was_rebuilt_from():
    said = "2 condition(s) hold at the stored point; rebuilt from papers/smith2024, case 'box': decay"
    assert brief.found(claim("statement", "stable", value=said)) == "2 condition(s) hold at the stored point"


def test_margins_are_told_only_where_they_refute_beyond_rounding():
    said = "gap = -0.13349; other = -2"
    assert brief.found(claim("statement", "stable", value=said)) == "holds"
    refuted = claim("statement", "stable", verdict="erratum", value=said)
    refuted.strength = "exact"
    refuted.decisive.agrees = "no"
    assert brief.found(refuted) == "gap = -0.1335; other = -2"


def test_a_case_that_disagrees_as_an_interval_is_marked_beside_the_print():
    cases = {"a": {"agrees": "yes", "value": "190"}, "b": {"agrees": "no", "value": "251.19"}}
    printed, found = present.panels(claim("range", "200", cases=cases))
    assert (found.agreeing, found.counted) == (0, 1)
    assert found.rows[0][0].pieces == [("2", False), ("51", True)]
    assert printed.rows[0][0].pieces == [("2", False), ("00", True)]
    cases["b"]["agrees"] = "yes"
    assert present.panels(claim("range", "200", cases=cases))[1].agreeing == 1
