"""Vertex sweeps and thresholds."""

import itertools

import numpy as np
import pytest

from recontrol.systems import vertices


def test_sign_vertices_are_all_of_them_once():
    found = vertices.sign_vertices(5)
    assert {tuple(v) for v in found} == set(itertools.product((-1.0, 1.0), repeat=5))
    assert len(found) == 32
    with pytest.raises(ValueError, match="1 to 24"):
        vertices.sign_vertices(25)


def test_worst_finds_the_vertex_of_a_linear_measure_across_chunks():
    weights = np.array([3.0, -2.0, 1.0, -0.5])
    best = vertices.worst(lambda v: v @ weights, vertices.sign_vertices(4), chunk=3)
    assert best.value == pytest.approx(np.abs(weights).sum())
    assert np.array_equal(best.at, np.sign(weights))


def test_abscissa_of_a_batch():
    stack = np.stack([np.diag([-1.0, -3.0]), np.array([[0.0, 1.0], [-4.0, 0.2]])])
    assert vertices.abscissa(stack) == pytest.approx([-1.0, 0.1])


def test_threshold_brackets_the_change():
    low, high = vertices.threshold(lambda x: x > 0.3, 0.0, 1.0, 1e-4)
    assert low <= 0.3 < high
    assert high - low <= 1e-4
    with pytest.raises(ValueError, match="found none"):
        vertices.threshold(lambda x: False, 0.0, 1.0, 1e-4)
