"""Flexible attitude dynamics: residuals of the equations of motion, linearisation, elimination of the modes."""

import numpy as np
import pytest

from recontrol.exact.rational import matrix, to_float, zeros
from recontrol.spacecraft import attitude
from recontrol.spacecraft.flexible import FlexibleAttitude, LinearFlexibleAttitude, linear_model, rigid_part

INERTIA = np.array([25.0, 24.0, 20.0])
COUPLING = np.array([[-0.5, -0.6, 0.1], [0.5, 0.5, 2.0]])
FREQUENCY, DAMPING = np.array([0.7, 0.8]), np.array([0.004, 0.06])
RATE = 0.01  # larger than in orbit, so that its terms are visible beside rounding


def columns(v, runs=1):
    return np.repeat(np.asarray(v)[:, None], runs, axis=1)


def model(kind, runs=1):
    return kind(columns(INERTIA, runs), COUPLING, columns(FREQUENCY, runs), columns(DAMPING, runs), RATE)


def test_derivative_satisfies_the_equations_of_motion():
    rng = np.random.default_rng(3)
    x, torque = rng.standard_normal((10, 5)), rng.standard_normal((3, 5))
    dx = model(FlexibleAttitude, 5).derivative(x, torque)
    for k in range(5):
        q, w, eta, etad = x[:3, k], x[3:6, k], x[6:8, k], x[8:, k]
        gravity = attitude.gravity_gradient(INERTIA, q, RATE)
        body = INERTIA * dx[3:6, k] + COUPLING.T @ dx[8:, k] + np.cross(w, INERTIA * w) - gravity - torque[:, k]
        modes = dx[8:, k] + 2 * DAMPING * FREQUENCY * etad + FREQUENCY**2 * eta + COUPLING @ dx[3:6, k]
        assert np.abs(body).max() < 1e-12 * 100  # a hundred roundings of numbers of order one
        assert np.abs(modes).max() < 1e-12
        assert np.allclose(dx[:3, k], attitude.angle_rates(q, w, RATE), rtol=1e-12, atol=1e-13)


def test_linear_model_is_the_jacobian_of_the_nonlinear_one():
    flexible, linear = model(FlexibleAttitude), model(LinearFlexibleAttitude)

    def acceleration(v):  # angles, angle rates, modes -> q'' and eta''
        x = np.concatenate([flexible.initial(v[:3, None], v[3:6, None])[:6, 0], v[6:]])
        h = 1e-6
        ahead = flexible.angle_rates((x + h * flexible.derivative(x[:, None], np.zeros((3, 1)))[:, 0])[:, None])
        behind = flexible.angle_rates((x - h * flexible.derivative(x[:, None], np.zeros((3, 1)))[:, 0])[:, None])
        return np.concatenate(
            [(ahead - behind)[:, 0] / (2 * h), flexible.derivative(x[:, None], np.zeros((3, 1)))[8:, 0]]
        )

    step = 1e-4
    jacobian = np.stack([(acceleration(step * e) - acceleration(-step * e)) / (2 * step) for e in np.eye(10)], axis=1)
    A = linear._A[0]
    expected = np.vstack([A[3:6], A[8:]])
    # Two nested central differences: truncation 1e-8 relative, rounding 1e-16 / 1e-6 / 1e-4 = 1e-6.
    assert np.abs(jacobian - expected).max() < 1e-5


def test_rigid_part_is_the_model_with_resting_modes():
    J, F = matrix([["25", "24", "20"]]), matrix([["-1/2", "-3/5", "1/10"], ["1/2", "1/2", "2"]])
    rate = matrix("1/100")[0, 0]
    A, B, M = rigid_part(J, F, rate)
    full, inputs = linear_model(np.ravel(J), F, np.ravel(matrix("7/10 4/5")), np.ravel(zeros(1, 2)), rate)
    rows, states = [5, 6, 7], [0, 1, 2, 5, 6, 7]
    assert (full[np.ix_(rows, states)] == A[3:]).all()  # exact: the same rational elimination by another matrix
    assert (inputs[rows] == B[3:]).all()
    assert np.allclose(to_float(M), np.diag(INERTIA) - COUPLING.T @ COUPLING, atol=1e-15)


def test_energy_of_the_free_undamped_body_is_kept():
    body = FlexibleAttitude(columns(INERTIA), COUPLING, columns(FREQUENCY), columns([0.0, 0.0]), 0.0)
    x = np.array([0.1, -0.2, 0.3, 0.02, -0.01, 0.03, 0.1, -0.05, 0.02, 0.01])[:, None]
    mass = np.block([[np.diag(INERTIA), COUPLING.T], [COUPLING, np.eye(2)]])

    def energy(x):
        v = np.concatenate([x[3:6, 0], x[8:, 0]])
        return (v @ mass @ v + FREQUENCY**2 @ x[6:8, 0] ** 2) / 2

    from recontrol.simulate.rk4 import rk4

    _, path = rk4(lambda k, t, y: body.derivative(y, np.zeros((3, 1))), x, 0.01, 2000)
    # RK4 at 0.01 s on modes below 1 rad/s: relative error about 1e-10 over 20 s.
    assert energy(path[-1]) == pytest.approx(energy(x), rel=1e-8)
