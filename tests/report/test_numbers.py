"""Numbers as text: decoding, rounding and differing digits, against values worked out by hand or by `decimal`."""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Decimal
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recontrol.report import numbers


@given(
    st.decimals(allow_nan=False, allow_infinity=False, places=9, min_value=-(10**6), max_value=10**6), st.integers(0, 6)
)
@settings(derandomize=True, deadline=None)
def test_fixed_rounds_as_decimal_does(value: Decimal, decimals: int) -> None:
    expected = format(value.quantize(Decimal(1).scaleb(-decimals), rounding=ROUND_HALF_EVEN), "f")
    assert numbers.fixed(Fraction(value), decimals) == (
        expected[1:] if Decimal(expected) == 0 and expected[0] == "-" else expected
    )


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e80, max_value=1e80), st.integers(1, 12))
@settings(derandomize=True, deadline=None)
def test_significant_is_as_close_as_its_digits_allow(value: float, digits: int) -> None:
    exact = Fraction(value)
    shown = Fraction(numbers.significant(exact, digits))
    assert abs(shown - exact) <= Fraction(10) ** (numbers.magnitude(exact) + 1 - digits) / 2 + 0


@pytest.mark.parametrize(
    ("encoded", "expected"),
    [
        (0.5, [[Fraction(1, 2)]]),
        ({"exact": "1/3"}, [[Fraction(1, 3)]]),
        ({"exact": [["1/3", "2"], ["0", "-1"]]}, [[Fraction(1, 3), 2], [0, -1]]),
        ({"ball": {"mid": "5/4", "rad": "1/1024"}}, [[Fraction(5, 4)]]),
        ({"value": [1.5, 2.5], "error": 1e-9}, [[Fraction(3, 2), Fraction(5, 2)]]),
        ([{"exact": "1/7"}, 2], [[Fraction(1, 7), 2]]),
        ("words", None),
        (None, None),
        (True, None),
        ({"margin": 1}, None),
    ],
)
def test_decode(encoded: object, expected: object) -> None:
    cells = numbers.decode(encoded)
    assert (cells and [[cell.re for cell in row] for row in cells]) == expected


def test_decode_keeps_complex_parts_and_radii() -> None:
    cell = numbers.decode({"complex": {"re": [1.0], "im": [-2.0]}})[0][0]
    assert (cell.re, cell.im) == (1, -2)
    assert numbers.decode({"value": 2.0, "error": 0.25})[0][0].radius == Fraction(1, 4)
    ball = {"re": {"ball": {"mid": "-1/2", "rad": "1/8"}}, "im": {"ball": {"mid": "3/4", "rad": "1/8"}}}
    pole = numbers.decode([ball])[0][0]
    assert (pole.re, pole.im, pole.radius) == (Fraction(-1, 2), Fraction(3, 4), Fraction(1, 8))


@pytest.mark.parametrize(
    ("found", "printed", "shown"),
    [
        ("-0.514823", "-0.5147", "-0.5148"),
        ("303.62", "3.036e+02", "3.036e+02"),
        ("-103.66", "-1.037e+02", "-1.037e+02"),
        ("7", "5", "7"),
        ("-0.46751+1.07858i", "-0.4675+-1.0786i", "-0.4675±1.0786i"),
    ],
)
def test_found_numbers_take_the_form_of_the_print(found: str, printed: str, shown: str) -> None:
    assert numbers.write_like(numbers.decode_text(found)[0][0], printed) == shown


@pytest.mark.parametrize(
    ("text", "other", "pieces"),
    [
        ("0.5148", "0.5147", [("0.514", False), ("8", True)]),
        ("-1.179", "1.179", [("-1.179", True)]),
        ("12.5", "2.5", [("12.5", True)]),
        ("2.50", "2.50", [("2.50", False)]),
        ("1.5±2.07i", "1.5±2.08i", [("1.5±2.0", False), ("7", True), ("i", False)]),
    ],
)
def test_mark_starts_at_the_first_differing_place(text: str, other: str, pieces: list[tuple[str, bool]]) -> None:
    assert numbers.mark(text, other) == pieces


def test_distance_is_in_units_of_the_last_printed_place() -> None:
    assert numbers.distance(numbers.Cell(Fraction("0.5149")), "0.5147") == 2
    assert numbers.distance(numbers.Cell(Fraction(305)), "3.036e+02") == 14
