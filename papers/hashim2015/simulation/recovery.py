"""Beyond the paper: loop transfer recovery. The estimator of W = q_e B B', V = 1 for growing q_e.

As q_e grows, the loop at the plant input tends to that of state feedback, K (sI - A)^-1 B, if the plant has no zero in
the right half plane. q_e = 10 is the paper's estimator. Values: margins for each q_e, and of state feedback.
Series: peak sensitivity and phase margin over a fine sweep.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import solve_continuous_are

from recontrol.systems import margins
from recontrol.systems.statespace import StateSpace, state_space

from . import designs

WEIGHTS = (1.0, 10.0, 100.0, 1e3, 1e4, 1e6)
FINE = np.geomspace(1.0, 1e6, 31)


def observer(plant: StateSpace, K: np.ndarray, weight: float) -> StateSpace:
    """Full-order compensator with the Kalman gain of W = weight B B', V = 1."""
    A, B, C, _ = plant
    P = solve_continuous_are(A.T, C.T, weight * B @ B.T, np.eye(1))
    L = P @ C.T
    return state_space(A - B @ K - L @ C, L, -K)


def state_feedback(plant: StateSpace, K: np.ndarray) -> tuple[StateSpace, StateSpace]:
    """State feedback as a loop of one input and one output: the plant with output K x, the compensator -1."""
    seen = plant._replace(C=K)
    return seen, StateSpace(np.array([[-1.0]]), np.zeros((1, 1)), np.zeros((1, 1)), np.array([[-1.0]]))


def measure(plant: StateSpace, compensator: StateSpace) -> dict[str, float | str]:
    """Peak sensitivity and phase margin [deg]."""
    return {
        "peak_sensitivity": margins.peak_sensitivity(plant, compensator).value,
        "phase_margin": designs.number(margins.phase_margin(*margins.loop_transfer(plant, compensator)).degrees),
    }


def recovery(model: dict[str, Any], synthesis: dict[str, Any]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    values: dict[str, Any] = {"axes": {}}
    series: dict[str, np.ndarray] = {"q_e": FINE}
    for axis in designs.AXES:
        plant = designs.plant_of(model, axis)
        K = np.reshape(synthesis["gains"][axis]["K"], (1, -1))
        fine = [measure(plant, observer(plant, K, weight)) for weight in FINE]
        for name in ("peak_sensitivity", "phase_margin"):
            series[f"{axis}/{name}"] = np.array([float(m[name]) for m in fine])
        values["axes"][axis] = {
            "weights": {f"{weight:g}": measure(plant, observer(plant, K, weight)) for weight in WEIGHTS},
            "state_feedback": measure(*state_feedback(plant, K)),
        }
    return values, series
