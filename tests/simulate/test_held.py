"""Held simulation: matrix exponential against an integrator, exosystem against closed form, settling by hand."""

import numpy as np
import pytest

from recontrol.simulate import sampled

A = np.array([[0.0, 1.0], [-0.2, 0.1]])
B = np.array([[0.0], [1.0]])
K = np.array([[-1.0, -1.5]])


def test_linear_run_agrees_with_the_restarted_integrator():
    intervals = [0.3, 0.5, 0.2, 0.5]
    exact = sampled.held_linear(A, B, K, [1.0, -2.0], intervals, samples=5)
    integrated = sampled.held_nonlinear(
        lambda t, x, u: A @ x + B @ u, lambda t, x: K @ x, [1.0, -2.0], intervals, samples=5
    )
    # DOP853 at rtol 1e-12 over 1.5 time units
    assert exact.state == pytest.approx(integrated.state, abs=1e-10)
    assert exact.time == pytest.approx(integrated.time)
    assert exact.control == pytest.approx(integrated.control, abs=1e-10)


def test_times_contain_the_instants():
    run = sampled.held_linear(A, B, K, [1.0, 0.0], [0.3, 0.5], samples=4)
    assert run.instants == pytest.approx([0.0, 0.3])
    assert run.time[::4] == pytest.approx([0.0, 0.3, 0.8])
    at_instants = run.state[:: run.samples]
    assert at_instants.shape == (3, 2)
    assert run.control == pytest.approx(at_instants[:-1] @ K.T)


def test_exosystem_drives_with_sine_and_constant():
    # x' = 3 sin 2t + 4, no control: x = 1.5 (1 - cos 2t) + 4 t
    S = np.zeros((3, 3))
    S[:2, :2] = sampled.oscillator(2.0)
    F = sampled.with_exosystem(np.zeros((1, 1)), np.array([[3.0, 0.0, 4.0]]), S)
    run = sampled.held_linear(F, np.zeros((4, 1)), np.zeros((1, 4)), [0.0, 0.0, 1.0, 1.0], sampled.periodic(0.5, 5))
    expected = 1.5 * (1 - np.cos(2 * run.time)) + 4 * run.time
    assert run.state[:, 0] == pytest.approx(expected, abs=1e-12)


def test_periodic_refuses_a_fraction_of_a_period():
    with pytest.raises(ValueError, match="multiple"):
        sampled.periodic(0.3, 1.0)


def test_integrator_failure_is_named():
    with pytest.raises(sampled.SampledSimulationError, match="DOP853 stopped"):
        sampled.held_nonlinear(lambda t, x, u: x**2, lambda t, x: np.zeros(1), [1.0], [2.0], rtol=1e-6, atol=1e-9)


def test_last_outside():
    time, error = np.arange(5.0), np.array([3.0, 0.1, -1.0, 0.2, 0.1])
    assert sampled.last_outside(time, error, 0.5) == 3.0
    assert sampled.last_outside(time, error, 5.0) == 0.0
    assert sampled.last_outside(time, error, 0.01) is None
