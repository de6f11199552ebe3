"""Analytic centres with closed forms."""

import numpy as np
import pytest

from recontrol.lmi.centre import analytic_centre


def test_centre_of_an_interval_is_its_middle():
    constants = [np.array([[-1.0]]), np.array([[5.0]])]
    coefficients = [np.array([[[1.0]]]), np.array([[[-1.0]]])]
    found = analytic_centre(constants, coefficients, np.array([1.1]))
    assert found.x[0] == pytest.approx(3.0, abs=1e-12)
    assert found.decrement < 1e-16


def test_centre_of_the_correlation_matrices_is_the_identity():
    places = [(0, 1), (0, 2), (1, 2)]
    units = np.zeros((3, 3, 3))
    for k, (i, j) in enumerate(places):
        units[k, i, j] = units[k, j, i] = 1.0
    found = analytic_centre([np.eye(3)], [units], np.array([0.5, -0.3, 0.2]))
    assert np.abs(found.x).max() < 1e-8  # half the digits of the squared decrement


def test_weighted_centre_of_a_triangle():
    # x, y > 0 and x + y < 1 with log x + log y + log(1 - x - y): the centroid.
    constants = [np.zeros((1, 1)), np.zeros((1, 1)), np.ones((1, 1))]
    coefficients = [np.array([[[1.0]], [[0.0]]]), np.array([[[0.0]], [[1.0]]]), np.array([[[-1.0]], [[-1.0]]])]
    found = analytic_centre(constants, coefficients, np.array([0.9, 0.05]))
    assert found.x == pytest.approx([1 / 3, 1 / 3], abs=1e-9)


def test_an_infeasible_start_is_refused():
    with pytest.raises(ValueError, match="not strictly feasible"):
        analytic_centre([np.array([[-1.0]])], [np.array([[[1.0]]])], np.array([0.5]))


def test_an_unbounded_set_has_no_centre():
    with pytest.raises(ValueError, match="no centre"):
        analytic_centre([np.array([[0.0]])], [np.array([[[1.0]]])], np.array([1.0]), limit=30)
