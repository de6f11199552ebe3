"""Batched stepping against SciPy's exponential and an adaptive integrator."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from recontrol.campaign import steppers


@pytest.mark.parametrize("scale", [1e-6, 0.3, 20.0, 300.0])
def test_batched_exponential_agrees_with_scipy(scale):
    stack = np.random.default_rng(3).standard_normal((40, 6, 6)) - 3 * np.eye(6)
    stack *= scale / np.max(np.sum(np.abs(stack), axis=1))
    for found, a in zip(steppers.batched_expm(stack), stack, strict=True):
        truth = expm(a)
        # Scaling and squaring: rounding grows with the norm that is squared away.
        assert np.max(np.abs(found - truth)) <= 1e-14 * (1 + scale) * max(np.max(np.abs(truth)), 1.0)


def test_trajectories_agree_with_an_integrator():
    rng = np.random.default_rng(4)
    stack = rng.standard_normal((5, 3, 3)) - 2 * np.eye(3)
    x0 = rng.standard_normal((5, 3))
    transition = steppers.batched_expm(stack * 0.05)
    states = np.array(list(steppers.steps(transition, x0, 41)))
    for run in range(5):
        truth = solve_ivp(lambda t, x, a=stack[run]: a @ x, (0, 2), x0[run], t_eval=[2.0], rtol=1e-11, atol=1e-13)
        assert np.allclose(states[-1, run], truth.y[:, 0], atol=1e-9)


def test_peak_and_last_exit_of_known_curves():
    transition = np.exp(-0.1) * np.ones((2, 1, 1))
    x0 = np.array([[1.0], [2.0]])
    outcome = lambda x: np.abs(x[:, 0])  # noqa: E731
    assert steppers.peak(steppers.steps(transition, x0, 100), outcome).tolist() == [1.0, 2.0]
    last = steppers.last_outside(steppers.steps(transition, x0, 100), outcome, np.array([0.5, 0.5]), 0.1)
    # 1 leaves the band for good at t = ln 2, 2 at ln 4; samples are 0.1 apart.
    assert last == pytest.approx([0.7, 1.4])


@pytest.mark.parametrize("stack", [np.zeros((3, 3)), np.zeros((2, 3, 4)), np.full((1, 2, 2), np.nan)])
def test_unusable_stacks_are_refused(stack):
    with pytest.raises(ValueError, match="stack"):
        steppers.batched_expm(stack)
