"""Printed text as intervals, and the ways to compare."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import sympy
from flint import acb, arb, fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from recontrol.claims import compare as comparing
from recontrol.claims.printed import Number, Printed, parse_mask
from recontrol.claims.schema import Claim
from recontrol.claims.values import Approx, Identity, Size, Statement
from recontrol.errors import PaperError, ValueContractError


def claim(printed, compare="digits", **options):
    reading = {"name": "r", "kind": "definition", "function": "f"}
    content = {"id": "x", "where": "(1)", "title": "t", "compare": compare, "printed": printed, "because": "b"}
    return Claim.model_validate(content | {"readings": [reading], "expected": {"verdict": "reproduced"}} | options)


def agrees(printed, value, compare="digits", **options):
    return comparing.compare(claim(printed, compare, **options), compare, value, SimpleNamespace()).agrees


def test_decimals_count():
    number = Number.parse("0.0050")
    assert (number.value, number.unit, number.digits) == (fmpq(1, 200), fmpq(1, 10000), 2)
    assert Number.parse("3.036e+02").unit == fmpq(1, 10)
    assert Number.parse("-12").unit == 1


@pytest.mark.parametrize("text", ["1,5", "0x1", "nan", "1e9999", "--1", "1 2\n3", "", "１"])
def test_unreadable_print_is_refused(text):
    with pytest.raises(PaperError, match="printed text"):
        Printed.parse(text)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (fmpq(1235, 1000), "yes"),  # either rounding of a tie
        (fmpq(1245, 1000), "yes"),
        (fmpq(12451, 10000), "no"),
        (arb(fmpq(124, 100)), "yes"),
        (arb("1.245 +/- 1e-6"), "open"),
        (Approx(1.2449, 1e-5), "yes"),
        (Approx(1.2449, 1e-3), "open"),
        (Approx(1.3, 1e-3), "no"),
    ],
)
def test_digits(value, expected):
    assert agrees("1.24", value) == expected


@pytest.mark.parametrize(
    ("printed", "value", "expected"),
    [
        ("0.5147", fmpq(51479, 100000), "yes"),
        ("0.5147", fmpq(5148, 10000), "no"),
        ("-0.5147", fmpq(-51479, 100000), "yes"),
        ("-0.5147", fmpq(-51469, 100000), "no"),
        ("0.00", fmpq(-9, 1000), "yes"),
        ("0.00", fmpq(1, 100), "no"),
    ],
)
def test_cut(printed, value, expected):
    assert agrees(printed, value, "cut") == expected


def test_conjugate_pairs_compare_both_parts():
    assert agrees("-0.4675+-1.0786i", Approx(-0.46751 + 1.07858j, 1e-6)) == "yes"
    assert agrees("-0.4675+-1.0786i", acb(fmpq(-4675, 10000), fmpq(10788, 10000))) == "no"


def test_distance_is_counted_in_last_places():
    outcome = comparing.compare(claim("1.179 0.515"), "digits", np.array([[fmpq(1181, 1000), fmpq(515, 1000)]]), None)
    assert outcome.units_in_last_place == 2.0
    assert [entry.digits for entry in outcome.entries] == [3, 3]
    assert outcome.agrees == "no"


def test_mask_leaves_out_entries():
    matrix = np.array([[fmpq(1), fmpq(7)], [fmpq(3), fmpq(4)]])
    assert agrees("1 2\n3 4", matrix) == "no"
    assert agrees("1 2\n3 4", matrix, **{"except": "1,2"}) == "yes"
    assert agrees("1 2\n3 4", matrix, entries="2,:") == "yes"
    assert parse_mask("1:2,1;2,2", None, (2, 2)).tolist() == [[True, False], [True, True]]
    with pytest.raises(PaperError, match="leaves no entry"):
        parse_mask("1,1", "1,1", (2, 2))


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (Statement(fmpq(1)), "yes"),
        (Statement(fmpq(0)), "no"),
        (Statement(fmpq(0), strict=False), "yes"),
        (Statement({"a": fmpq(1), "b": arb("0 +/- 1")}), "open"),
        (Statement({"a": fmpq(-1), "b": arb("0 +/- 1")}), "no"),
        (Statement.any_of({"a": fmpq(-1), "b": Approx(1.0, 0.1)}), "yes"),
    ],
)
def test_statement(value, expected):
    assert agrees("holds", value, "statement") == expected


def test_identity_is_exact_and_refuses_floats():
    x = sympy.Symbol("x")
    assert agrees("a = b", Identity((x + 1) ** 2, x**2 + 2 * x + 1), "identity") == "yes"
    assert agrees("a = b", Identity(fmpq_poly([1, 2]), fmpq_poly([1, 2])), "identity") == "yes"
    assert agrees("a = b", Identity(fmpq(1, 3), fmpq(333, 1000)), "identity") == "no"
    with pytest.raises(ValueContractError):
        agrees("a = b", Identity(np.array([1.0]), np.array([1.0])), "identity")


def test_size_bound_and_range():
    assert agrees("4x1", Size(4, 1), "size") == "yes"
    assert agrees("3x1", Size(4, 1), "size") == "no"
    assert agrees("2.0", Approx(1.9, 0.01), "bound", bound="<=") == "yes"
    assert agrees("2.0", Approx(2.2, 0.01), "bound", bound="<=") == "no"
    assert agrees("about one", Approx(1.2, 0.1), "range", range=["0.5", "1.5"]) == "yes"


@pytest.mark.parametrize("value", [1.0, np.array([[1.0]]), "1", None, arb("nan"), np.array([[fmpq(1), fmpq(2)]])])
def test_values_without_meaning_are_refused(value):
    with pytest.raises(ValueContractError):
        agrees("1.0", value)


@settings(derandomize=True, deadline=None, max_examples=200)
@given(st.integers(-(10**6), 10**6), st.integers(0, 5), st.fractions(-1, 1))
def test_rounding_interval_is_the_set_of_numbers_that_round_to_the_print(mantissa, decimals, shift):
    text = f"{'-' if mantissa < 0 else ''}{abs(mantissa) // 10**decimals}"
    if decimals:
        text += f".{abs(mantissa) % 10**decimals:0{decimals}d}"
    unit = fmpq(1, 10**decimals)
    value = mantissa * unit + fmpq(shift.numerator, shift.denominator) * unit
    distance = abs(shift)
    expected = "yes" if distance <= 0.5 else "no"
    assert agrees(text, value) == expected
