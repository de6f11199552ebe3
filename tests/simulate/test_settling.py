"""Settling, overshoot and undershoot against closed forms of second-order responses."""

import math

import numpy as np
import pytest

from recontrol.simulate import linear, settling
from recontrol.systems.statespace import state_space


def second_order(damping, zero=0.0, gain=1.0):
    """gain (1 + zero s) / (s^2 + 2 damping s + 1)."""
    return state_space([[-2 * damping, -1.0], [1.0, 0.0]], [1.0, 0.0], [gain * zero, gain])


@pytest.mark.parametrize("band", [0.01, 0.02, 0.05])
def test_first_order_settles_at_the_logarithm_of_the_band(band):
    response = linear.step_response(state_space([[-0.25]], [0.25], [1.0]), 64.0, 801)
    assert settling.settling_time(response, 1.0, band) == pytest.approx(-4 * math.log(band), abs=1e-9)


@pytest.mark.parametrize("gain", [1.0, -3.0, 1e-6])
def test_overshoot_of_the_second_order_lag(gain):
    damping = 0.3
    system = second_order(damping, gain=gain)
    response = linear.step_response(system, 60.0, 301)
    expected = math.exp(-math.pi * damping / math.sqrt(1 - damping**2))
    assert settling.overshoot(response, linear.final_value(system)) == pytest.approx(expected, rel=1e-10)
    assert settling.undershoot(response, linear.final_value(system)) == 0.0


def test_undershoot_of_a_zero_in_the_right_half_plane():
    # y = 1 - (1 + 2 t) exp(-t) for the double pole at -1 and the zero at +1: smallest at t = 1/2.
    system = second_order(1.0, zero=-1.0)
    response = linear.step_response(system, 30.0, 401)
    assert settling.undershoot(response, 1.0) == pytest.approx(2 * math.exp(-0.5) - 1, rel=1e-10)


@pytest.mark.parametrize("samples", [101, 997, 8001])
def test_settling_does_not_depend_on_the_grid(samples):
    """With 101 samples the last swing that leaves the band peaks between samples."""
    system = second_order(0.05)
    fine = linear.step_response(system, 200.0, 200_001)
    last = fine.times[np.flatnonzero(np.abs(fine.outputs - 1) > 0.02)[-1]]
    found = settling.settling_time(linear.step_response(system, 200.0, samples), 1.0, 0.02)
    assert last <= found <= last + 1e-3


def test_a_swing_that_just_touches_the_band_is_seen_between_samples():
    system = second_order(0.2)
    peak_time = 3 * math.pi / math.sqrt(0.96)
    height = math.exp(-0.2 * peak_time)  # third extreme of the error
    grid = linear.step_response(system, 40.0, 58)
    inside, outside = (settling.settling_time(grid, 1.0, height * (1 + d)) for d in (1e-6, -1e-6))
    assert inside < peak_time - 0.5
    assert outside == pytest.approx(peak_time, abs=0.01)


def test_unsettled_and_already_settled():
    growing = linear.step_response(state_space([[0.1]], [1.0], [1.0]), 10.0, 50)
    assert settling.settling_time(growing, -10.0, 0.02) == math.inf
    constant = linear.step_response(state_space([[-1.0]], [0.0], [1.0], 1.0), 10.0, 50)
    assert settling.settling_time(constant, 1.0, 0.02) == 0.0


def test_final_value_zero_has_no_overshoot():
    response = linear.step_response(second_order(0.3), 10.0, 50)
    assert settling.overshoot(response, 0.0) == settling.undershoot(response, 0.0) == math.inf


def test_last_exit_of_many_responses():
    t = np.linspace(0, 10, 1001)
    y = np.stack([np.exp(-t), np.zeros_like(t), np.ones_like(t), -5 * np.exp(-2 * t)], axis=1)
    found = settling.last_exit(t, y, 0.02)
    expected = [math.log(50), 0.0, math.inf, math.log(50) / 2]
    np.testing.assert_allclose(found, expected, rtol=0, atol=0.01)  # one sample
