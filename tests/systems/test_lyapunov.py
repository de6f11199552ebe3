"""Costs by Lyapunov equations: the equation itself, closed forms, and a sum over an exact response."""

import math

import numpy as np
import pytest

from recontrol.simulate import linear
from recontrol.systems import lyapunov
from recontrol.systems.stability import UnstableError
from recontrol.systems.statespace import state_space

RNG = np.random.default_rng(5)
A = RNG.normal(size=(4, 4)) - 3 * np.eye(4)
C = RNG.normal(size=(1, 4))


def test_gramian_satisfies_its_equation():
    W = lyapunov.observability_gramian(A, C)
    np.testing.assert_allclose(A.T @ W + W @ A + C.T @ C, 0, atol=1e-14)


def test_covariance_satisfies_its_equation():
    noise = np.diag([1.0, 2, 0, 3])
    X = lyapunov.covariance(A, noise)
    np.testing.assert_allclose(A @ X + X @ A.T + noise, 0, atol=1e-14)


def test_integral_square_matches_quadrature():
    start = RNG.normal(size=(4, 3))
    states = linear.propagate(A, start, 1e-3, 40_001)
    y = np.einsum("j,ijk->ik", C[0], states)
    expected = np.trapezoid(y**2, dx=1e-3, axis=0)
    np.testing.assert_allclose(lyapunov.integral_square(A, C, start), expected, rtol=1e-5)  # trapezoid: step squared


def test_single_state_is_not_a_batch():
    assert lyapunov.integral_square([[-0.5]], [[2.0]], [3.0]) == pytest.approx(36.0)  # 4 * 9 / (2 * 0.5)


def test_noise_cost_of_a_lag():
    assert lyapunov.noise_cost(state_space([[-2.0]], [3.0], [1.0])) == pytest.approx(9 / 4)
    assert lyapunov.noise_cost(state_space([[-2.0]], [3.0], [1.0], 1.0)) == math.inf


def test_unstable_systems_are_refused():
    with pytest.raises(UnstableError, match="spectral abscissa"):
        lyapunov.integral_square([[0.0]], [[1.0]], [1.0])
