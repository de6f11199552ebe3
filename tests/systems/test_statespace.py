"""Realisations, transfer polynomials and loops against library routes."""

import numpy as np
import pytest

from recontrol.systems import statespace as ss

RNG = np.random.default_rng(11)
PLANT = ss.state_space(RNG.normal(size=(3, 3)), RNG.normal(size=3), RNG.normal(size=3))
COMPENSATOR = ss.state_space(RNG.normal(size=(2, 2)), RNG.normal(size=2), RNG.normal(size=2), -0.7)


def test_transfer_function_matches_the_frequency_response():
    w = np.geomspace(0.01, 100, 25)
    num, den = ss.transfer_function(COMPENSATOR)
    found = np.polyval(num, 1j * w) / np.polyval(den, 1j * w)
    np.testing.assert_allclose(found, ss.frequency_response(COMPENSATOR, w)[:, 0, 0], rtol=1e-12)


def test_characteristic_polynomial_keeps_small_coefficients():
    """det(sI - A) = (s - 1)^4 + 1e-14 up to rounding of the data: floats would lose the last coefficient."""
    A = np.diag(np.ones(3), 1) + np.eye(4)
    A[3, 0] = -1e-14
    found = ss.characteristic_polynomial(A) - np.array([1, -4, 6, -4, 1.0])
    assert found[4] == pytest.approx(1e-14, rel=0.05)  # the sum 1 + 1e-14 is rounded to a double
    np.testing.assert_array_equal(found[:4], 0)


def test_loop_polynomial_is_the_product_rule():
    (bp, ap), (bk, ak) = ss.transfer_function(PLANT), ss.transfer_function(COMPENSATOR)
    expected = np.polysub(np.polymul(ap, ak), np.polymul(bp, bk))
    np.testing.assert_allclose(np.poly(ss.loop_matrix(PLANT, COMPENSATOR)), expected, rtol=1e-10, atol=1e-12)


def test_input_sensitivity_is_one_over_one_minus_pk():
    w = np.geomspace(0.1, 10, 7)
    p, k, s = (
        ss.frequency_response(g, w)[:, 0, 0] for g in (PLANT, COMPENSATOR, ss.input_sensitivity(PLANT, COMPENSATOR))
    )
    np.testing.assert_allclose(s, 1 / (1 - p * k), rtol=1e-10)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((np.ones((2, 3)), np.ones(2), np.ones(3)), r"A is \(2, 3\)"),
        ((np.eye(2), np.ones(3), np.ones(2)), r"B is \(3,\), expected \(2, n_u\)"),
        ((np.eye(2), np.ones(2), np.ones(3)), r"C is \(3,\)"),
        ((np.eye(2), np.ones(2), np.ones(2), np.ones((2, 2))), r"D is \(2, 2\), expected \(1, 1\)"),
    ],
)
def test_shape_errors_name_the_matrix(arguments, words):
    with pytest.raises(ss.ShapeError, match=words):
        ss.state_space(*arguments)


def test_loop_refuses_a_plant_with_direct_term():
    with pytest.raises(ss.ShapeError, match="direct term"):
        ss.loop_matrix(COMPENSATOR, PLANT)
