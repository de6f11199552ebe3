"""Plants, compensators and the ways in which a reference can enter their loops.

In: the artifacts ``model`` and ``synthesis``. Out: realisations from the reference r to the output y = C x.

Designs: ``full`` (estimator of order n), ``corrected`` (reduced order with y measured, in the states T x), ``x1`` (the
paper's reduced order, first state measured), ``x1-fed-y`` (the same compensator connected to y). Readings of "step
response": S, r added to u and known to the estimator; B, r at the plant's input only; C, r at the sensor, the
compensator driven by the measured signal minus r; D, the compensator alone; A, literally (55)-(57).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from recontrol.systems.statespace import StateSpace, loop_matrix, state_space

AXES = ("yaw", "pitch-tf", "roll")
BANDS = (0.01, 0.02, 0.05)
FULL = ("A", "S", "B", "C", "D")
REDUCED = (
    "corrected-S",
    "x1-B",
    "x1-C",
    "x1-D",
    "x1-fed-y-B",
    "x1-fed-y-C",
    "corrected-B",
    "corrected-C",
    "corrected-D",
)
LIKE_FOR_LIKE = {
    "S": ("full-S", "corrected-S"),
    "B": ("full-B", "corrected-B"),
    "B, x1 measured": ("full-B", "x1-B"),
    "C": ("full-C", "corrected-C"),
    "C, x1 measured": ("full-C", "x1-C"),
}
"""Full-order and reduced-order readings in which the reference enters at the same place."""

PATTERN = {"yaw": "faster", "pitch-tf": "slower", "roll": "faster"}
"""What section 3 says of the reduced order on each axis, by settling time."""

TIE = 1e-6  # s: two settling times closer than this count as equal


class Loop(NamedTuple):
    """A plant seen through the measured signal of a design, its compensator, and the estimator's input matrix."""

    plant: StateSpace  # output: the measured signal
    output: np.ndarray  # C (1, n) of y
    compensator: StateSpace
    B_u: np.ndarray
    L: np.ndarray


def plant_of(model: dict[str, Any], axis: str) -> StateSpace:
    """The plant of one axis with output y."""
    entry = model[axis]
    return state_space(entry["A"], entry["B"], entry["C"])


def first_state(plant: StateSpace) -> StateSpace:
    """The same plant with x1 as its output, as (28) assumes."""
    return plant._replace(C=np.eye(1, plant.A.shape[0]))


def loop_of(model: dict[str, Any], synthesis: dict[str, Any], axis: str, design: str) -> Loop:
    """The loop of one design on one axis (gains ``exact``)."""
    plant, gains = plant_of(model, axis), synthesis["gains"][axis]
    found = gains["corrected"] if design == "corrected" else gains["full" if design == "full" else "x1"]["exact"]
    compensator = state_space(found["A"], found["B"], found["C"], found["D"])
    seen = first_state(plant) if design == "x1" else plant
    n = compensator.A.shape[0]
    return Loop(seen, plant.C, compensator, np.reshape(found["B_u"], (n, 1)), np.reshape(found["L"], (n, 1)))


def from_reference(loop: Loop, entry: str) -> StateSpace:
    """From r to y for the reference entry S, B or C; from the measured signal to u for D.

    Raises
    ------
    ValueError
        If the entry is none of these.
    """
    plant, compensator = loop.plant, loop.compensator
    n = compensator.A.shape[0]
    if entry == "D":
        return compensator
    inputs = {
        "S": np.vstack([plant.B, loop.B_u]),
        "B": np.vstack([plant.B, np.zeros((n, 1))]),
        "C": np.vstack([-plant.B @ compensator.D, -compensator.B]),
    }
    if entry not in inputs:
        raise ValueError(f"reference entry {entry!r} is none of {', '.join(inputs)}, D")
    outputs = np.hstack([loop.output, np.zeros((1, n))])
    return StateSpace(loop_matrix(plant, compensator), inputs[entry], outputs, np.zeros((1, 1)))


def printed_compensated(plant: StateSpace, K: np.ndarray) -> StateSpace:
    """What (55)-(57) show to a step: the input reaches only the first states, whose matrix is A - 2 B K."""
    return plant._replace(A=plant.A - 2 * plant.B @ np.reshape(K, (1, -1)))


def systems(model: dict[str, Any], synthesis: dict[str, Any], axis: str) -> dict[str, StateSpace]:
    """All fourteen readings of one axis, full order first, under the names of :data:`FULL` and :data:`REDUCED`."""
    found = {}
    for entry in FULL:
        if entry == "A":
            found["full-A"] = printed_compensated(plant_of(model, axis), synthesis["gains"][axis]["K"])
        else:
            found[f"full-{entry}"] = from_reference(loop_of(model, synthesis, axis, "full"), entry)
    for name in REDUCED:
        design, entry = name.rsplit("-", 1)
        found[name] = from_reference(loop_of(model, synthesis, axis, design), entry)
    return found


def number(value: float) -> float | str:
    """A value for an artifact: infinity is a word there, since JSON has no infinite number."""
    return "infinite" if math.isinf(value) else float(value)
