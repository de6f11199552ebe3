"""Systems of `recontrol.load("hashim2015")`: loops closed by python-control against the separation principle."""

from __future__ import annotations

from pathlib import Path

import control
import numpy as np
import pytest

from papers.hashim2015.systems import systems
from recontrol import paper as papers
from recontrol.report.exports import plain

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def named() -> dict[str, control.StateSpace]:
    data = papers.load(ROOT / "papers" / "hashim2015").data
    found = systems(data, None, None)
    return {name: control.ss(*(np.atleast_2d(plain(M)).astype(float) for M in four)) for name, four in found.items()}


def ordered(poles: np.ndarray) -> np.ndarray:
    return np.sort_complex(np.round(poles, 9))


def test_full_order_loop_has_the_poles_of_controller_and_estimator(named) -> None:
    plant, controller = named["plant"], named["controller"]
    loop = control.feedback(plant, controller, sign=1)
    K, L = -controller.C, controller.B
    separate = [np.linalg.eigvals(plant.A - plant.B @ K), np.linalg.eigvals(plant.A - L @ plant.C)]
    np.testing.assert_allclose(ordered(loop.poles()), ordered(np.concatenate(separate)), atol=1e-7)
    assert loop.poles().real.max() < -0.1


def test_reduced_loop_is_stable_with_the_first_state_and_not_with_the_output(named) -> None:
    plant, reduced = named["plant"], named["reduced"]
    first_state = control.ss(plant.A, plant.B, np.eye(4)[:1], 0)
    assert control.feedback(first_state, reduced, sign=1).poles().real.max() < 0
    assert control.feedback(plant, reduced, sign=1).poles().real.max() > 0
