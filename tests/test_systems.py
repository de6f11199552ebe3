"""Systems that paper folders name for `recontrol.load`, on a finished run of all papers."""

from __future__ import annotations

import os
from pathlib import Path

import control
import pytest

import recontrol
from recontrol.paper import discover

BUILT = os.environ.get("RECONTROL_BUILT", "")
pytestmark = pytest.mark.skipif(not BUILT, reason="RECONTROL_BUILT names no finished run (tools/test.sh makes one)")
ROOT = Path(__file__).parents[1]
KEYS = [key for key in discover(ROOT) if (ROOT / "papers" / key / "systems.py").is_file()]


@pytest.mark.parametrize("key", KEYS)
def test_the_published_controller_stabilises_the_plant(key: str) -> None:
    """A controller carries its own sign: u = controller(y)."""
    results = recontrol.load(key, BUILT)
    loop = control.feedback(results.plant, results.controller, sign=1)
    assert loop.poles().real.max() < 0
