"""Margins against closed forms, bisection on eigenvalues, frequency sweeps and a library norm."""

import math

import numpy as np
import pytest

from recontrol.systems import margins
from recontrol.systems.statespace import frequency_response, input_sensitivity, loop_matrix, state_space

# Three equal lags with gain g in negative feedback: stable up to g = 8, lost at sqrt(3) rad/s.
LAGS = state_space([[-1, 0, 0], [1, -1, 0], [0, 1, -1.0]], [1, 0, 0], [0, 0, 1.0])


def gain(value):
    """A static compensator, with a fast stable mode that it does not use."""
    return state_space([[-9.0]], [0.0], [0.0], value)


def stable_gains(plant, compensator, low, high):
    """Bisection on the spectral abscissa: the second route to an end of the gain interval."""

    def abscissa(k):
        A, B, C, D = compensator
        return np.max(np.linalg.eigvals(loop_matrix(plant, state_space(A, B, k * C, k * D))).real)

    sign = abscissa(low) < 0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (abscissa(middle) < 0) == sign else (low, middle)
    return low


def test_three_lags_lose_stability_at_eight():
    found = margins.gain_interval(*margins.loop_transfer(LAGS, gain(-2.0)))
    assert found.upper == pytest.approx(4.0, rel=1e-9)
    assert found.upper_frequency == pytest.approx(math.sqrt(3), rel=1e-9)
    assert found.lower == 0.0
    assert "0 < k < 1" in found.argument


def test_conditionally_stable_loop_has_two_ends():
    """An unstable pole needs a least gain, two lags allow no more than some gain."""
    plant = state_space([[0.4, 0, 0], [1, -3, 0], [0, 1, -4.0]], [1, 0, 0], [0, 0, 12.0])
    compensator = gain(-1.0)
    found = margins.gain_interval(*margins.loop_transfer(plant, compensator))
    assert found.lower == pytest.approx(0.4, rel=1e-9)  # den(0) + 12 k = 0 with den(0) = -4.8
    assert found.lower_frequency == 0.0
    assert found.upper == pytest.approx(stable_gains(plant, compensator, 1.0, 50.0), rel=1e-8)


def test_loop_without_upper_end_says_so():
    found = margins.gain_interval(*margins.loop_transfer(state_space([[-1.0]], [1.0], [1.0]), gain(-1.0)))
    assert found.upper == math.inf
    assert "k > 1" in found.argument


def test_direct_terms_lose_a_pole_through_infinity():
    """den + k num = s + 1 - k (s / 2 + 1 / 4): the leading coefficient vanishes at k = 2."""
    found = margins.gain_interval(np.array([-0.5, -0.25]), np.array([1.0, 1.0]))
    assert (found.upper, found.upper_frequency) == (pytest.approx(2.0), math.inf)


def test_unstable_loop_has_no_margins():
    with pytest.raises(margins.UnstableLoopError):
        margins.gain_interval(*margins.loop_transfer(LAGS, gain(-9.0)))
    with pytest.raises(margins.UnstableLoopError):
        margins.peak_sensitivity(LAGS, gain(-9.0))


def test_phase_margin_of_an_integrator_is_ninety_degrees():
    found = margins.phase_margin(np.array([2.0]), np.array([1.0, 0.0]))
    assert (found.degrees, found.frequency) == (pytest.approx(90.0), pytest.approx(2.0))


def test_phase_margin_takes_the_closest_of_several_crossings():
    """A lightly damped resonance crosses unit gain three times."""
    num, den = np.array([0.2]), np.polymul([1.0, 0.0], [1.0, 0.02, 1.0])
    num = np.polymul(num, [0.3, 1.0])
    found = margins.phase_margin(num, den)
    w = np.geomspace(0.01, 10, 400_001)
    L = np.polyval(num, 1j * w) / np.polyval(den, 1j * w)
    changes = np.flatnonzero(np.diff(np.sign(np.abs(L) - 1)))
    assert len(found.crossings) == changes.size == 3
    sweep = min(abs(np.angle(-L[k], deg=True)) for k in changes)
    assert found.degrees == pytest.approx(sweep, abs=0.1)  # the sweep steps over the resonance in 0.05 degrees


def test_phase_margin_without_crossing_is_infinite():
    assert margins.phase_margin(np.array([0.5]), np.array([1.0, 1.0])).degrees == math.inf


@pytest.mark.parametrize("value", [-0.5, -2.0, -7.0])
def test_sensitivity_peak_is_confirmed_by_the_hamiltonian_and_by_slycot(value):
    control = pytest.importorskip("control")
    found = margins.peak_sensitivity(LAGS, gain(value))
    assert found.hamiltonian == pytest.approx(found.value, rel=1e-7)
    reference, _ = control.linfnorm(control.ss(*input_sensitivity(LAGS, gain(value))), tol=1e-9)
    assert found.value == pytest.approx(reference, rel=1e-7)


def test_sensitivity_peak_at_zero_frequency():
    """Positive feedback of one lag: S = (s + 1) / (s + 1/2) is largest at 0."""
    found = margins.peak_sensitivity(state_space([[-1.0]], [1.0], [1.0]), gain(0.5))
    assert (found.value, found.frequency) == (pytest.approx(2.0), pytest.approx(0.0, abs=1e-6))


def test_sensitivity_peak_of_one_is_at_infinity():
    found = margins.peak_sensitivity(state_space([[-1.0]], [1.0], [1.0]), gain(-3.0))
    assert found.value == pytest.approx(1.0)


def test_squared_magnitude():
    p = np.array([2.0, -1.0, 3.0, 0.5])
    w = np.array([0.0, 0.7, 2.0])
    expected = np.abs(np.polyval(p, 1j * w)) ** 2
    np.testing.assert_allclose(np.polynomial.polynomial.polyval(w**2, margins.squared_magnitude(p)), expected)


def test_loop_transfer_sign():
    num, den = margins.loop_transfer(LAGS, gain(-2.0))
    p = frequency_response(LAGS, [0.3])[0, 0, 0]
    assert np.polyval(num, 0.3j) / np.polyval(den, 0.3j) == pytest.approx(2 * p)
