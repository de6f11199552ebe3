"""Polynomials in exact and ball arithmetic, each against floats or another closed form."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from flint import arb, fmpq, fmpq_poly

from recontrol.exact import ball, rational
from recontrol.exact import polynomial as poly

SEEDS = range(6)


def random_matrix(seed: int, m: int, n: int) -> np.ndarray:
    draw = np.random.default_rng(seed).integers
    return rational.matrix([[fmpq(int(draw(-9, 10)), int(draw(1, 8))) for _ in range(n)] for _ in range(m)])


def descending(p) -> np.ndarray:
    return np.array([float(c) for c in reversed(p.coeffs())])


@pytest.mark.parametrize("seed", SEEDS)
def test_charpoly_is_that_of_floats(seed):
    M = random_matrix(seed, 4, 4)
    expected = np.poly(rational.to_float(M))
    # Entries below 10 and n = 4: coefficients lose at most a few digits of 16.
    assert np.allclose(descending(poly.charpoly(M)), expected, rtol=1e-11, atol=1e-9)
    assert np.allclose(descending(poly.charpoly(ball.to_ball(M))), expected, rtol=1e-11, atol=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_roots_multiply_back_to_the_polynomial(seed):
    p = poly.monic(fmpq_poly([*random_matrix(seed, 1, 5).ravel().tolist(), 1]))
    with ball.precision(poly.PRECISION):
        product = poly.from_roots(poly.roots(p))
        assert all(c.contains(x) for c, x in zip(product.coeffs(), p.coeffs(), strict=True))


def test_roots_come_fastest_first_and_above_the_axis_first():
    p = fmpq_poly([5, 2, 1]) * fmpq_poly([1, 1, 1])  # -1 +- 2i, -0.5 +- 0.87i
    found = [complex(float(z.real), float(z.imag)) for z in poly.roots(p)]
    assert [round(z.real, 9) for z in found] == [-1, -1, -0.5, -0.5]
    assert [z.imag > 0 for z in found] == [True, False, True, False]


@pytest.mark.parametrize("seed", SEEDS)
def test_spectral_factor_times_its_reflection_is_the_polynomial(seed):
    a = poly.monic(fmpq_poly([*random_matrix(seed, 1, 4).ravel().tolist(), 1]))
    even = a * poly.reflect(a) + fmpq_poly([3])
    with ball.precision(poly.PRECISION):
        h = poly.spectral_factor(even)
        product = h * poly.reflect(h)
        assert all(c.contains(x) for c, x in zip(product.coeffs(), even.coeffs(), strict=True))
        assert poly.is_hurwitz(h) is True


def test_spectral_factor_refuses_roots_on_the_axis_and_odd_powers():
    with pytest.raises(poly.RootError):
        poly.spectral_factor(fmpq_poly([1, 0, 1]))
    with pytest.raises(ValueError, match="even"):
        poly.spectral_factor(fmpq_poly([1, 1, 1]))


@pytest.mark.parametrize("seed", range(40))
def test_hurwitz_is_what_float_roots_say(seed):
    # Three quadratic factors s^2 + a s + b, b > 0; about half of the products are Hurwitz.
    p = fmpq_poly([1])
    for x, y in random_matrix(seed, 3, 2):
        p = p * fmpq_poly([abs(y) + fmpq(1, 9), x + fmpq(21, 10), 1])
    largest = np.roots(descending(p)).real.max()
    assert abs(largest) > 1e-6  # far enough for floats to be a judge
    assert poly.is_hurwitz(p) is bool(largest < 0)
    with ball.precision(128):
        assert poly.is_hurwitz(poly.ball_poly(p)) is bool(largest < 0)
    positive = [c > 0 for c in poly.routh_column(p)]
    assert sum(a != b for a, b in itertools.pairwise(positive)) == sum(np.roots(descending(p)).real > 0)


def test_hurwitz_is_open_for_a_ball_across_the_boundary():
    wide = arb(0, 1)
    assert poly.is_hurwitz(poly.arb_poly([arb(2), wide, arb(1)])) is None
    assert poly.is_hurwitz(fmpq_poly([2, 0, 1])) is False


def test_real_roots_of_a_known_product():
    p = fmpq_poly([-2, 1]) * fmpq_poly([fmpq(1, 3), 1]) * fmpq_poly([1, 0, 1])
    found = poly.real_roots(p)
    assert len(found) == 2
    with ball.precision(poly.PRECISION):
        assert all(abs(x - exact) < 1e-60 for x, exact in zip(found, (fmpq(-1, 3), fmpq(2)), strict=True))


def test_an_end_is_bracketed_by_decided_points():
    inside, outside = poly.decide_end(lambda q: q * q < 2, fmpq(1), fmpq(2))
    assert inside * inside < 2 < outside * outside
    assert outside - inside < fmpq(1, 10**15)
    with pytest.raises(ValueError, match="inside"):
        poly.decide_end(lambda q: True, fmpq(1), fmpq(2))


@pytest.mark.parametrize("seed", SEEDS)
def test_ackermann_places_the_polynomial(seed):
    A, B = random_matrix(seed, 4, 4), random_matrix(seed + 100, 4, 1)
    p = poly.monic(fmpq_poly([*random_matrix(seed + 200, 1, 4).ravel().tolist(), 1]))
    assert poly.charpoly(A - B @ poly.ackermann(A, B, p)) == p
    C = random_matrix(seed + 300, 1, 4)
    assert poly.charpoly(A - poly.place_estimator(A, C, p) @ C) == p


def test_four_polynomials_decide_all_vertices_of_a_box():
    rng = np.random.default_rng(2)
    outcomes = set()
    for _ in range(60):
        centre = np.poly(-rng.uniform(0.3, 2.0, size=2) * (1 + 1j * rng.uniform(0.5, 3.0, size=2))).conj()
        middle = np.real(np.polymul(centre, centre.conj()))[:0:-1]  # ascending, degree 4
        half = rng.uniform(0.02, 0.5) * np.abs(middle)
        ends = [(rational.rounded(m - h, 6), rational.rounded(m + h, 6)) for m, h in zip(middle, half, strict=True)]
        vertices = [fmpq_poly([*corner, 1]) for corner in itertools.product(*ends)]
        by_vertices = all(poly.is_hurwitz(p) for p in vertices)
        assert all(poly.is_hurwitz(p) for p in poly.kharitonov_corners(ends)) is by_vertices
        outcomes.add(by_vertices)
    assert outcomes == {True, False}
