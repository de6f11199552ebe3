"""Relative motion against two inertial Kepler orbits, and the models against each other in their limits."""

import numpy as np
import pytest
import sympy
from flint import fmpq
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from recontrol.spacecraft import orbit

GM = 3.986004418e14  # m^3/s^2
START = np.array([3000.0, -4000.0, 20.0, -3.0, 4.0, -0.02])


def drift(target, start, time, anomaly=0.0):
    """Integrate the exact equations in the rotating frame together with the target's own radius and angle."""

    def rhs(_, s):
        radius, radial_rate, rate = s[6], s[7], target.angular_momentum / s[6] ** 2
        free = orbit.relative_acceleration(s[:3], s[3:6], radius, radial_rate, rate, target.gm)
        return np.concatenate([s[3:6], free, [radial_rate, radius * rate**2 - target.gm / radius**2, rate]])

    radius, radial_rate, _ = target.radial_state(anomaly)
    full = np.concatenate([start, [radius, radial_rate, anomaly]])
    return solve_ivp(rhs, (0, time), full, method="DOP853", rtol=1e-12, atol=1e-9).y[:, -1]


@pytest.mark.parametrize("eccentricity", [0.0, 0.01, 0.3])
@pytest.mark.parametrize("anomaly", [0.0, 2.0])
def test_rotating_equations_match_two_inertial_kepler_orbits(eccentricity, anomaly):
    target = orbit.KeplerOrbit(GM, 6728140.0, eccentricity)
    end = drift(target, START, 3000.0, anomaly)
    position, velocity = orbit.to_inertial(target, anomaly, START)
    position, velocity = orbit.propagate_kepler(GM, position, velocity, 3000.0)
    expected = orbit.to_rotating(target, end[8], position, velocity)
    # 7e6 m in double precision is known to 1e-9 m; the integrator adds about 1e-6 m over 3000 s.
    assert np.allclose(end[:3], expected[:3], rtol=0, atol=2e-5)
    assert np.allclose(end[3:6], expected[3:], rtol=0, atol=1e-7)


def test_true_anomaly_agrees_with_the_integrated_angle():
    target = orbit.KeplerOrbit(GM, 6728140.0, 0.3)
    end = drift(target, START, 9000.0)
    # The angle turns about once; 1e-10 rad is the accuracy of the integration.
    assert end[8] == pytest.approx(float(target.true_anomaly(9000.0)), abs=1e-10)
    assert end[6] == pytest.approx(target.radial_state(end[8])[0], rel=1e-12)


def test_frame_change_is_its_own_inverse():
    target = orbit.KeplerOrbit(GM, 6728140.0, 0.1)
    back = orbit.to_rotating(target, 1.2, *orbit.to_inertial(target, 1.2, START))
    assert np.allclose(back, START, rtol=0, atol=1e-8)


def test_propagation_keeps_energy_and_momentum():
    position, velocity = orbit.KeplerOrbit(GM, 6728140.0, 0.2).inertial_state(0.7)
    later, speed = orbit.propagate_kepler(GM, position, velocity, 4321.0)
    energy = [v @ v / 2 - GM / np.linalg.norm(p) for p, v in ((position, velocity), (later, speed))]
    assert energy[1] == pytest.approx(energy[0], rel=1e-13)
    assert np.allclose(np.cross(later, speed), np.cross(position, velocity), rtol=1e-13)


def test_small_circular_motion_follows_clohessy_wiltshire():
    target = orbit.KeplerOrbit(GM, 7e6, 0.0)
    transition = expm(orbit.clohessy_wiltshire(target.mean_motion) * 2000.0)
    errors = [
        np.linalg.norm(drift(target, scale * START, 2000.0)[:3] / scale - (transition @ START)[:3])
        for scale in (1e-2, 1e-3)
    ]
    # The neglected terms are quadratic in the distance: ten times smaller start, ten times smaller relative error.
    assert errors[1] == pytest.approx(errors[0] / 10, rel=0.05)


def test_near_circular_model_is_first_order_in_the_eccentricity():
    n, e = 1.1e-3, 1e-4
    a = (GM / n**2) ** (1 / 3)
    errors = []
    for small in (e, e / 10):
        target = orbit.KeplerOrbit(GM, a * (1 - small), small)
        for mean in (0.0, 1.0, 2.5):
            exact = orbit.linear_relative(target, float(target.true_anomaly(mean / n)))
            model = orbit.clohessy_wiltshire(n) + orbit.near_circular(n, small, np.cos(mean), np.sin(mean))
            errors.append(np.abs((exact - model)[3:] / np.array([n**2] * 3 + [n] * 3)).max())
    first, second = max(errors[:3]), max(errors[3:])
    assert second < first / 80  # quadratic remainder: a factor of 100


def test_linearisation_is_the_derivative_of_the_exact_equations():
    target = orbit.KeplerOrbit(GM, 6728140.0, 0.2)
    radial = target.radial_state(0.9)

    def free(state):
        return np.array(orbit.relative_acceleration(state[:3], state[3:], *radial, GM))

    step = np.diag([10.0] * 3 + [1e-2] * 3)
    numeric = np.column_stack([(free(s) - free(-s)) / (2 * s.sum()) for s in step])
    # Central differences of 10 m against 7000 km: remainder about 1e-11 of gm/r^3 = 1e-6, rounding 1e-16.
    assert np.allclose(numeric, orbit.linear_relative(target, 0.9)[3:], rtol=0, atol=1e-13)


def test_matrices_keep_the_type_of_their_entries():
    exact = orbit.clohessy_wiltshire(fmpq(113, 100000))
    assert exact.dtype == object
    assert exact[3, 0] == 3 * fmpq(113, 100000) ** 2
    n, e, c, s = sympy.symbols("n e c s")
    assert orbit.near_circular(n, e, c, s)[3, 4] == 4 * e * n * c
    assert orbit.thrust_input(fmpq(200))[4, 1] == fmpq(1, 200)
    assert orbit.thrust_input(200.0).dtype == float


@pytest.mark.parametrize("bad", [(-1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1.0)])
def test_impossible_orbits_are_refused(bad):
    with pytest.raises(orbit.OrbitError):
        orbit.KeplerOrbit(*bad)


def test_hyperbolic_propagation_is_refused():
    with pytest.raises(orbit.OrbitError, match="not elliptic"):
        orbit.propagate_kepler(GM, np.array([7e6, 0, 0]), np.array([0, 2e4, 0]), 10.0)
