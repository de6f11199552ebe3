"""Figure regression: what counts as a drift."""

import numpy as np
import pytest

from recontrol.pipeline import regression


def drift(found, reference):
    (only,) = regression.compare({"c": found}, {"c": reference}, 1e-4)
    return only


@pytest.mark.parametrize("change", [1e-11, -1e-11])
def test_a_single_point_is_measured_by_its_magnitude(change):
    """A settling mark moves with the last bits of a root: no drift. A thousandth is one."""
    point = (np.array([37.4]), np.array([-0.257]))
    assert drift((point[0] * (1 + change), point[1]), point).agrees
    assert not drift((point[0] * 1.001, point[1]), point).agrees


def test_a_constant_curve_may_carry_rounding():
    x = np.linspace(0, 1, 50)
    flat = np.full(50, 2.0)
    assert drift((x, flat + 1e-14 * np.cos(9 * x)), (x, flat)).agrees
    assert not drift((x, flat + 1e-3), (x, flat)).agrees


def test_points_in_another_order_agree():
    x, y = np.array([0.0, 1.0, 3.0]), np.array([1.0, 2.0, 0.0])
    assert drift((x[::-1], y[::-1]), (x, y)).agrees


def test_a_looser_curve_leaves_the_others_as_tight_as_they_were():
    x, y = np.linspace(0, 1, 5), np.array([0.0, 1.0, 0.0, 1.0, 0.0])
    reference = {"held": (x, y), "free": (x, y)}
    found = {"held": (x, y + 0.3), "free": (x, y + 0.3)}
    agrees = {d.curve: d.agrees for d in regression.compare(found, reference, 1e-2, {"free": 0.9})}
    assert agrees == {"held": False, "free": True}


def test_a_tolerance_for_a_curve_that_is_not_drawn_is_a_difference():
    x, y = np.linspace(0, 1, 5), np.zeros(5)
    drifts = regression.compare({"c": (x, y)}, {"c": (x, y)}, 1e-2, {"gone": 0.9})
    assert [(d.curve, d.agrees) for d in drifts] == [("c", True), ("gone", False)]
