"""Systems that paper folders name for `recontrol.load`, on a finished run of all papers."""

from __future__ import annotations

import os
from pathlib import Path

import control
import numpy as np
import pytest

import recontrol
from recontrol.paper import discover

BUILT = os.environ.get("RECONTROL_BUILT", "")
pytestmark = pytest.mark.skipif(not BUILT, reason="RECONTROL_BUILT names no finished run (tools/test.sh makes one)")
ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("key", discover(ROOT))
def test_the_published_controller_stabilises_the_plant(key: str) -> None:
    """A controller carries its own sign: u = controller(y)."""
    results = recontrol.load(key, BUILT)
    loop = control.feedback(results.plant, results.controller, sign=1)
    assert loop.poles().real.max() < 0


def test_the_loop_of_li2013_has_the_poles_of_its_model() -> None:
    results = recontrol.load("li2013", BUILT)
    loop = control.feedback(results.plant, results.controller, sign=1)
    expected = results.model["orbits"]["w-print"]["poles"]
    np.testing.assert_allclose(np.sort_complex(loop.poles()), expected, atol=1e-7)
    assert results.controller.nstates == 0


@pytest.mark.parametrize("name", ["controller", "ref39"])
def test_the_controllers_of_li2021_stabilise_the_rigid_plant(name: str) -> None:
    systems = recontrol.load("li2021", BUILT).systems
    assert control.feedback(systems["plant"], systems[name], sign=1).poles().real.max() < 0


def test_the_flexible_plant_of_li2021_is_the_rigid_one_for_fast_torques() -> None:
    """The rigid inertia is J0 - F'F: what a torque far above the modes (0.76 rad/s) moves."""
    systems = recontrol.load("li2021", BUILT).systems
    rigid, flexible = (systems[name](1e3j) for name in ("plant", "flexible"))
    # Springs count with (0.76 / 1000)^2, dampers with 2 * 0.064 * 0.76 / 1000 of what the modes carry.
    np.testing.assert_allclose(flexible, rigid, rtol=0, atol=1e-4 * np.abs(rigid).max())
