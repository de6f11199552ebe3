"""Fixed-step integration against the matrix exponential."""

import numpy as np
import pytest
from scipy.linalg import expm

from recontrol.simulate.rk4 import rk4

A = np.array([[0.0, 1.0], [-2.0, -0.3]])
X0 = np.array([[1.0, 0.0], [0.0, 1.0]])  # two runs: the columns of the transition matrix


def final(step):
    return rk4(lambda k, t, x: A @ x, X0, step, round(2 / step))[1][-1]


def test_runs_reach_the_transition_matrix_with_fourth_order():
    errors = [np.abs(final(h) - expm(2 * A)).max() for h in (0.1, 0.05)]
    assert errors[0] < 2e-5
    assert errors[0] / errors[1] == pytest.approx(16, rel=0.15)  # halving the step of a fourth-order scheme


def test_samples_and_observations():
    t, y = rk4(lambda k, t, x: A @ x, X0, 0.1, 20, every=5, observe=lambda k, t, x: x[:1] + k)
    assert np.allclose(t, [0, 0.5, 1, 1.5, 2])
    assert y.shape == (5, 1, 2)
    assert np.allclose(y[-1] - 20, final(0.1)[:1])


def test_a_diverging_run_does_not_disturb_the_others():
    _, y = rk4(lambda k, t, x: np.array([[-1.0, 1e3]]) * x**3, np.array([[1.0, 1.0]]), 0.1, 50)
    assert not np.isfinite(y[-1, 0, 1])
    assert y[-1, 0, 0] == pytest.approx(1 / np.sqrt(1 + 2 * 5.0), rel=1e-4)  # solution of x' = -x^3 at t = 5


def test_every_must_divide_the_steps():
    with pytest.raises(ValueError, match="divisible"):
        rk4(lambda k, t, x: x, X0, 0.1, 10, every=3)
