"""Robustness ensembles of the published controller: constant drift of its gains, and of inertia besides.

Each column of A_f and B_f and each row of C_f is off by up to the printed 5 %, each moment of inertia by up to its
printed envelope. Rigid loop from the printed initial state, the controller at rest, no disturbance.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.campaign.linear import abscissa, settling_and_peak, trajectories
from recontrol.systems.output_feedback import drifted
from recontrol.systems.regions import disk_radius

from .loops import rigid_family
from .plant import controller, float_controller, floats, plant

STEP, SAMPLES, BAND = 0.05, 801, 0.02
BLOCK = 500


def outcomes(rng: Any, count: int, data: Any, inertia: float) -> dict[str, np.ndarray]:
    """Settling [s] and peak [rad] of the angles, largest torque [N m], distance of the poles from the disk's centre."""
    drift = data.float("drift_bound") * rng.uniform(-1, 1, (count, 12))
    delta = inertia * rng.uniform(-1, 1, (count, 3))
    gains = drifted(float_controller(controller(data, "proposed")), drift)
    A, _ = rigid_family(floats(plant(data)), gains, delta)
    start = np.concatenate([data.float("q0")[0], data.float("qd0")[0], np.zeros(6)])
    x0 = np.broadcast_to(start, (count, 12))
    settling, peak = settling_and_peak(A, x0, np.eye(3, 12), step=STEP, samples=SAMPLES, band=BAND)
    torque = np.empty(count)
    for first in range(0, count, BLOCK):
        part = slice(first, first + BLOCK)
        states = trajectories(A[part], x0[part], STEP, SAMPLES)[:, :, 6:]
        torque[part] = np.linalg.norm(states @ np.swapaxes(gains.C[part], 1, 2), axis=2).max(axis=1)
    radius = disk_radius(np.linalg.eigvals(A), data.float("disk_a"))
    return {"settling": settling, "peak": peak, "torque": torque, "radius": radius, "abscissa": abscissa(A)}


def gain_drift(rng: Any, count: int, data: Any) -> dict[str, np.ndarray]:
    """The twelve drift parameters of the gains, nominal inertia."""
    return outcomes(rng, count, data, 0.0)


def drift_inertia(rng: Any, count: int, data: Any) -> dict[str, np.ndarray]:
    """All fifteen parameters: drift of the gains and errors of the three moments of inertia."""
    return outcomes(rng, count, data, 1.0)
