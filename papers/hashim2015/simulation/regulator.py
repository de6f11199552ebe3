"""Experiment 2: the regulator, r = 0, from 400 random initial states on each axis.

Values: medians of settling time and of the integral of y^2, and how often the reduced order beats the full order.
Series: the settling times of every initial state.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.linear import propagate
from recontrol.simulate.settling import last_exit
from recontrol.systems.lyapunov import integral_square
from recontrol.systems.statespace import loop_matrix

from . import designs

STATES = 400
SEED = 7
HORIZON = 120.0  # s
SAMPLES = 6001
BAND = 0.02
VARIANTS = ("full", "corrected", "x1", "corrected-xc0", "x1-xc0")


def initial_states(n: int) -> np.ndarray:
    """400 directions (n, 400), normal deviates with normalised columns, from a fresh generator of seed 7."""
    states = np.random.default_rng(SEED).normal(size=(n, STATES))
    return states / np.linalg.norm(states, axis=0)


def loop_start(loop: designs.Loop, x0: np.ndarray, variant: str) -> np.ndarray:
    """Initial states of plant and compensator: the estimate starts at zero, or (``-xc0``) the compensator's state does.

    A reduced compensator's state is ``xc = xh2 - L m`` of the measured signal m, so a zero estimate means
    ``xc(0) = -L m(0)``; a full-order one's state is the estimate itself.
    """
    reduced = variant != "full" and not variant.endswith("-xc0")
    xc0 = -loop.L @ loop.plant.C @ x0 if reduced else np.zeros((loop.compensator.A.shape[0], x0.shape[1]))
    return np.vstack([x0, xc0])


def settle(A: np.ndarray, C: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Settling times [s] (inf allowed) and integrals of y^2 over 0..inf for the initial states (n, batch)."""
    # The rows C exp(A t) serve all initial states: one row is propagated by A', not 400 columns by A.
    outputs = propagate(A.T, C[0], HORIZON / (SAMPLES - 1), SAMPLES) @ start
    return last_exit(np.linspace(0.0, HORIZON, SAMPLES), outputs, BAND), integral_square(A, C, start)


def one_axis(model: dict[str, Any], synthesis: dict[str, Any], axis: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Settling times and ISE of state feedback, full order, corrected and x1 design, and the variants xc(0) = 0."""
    plant = designs.plant_of(model, axis)
    x0 = initial_states(plant.A.shape[0])
    K = np.reshape(synthesis["gains"][axis]["K"], (1, -1))
    found = {"state-feedback": settle(plant.A - plant.B @ K, plant.C, x0)}
    for variant in VARIANTS:
        loop = designs.loop_of(model, synthesis, axis, variant.removesuffix("-xc0"))
        start = loop_start(loop, x0, variant)
        output = np.hstack([loop.output, np.zeros((1, start.shape[0] - x0.shape[0]))])
        found[variant] = settle(loop_matrix(loop.plant, loop.compensator), output, start)
    return found


def summary(found: dict[str, tuple[np.ndarray, np.ndarray]]) -> dict[str, Any]:
    """Medians, and for the reduced designs the fraction of states on which they beat the full order."""
    full_time, full_ise = found["full"]
    table = {}
    for name, (time, ise) in found.items():
        row: dict[str, Any] = {
            "median_settling": designs.number(float(np.median(time))),
            "median_ise": float(np.median(ise)),
            "unsettled": int(np.isinf(time).sum()),
        }
        if name not in ("full", "state-feedback"):
            row["fraction_settles_first"] = float(np.mean(time < full_time))
            row["fraction_ties"] = float(np.mean(time == full_time))
            row["fraction_smaller_ise"] = float(np.mean(ise < full_ise))
        table[name] = row
    return table


def regulator(model: dict[str, Any], synthesis: dict[str, Any]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    found = {axis: one_axis(model, synthesis, axis) for axis in designs.AXES}
    values = {
        "axes": {axis: summary(table) for axis, table in found.items()},
        "definition": {"states": STATES, "seed": SEED, "horizon": HORIZON, "samples": SAMPLES, "band": BAND},
    }
    series = {
        f"{axis}/{name}": np.where(np.isinf(time), HORIZON, time)
        for axis, table in found.items()
        for name, (time, _) in table.items()
    }
    return values, series
