"""Exact stepping against closed forms and against integrators."""

import numpy as np
import pytest
from scipy.linalg import expm

from recontrol.simulate import linear, ode
from recontrol.systems.statespace import ShapeError, state_space

LAG = state_space([[-0.5]], [1.0], [2.0], 0.25)  # y = 4 (1 - exp(-t/2)) + 1/4
RNG = np.random.default_rng(3)
FOUR = state_space(RNG.normal(size=(4, 4)) - 2.5 * np.eye(4), RNG.normal(size=4), RNG.normal(size=4))


def test_first_order_lag_follows_its_closed_form():
    response = linear.step_response(LAG, 7.0, 1000)
    expected = 4 * (1 - np.exp(-response.times / 2)) + 0.25
    np.testing.assert_allclose(response.outputs, expected, rtol=0, atol=1e-13)  # ten doublings, a few ulp each


@pytest.mark.parametrize("samples", [1, 2, 3, 64, 65])
def test_propagate_matches_the_exponential_at_every_sample(samples):
    found = linear.propagate(FOUR.A, np.eye(4), 0.3, samples)
    assert found.shape == (samples, 4, 4)
    for k in range(samples):
        np.testing.assert_allclose(found[k], expm(FOUR.A * 0.3 * k), rtol=0, atol=1e-13)


def test_batch_is_the_same_as_one_by_one():
    start = RNG.normal(size=(4, 5))
    batch = linear.propagate(FOUR.A, start, 0.1, 30)
    for k in range(5):
        np.testing.assert_allclose(batch[:, :, k], linear.propagate(FOUR.A, start[:, k], 0.1, 30), atol=1e-14)


@pytest.mark.parametrize(
    ("method", "rtol", "atol", "bound"), [("DOP853", 1e-11, 1e-13, 1e-9), ("RK45", 1e-6, 1e-9, 1e-5)]
)
def test_step_response_agrees_with_integration(method, rtol, atol, bound):
    response = linear.step_response(FOUR, 12.0, 301)
    other = ode.step_outputs(FOUR, response.times, method=method, rtol=rtol, atol=atol)[:, 0]
    np.testing.assert_allclose(response.outputs, other, rtol=0, atol=bound)  # the integrator's error, 10 to 100 rtol


def test_output_and_slope_between_samples():
    response = linear.step_response(LAG, 7.0, 15)
    for time in (0.0, 0.3, 3.75, 7.0):
        assert response.at(time) == pytest.approx(4 * (1 - np.exp(-time / 2)) + 0.25, abs=1e-13)
        assert response.slope(time) == pytest.approx(2 * np.exp(-time / 2), abs=1e-13)
    with pytest.raises(ValueError, match="outside the horizon"):
        response.at(7.1)


def test_final_value_is_where_the_response_ends():
    response = linear.step_response(FOUR, 60.0, 11)
    assert response.outputs[-1] == pytest.approx(linear.final_value(FOUR), abs=1e-12)


def test_shapes_are_checked_by_name():
    with pytest.raises(ShapeError, match="x0 has 3 rows, expected 4"):
        linear.propagate(FOUR.A, np.zeros(3), 0.1, 5)
    with pytest.raises(ShapeError, match="one input"):
        linear.step_response(state_space(np.eye(2), np.eye(2), np.eye(2)), 1.0, 5)


def test_integration_that_stops_early_is_an_error():
    with pytest.raises(ode.IntegrationError, match="DOP853 stopped at t"):
        ode.integrate(lambda t, x: x**2, [1.0], [0.0, 2.0])  # blows up at t = 1
