"""Coprime radius against an H-infinity norm of the four closed-loop maps and against closed forms."""

import math

import numpy as np
import pytest

from recontrol.systems.coprime import best_coprime_radius, coprime_radius
from recontrol.systems.margins import UnstableLoopError
from recontrol.systems.statespace import StateSpace, loop_matrix, state_space

INTEGRATOR = state_space([[0.0]], [1.0], [1.0])
OSCILLATOR = state_space([[0.0, -1.0], [1.0, 0.0]], [1.0, 0.0], [0.0, 1.0])


def static(value):
    return state_space([[-5.0]], [0.0], [0.0], value)


def four_maps(plant, compensator):
    """Realisation of [1; K] (1 - P K)^-1 [1, P], whose norm is 1 / b: from noise at y and at u to (y, u)."""
    _, B, C, _ = plant
    _, Bk, Ck, Dk = compensator
    n = Bk.shape[0]
    inputs = np.block([[B @ Dk, B], [Bk, np.zeros((n, 1))]])
    outputs = np.block([[C, np.zeros((1, n))], [Dk @ C, Ck]])
    return StateSpace(loop_matrix(plant, compensator), inputs, outputs, np.array([[1.0, 0.0], [Dk[0, 0], 0.0]]))


def test_integrator_with_unit_feedback():
    """1 + 1/s against sqrt(2) sqrt(1 + 1/w^2): the ratio is 1/sqrt(2) at every frequency, and that is the best."""
    assert coprime_radius(INTEGRATOR, static(-1.0)).value == pytest.approx(1 / math.sqrt(2), rel=1e-12)
    assert best_coprime_radius(INTEGRATOR) == pytest.approx(1 / math.sqrt(2), rel=1e-12)


@pytest.mark.parametrize(
    "compensator",
    [
        state_space([[-2.0]], [1.0], [1.5], -1.0),  # lead: poles of the plant lie on the axis
        state_space([[-3.0, -4.0], [1.0, 0.0]], [1.0, 0.0], [-2.0, -1.0], 0.0),
    ],
)
def test_radius_is_the_inverse_norm_of_the_closed_loop(compensator):
    control = pytest.importorskip("control")
    found = coprime_radius(OSCILLATOR, compensator)
    norm, _ = control.linfnorm(control.ss(*four_maps(OSCILLATOR, compensator)), tol=1e-10)
    assert found.value == pytest.approx(1 / norm, rel=1e-7)
    assert found.value <= best_coprime_radius(OSCILLATOR) * (1 + 1e-9)


def test_large_direct_term_is_worst_at_infinity():
    found = coprime_radius(INTEGRATOR, static(-30.0))
    assert found.value == pytest.approx(1 / math.hypot(1, 30), rel=1e-6)


def test_unstable_loop_has_no_radius():
    with pytest.raises(UnstableLoopError):
        coprime_radius(INTEGRATOR, static(1.0))
