"""Sampled loops against closed forms of the double integrator, quadrature, and balls against floats."""

import numpy as np
import pytest
from flint import arb, fmpq

from recontrol.exact import rational as ra
from recontrol.exact.ball import box, precision
from recontrol.systems import sampled

MASS_POINT = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]])


def exact_mass_point(gain):
    A = ra.matrix([[0, 1], [0, 0]])
    return A, ra.matrix([[0], [1]]) @ ra.matrix([gain])


def test_hold_of_the_double_integrator_is_polynomial():
    A, B = MASS_POINT
    free, forced = sampled.zero_order_hold(A, B, 0.3)
    assert free == pytest.approx(np.array([[1, 0.3], [0, 1]]), abs=1e-15)
    assert forced == pytest.approx(np.array([[0.045], [0.3]]), abs=1e-15)


def test_integral_action_integrates_the_output_error():
    A, B = MASS_POINT
    C = np.array([[1.0, 0.0]])
    A_bar, B_bar, B1_bar = sampled.integral_action(A, B, C)
    state, control, exogenous = np.array([2.0, 3.0, 5.0]), np.array([7.0]), np.array([11.0, 13.0])
    rate = A_bar @ state + B_bar @ control + B1_bar @ exogenous
    assert rate == pytest.approx([3.0, 7.0 + 11.0, 2.0 - 13.0])


def test_integral_action_keeps_exact_entries():
    A, B = ra.matrix([[0, 1], [0, 0]]), ra.matrix([[0], ["1/200"]])
    parts = sampled.integral_action(A, B, ra.matrix([[1, 0]]))
    assert all(type(x) in (fmpq, int) for M in parts for x in M.flat)


def test_ball_monodromy_contains_the_polynomial_one():
    A, G = exact_mass_point([-1, -2])
    h = fmpq(1, 3)
    with precision(100):
        difference = sampled.monodromy(A, G, h) - ra.matrix([[1 - h * h / 2, h - h * h], [-h, 1 - 2 * h]])
    assert all(x.contains(0) and x.rad() < 1e-25 for x in difference.flat)


def test_transition_multiplies_the_later_interval_from_the_left():
    A, B = MASS_POINT
    G = B @ np.array([[-1.0, -2.0]])
    product = sampled.monodromy(A, G, 0.7) @ sampled.monodromy(A, G, 0.2)
    assert sampled.transition(A, G, [0.2, 0.7]) == pytest.approx(product, abs=1e-14)
    with pytest.raises(sampled.SampledError, match="at least one"):
        sampled.transition(A, G, [])


def test_rate_of_a_scalar_loop():
    # x' = -x(t_k): M = 1 - h, so the rate at h = 1/2 is 2 ln 2
    A, G = ra.matrix([[0]]), ra.matrix([[-1]])
    with precision(100):
        rate = sampled.decay_rate(A, G, fmpq(1, 2))
        assert rate.overlaps(2 * arb(2).log())
        assert rate.rad() < 1e-25
    assert sampled.decay_rate(np.zeros((1, 1)), -np.eye(1), 0.5) == pytest.approx(2 * np.log(2), rel=1e-14)


def test_largest_period_of_the_scalar_loop_is_two():
    bracket = sampled.largest_period(ra.matrix([[0]]), ra.matrix([[-1]]), start=0.1, stop=3.03, width=1e-9, grid=50)
    assert bracket.proven
    assert bracket.low < 2 < bracket.high
    assert float((bracket.high - bracket.low).q) > 1e8


def test_largest_period_needs_a_crossing():
    with pytest.raises(sampled.SampledError, match="no loss"):
        sampled.largest_period(ra.matrix([[0]]), ra.matrix([[-1]]), start=0.1, stop=1.9, width=1e-6)


def test_contraction_is_proven_for_the_whole_box_and_not_beyond_the_radius():
    A, G = exact_mass_point([-1, -2])
    half = ra.matrix([[0, 0], ["1/10000", "1/10000"]])
    with precision(100):
        M = sampled.monodromy(A, box(G, half), fmpq(1, 2))
    radius = sampled.spectral_radius(sampled.monodromy(ra.to_float(A), ra.to_float(G), 0.5))
    assert sampled.contracts(M, ra.rounded(radius, 6) + fmpq(1, 1000))
    assert not sampled.contracts(M, ra.rounded(radius, 6) - fmpq(1, 1000))


def test_held_cost_is_the_integral_of_the_held_motion():
    A, B = MASS_POINT
    G, C = B @ np.array([[-1.0, -2.0]]), np.array([[1.0, 0.5]])
    W = sampled.held_cost(A, G, C, 0.8)
    times, weights = np.polynomial.legendre.leggauss(12)
    expected = np.zeros((2, 2))
    for t, weight in zip(0.4 * (times + 1), 0.4 * weights, strict=True):
        row = C @ sampled.monodromy(A, G, t)
        expected += weight * row.T @ row
    # the integrand is a polynomial of degree 4, twelve Gauss points are exact
    assert pytest.approx(expected, abs=1e-13) == W


def test_exact_and_float_cost_agree():
    A, G = exact_mass_point([-1, -2])
    C = ra.matrix([[1, "1/2"]])
    with precision(100):
        W = sampled.held_cost(A, G, C, fmpq(4, 5))
    expected = sampled.held_cost(ra.to_float(A), ra.to_float(G), ra.to_float(C), 0.8)
    assert np.array([[float(x) for x in row] for row in W]) == pytest.approx(expected, abs=1e-13)


def scalar_lift(parts):
    one = np.eye(1)
    return sampled.lifted(0 * one, -one, one, one, 0.5, parts)


def test_lifted_gain_at_zero_frequency_is_the_static_gain():
    # x' = -x(t_k) + d has the static gain one for a constant input, whatever the number of parts
    for parts in (1, 4):
        system = scalar_lift(parts)
        assert system.gain(0.0) >= 1 - 1e-12
        constant = np.ones(parts)
        steady = system.C @ np.linalg.solve(np.eye(1) - system.M, system.B @ constant) + system.D @ constant
        assert steady.ravel() == pytest.approx(np.ones(parts), abs=1e-12)


def test_sampled_gain_bounds_a_simulated_ratio():
    system = scalar_lift(4)
    gain, _ = sampled.sampled_gain(system)
    rng = np.random.default_rng(1)
    x, energy_in, energy_out = np.zeros(1), 0.0, 0.0
    for k in range(400):
        d = rng.normal(size=4) if k < 200 else np.zeros(4)
        z = system.C @ x + system.D @ d
        x = system.M @ x + system.B @ d
        energy_in, energy_out = energy_in + d @ d, energy_out + z @ z
    assert energy_out <= gain**2 * energy_in


def test_unstable_loop_has_no_gain():
    with pytest.raises(sampled.SampledError, match="unstable"):
        sampled.sampled_gain(sampled.lifted(np.eye(1), 0 * np.eye(1), np.eye(1), np.eye(1), 0.5, 2))
