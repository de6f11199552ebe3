"""Rigid attitude on a circular orbit: kinematic identities, a conserved quantity, linearisation by differences."""

import math

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from recontrol.spacecraft import attitude

INERTIA = (20.0, 15.0, 12.0)
RATE = 1.16e-3
ANGLES = (0.3, -0.4, 0.7)
ANGLE_RATES = (0.02, -0.03, 0.05)


def test_direction_cosines_are_a_rotation() -> None:
    dcm = np.array(attitude.lvlh_to_body(ANGLES))
    # A product of at most three trigonometric terms: a few units of rounding.
    assert dcm @ dcm.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(dcm) == pytest.approx(1.0, abs=1e-15)


def test_body_rate_is_the_rate_of_the_direction_cosines() -> None:
    # C' = -[w x] C for a frame rotation; w relative to the LVLH frame (orbital rate 0).
    step = 1e-6
    forward = np.array(attitude.lvlh_to_body([a + step * r for a, r in zip(ANGLES, ANGLE_RATES, strict=True)]))
    backward = np.array(attitude.lvlh_to_body([a - step * r for a, r in zip(ANGLES, ANGLE_RATES, strict=True)]))
    skew = -((forward - backward) / (2 * step)) @ np.array(attitude.lvlh_to_body(ANGLES)).T
    # Central difference: truncation ~ step^2 |w|^3, rounding ~ 1e-16/step.
    assert [skew[2, 1], skew[0, 2], skew[1, 0]] == pytest.approx(attitude.body_rate(ANGLES, ANGLE_RATES, 0.0), abs=1e-9)


def test_angle_rates_invert_body_rate() -> None:
    rate = attitude.body_rate(ANGLES, ANGLE_RATES, RATE)
    assert attitude.angle_rates(ANGLES, rate, RATE) == pytest.approx(ANGLE_RATES, abs=1e-15)


def test_euler_torque_and_acceleration_are_inverse() -> None:
    acceleration = attitude.euler_acceleration(INERTIA, ANGLE_RATES, (0.1, 0.2, -0.3))
    assert attitude.euler_torque(INERTIA, ANGLE_RATES, acceleration) == pytest.approx((0.1, 0.2, -0.3), abs=1e-14)


def test_free_motion_conserves_the_orbital_energy() -> None:
    # Hamiltonian of a rigid body in the circular-orbit frame (Hughes, section 9.1): with w_rel relative to LVLH,
    # H = w_rel'J w_rel/2 + 3/2 w0^2 c3'J c3 - w0^2/2 c2'J c2 is constant without torque.
    rhs = attitude.rigid_attitude(INERTIA, RATE)

    def energy(state: np.ndarray) -> float:
        dcm = np.array(attitude.lvlh_to_body(state[:3]))
        relative = state[3:] + RATE * dcm[:, 1]
        inertia = np.diag(INERTIA)
        c2, c3 = dcm[:, 1], dcm[:, 2]
        return float(
            relative @ inertia @ relative / 2 + 1.5 * RATE**2 * c3 @ inertia @ c3 - RATE**2 / 2 * c2 @ inertia @ c2
        )

    start = np.array([*ANGLES, *attitude.body_rate(ANGLES, [1e-4, -2e-4, 1.5e-4], RATE)])
    run = solve_ivp(lambda _, x: rhs(x, (0.0, 0.0, 0.0)), (0, 1500), start, method="DOP853", rtol=1e-12, atol=1e-14)
    assert abs(run.y[1]).max() < 1.4, "the run must stay away from the singularity to mean anything"
    energies = [energy(x) for x in run.y.T]
    # Integrator tolerance 1e-12 relative over some hundred steps.
    assert energies == pytest.approx([energies[0]] * len(energies), rel=1e-9)


def test_state_matrix_is_the_jacobian_of_the_nonlinear_model() -> None:
    symbols = attitude.lvlh_symbols()
    values = dict(zip(symbols["inertia"], INERTIA, strict=True)) | {symbols["orbital_rate"]: RATE}
    matrix = np.array(attitude.lvlh_state_matrix().subs(values), dtype=float)
    rhs = attitude.rigid_attitude(INERTIA, RATE)

    def derivative(x: np.ndarray) -> np.ndarray:
        # d/dt of (angles, angle rates): the second half by a difference along the motion.
        def rates_at(state: np.ndarray) -> np.ndarray:
            return np.array(attitude.angle_rates(state[:3], state[3:], RATE))

        state = np.array([*x[:3], *attitude.body_rate(x[:3], x[3:], RATE)])
        flow, step = np.array(rhs(state, (0.0, 0.0, 0.0))), 1e-3
        second = (rates_at(state + step * flow) - rates_at(state - step * flow)) / (2 * step)
        return np.concatenate([x[3:], second])

    step = 1e-4
    columns = [(derivative(step * e) - derivative(-step * e)) / (2 * step) for e in np.eye(6)]
    # The smallest entry is 1e-7; truncation is step^2 times rates of 1e-6, rounding 1e-16/1e-3/1e-4 * 1e-3.
    assert np.abs(np.array(columns).T - matrix).max() < 2e-11


def test_gravity_gradient_of_pitch_restores_for_a_vertical_long_axis() -> None:
    symbols = attitude.lvlh_symbols()
    ix, _, iz = symbols["inertia"]
    torque = attitude.linearised_gravity_gradient()
    assert sp.simplify(torque[1] + 3 * symbols["orbital_rate"] ** 2 * (ix - iz) * symbols["angles"][1]) == 0
    assert torque[2] == 0
    exact = attitude.gravity_gradient(INERTIA, (0.0, 0.2, 0.0), RATE)
    # Closed form in the orbit plane: -3/2 w0^2 (Ix - Iz) sin(2 pitch).
    assert exact[1] == pytest.approx(-1.5 * RATE**2 * 8.0 * math.sin(0.4), rel=1e-14)
