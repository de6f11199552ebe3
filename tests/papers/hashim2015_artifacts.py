"""The artifacts of hashim2015 that its tests share, computed once a session."""

from __future__ import annotations

import functools
import inspect
from typing import Any

from papers.hashim2015 import model
from papers.hashim2015.quantities import experiments
from papers.hashim2015.synthesis.gains import gains
from recontrol import paper
from recontrol.pipeline import inputs
from tests.conftest import ROOT

DATA = paper.load(ROOT / "papers/hashim2015").data
MODEL = model.model(DATA)
SYNTHESIS = {"gains": gains(MODEL, DATA)}


def call(function: Any, **more: Any) -> Any:
    """Call a stage function with what its parameters name, as the runner does."""
    available = {"data": DATA, "model": MODEL, "synthesis": SYNTHESIS, **more}
    return function(**{name: available[name] for name in inspect.signature(function).parameters})


@functools.cache
def simulated() -> dict[str, Any]:
    """All parts of the simulation: name -> {values, series}."""
    parts = {}
    for name in experiments.PARTS:
        values, series = call(inputs.function_of("hashim2015", "simulation", name))
        parts[name] = {"values": values, "series": series}
    return parts
