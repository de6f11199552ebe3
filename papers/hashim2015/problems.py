"""Data of the certificates, straight from paper.yaml: the verifier calls `problem_data` again and compares."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact.rational import identity, zeros
from recontrol.lmi import loops

from . import analysis, recipe
from .loops import first_state, printed_gain_box, printed_reduced, reduced_loop
from .model import AXES, model, plants
from .synthesis.gains import gains

CONTROLLER_BOX = "box of (52)"
FULL_BOX = "boxes of (52) and (54)"
REDUCED_BOX = "box of (66)-(69), x1 measured"
FULL_LOOPS = "full-order loops, recomputed gains"
CORRECTED_LOOPS = "corrected reduced loops, recomputed gains"
STABLE_MEMBER = "ace-print, stable member"
UNSTABLE_MEMBER = "ace-print, unstable member"


def problem_data(data: Any, case: str) -> dict[str, np.ndarray]:
    """Exact data by name; ``case`` is an axis or one of the names above, anything else has none."""
    found = plants(data)
    yaw = recipe.Plant(**found["yaw"])
    if case == CONTROLLER_BOX:
        return {"K": printed_gain_box(data), "a": yaw.A[:1]}
    if case == FULL_BOX:
        K, L = printed_gain_box(data), data.ball("L")
        return {"M": np.block([[yaw.A - yaw.B @ K, yaw.B @ K], [zeros(yaw.n), yaw.A - L @ yaw.C]])}
    if case == REDUCED_BOX:
        return _reduced_box(yaw, data)
    if case in (FULL_LOOPS, CORRECTED_LOOPS):
        return _loops_of_axes(data, case)
    if case in (STABLE_MEMBER, UNSTABLE_MEMBER):
        return {"M": analysis.deciding_members(model(data), data)[case.removeprefix("ace-print, ")]}
    plant = found.get(case)
    if plant is None:
        return {}
    return {"A": plant["A"], "B": plant["B"], "Q": plant["C"].T @ plant["C"], "R": identity(1)}


def _reduced_box(plant: recipe.Plant, data: Any) -> dict[str, np.ndarray]:
    """Loop of (66)-(69) at the print, and E, F of the sixteen half units."""
    centre, half = printed_reduced(lambda name: data[name]), printed_reduced(data.half)
    shifted = {name: centre[name] + half[name] for name in centre}
    M, moved = (reduced_loop(plant, first_state(plant.n), **found) for found in (centre, shifted))
    E, F = loops.entry_box(moved - M)
    return {"M": M, "E": E, "F": F}


def _loops_of_axes(data: Any, case: str) -> dict[str, np.ndarray]:
    """``M <axis>`` with gains made again from the recipe, in balls."""
    found = model(data)
    synthesis = {"gains": gains(found, data)}
    loop = analysis.axis_full_loop if case == FULL_LOOPS else analysis.corrected_loop
    return {f"M {axis}": loop(found, synthesis, axis) for axis in AXES}
