"""Robustness ensemble of the sampled loop: every interval at random up to the printed bound, starts in every direction.

Published gain, rounded anew within its print, held reference zero, no disturbance. Intervals are drawn from fifty equal
steps of the bound, so that fifty matrix exponentials serve all trajectories.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.campaign.draws import boxed, directions
from recontrol.campaign.steppers import batched_expm

from .sweeps import floats

LEVELS = 50
DURATION = 120.0  # s
BAND = 0.1  # m


def transitions(A: np.ndarray, B: np.ndarray, h: float) -> tuple[np.ndarray, np.ndarray]:
    """Free (LEVELS, n, n) and forced (LEVELS, n, m) response of held inputs over h/LEVELS, ..., h [s]."""
    n, m = B.shape
    wide = np.zeros((n + m, n + m))
    wide[:n] = np.hstack([A, B])
    found = batched_expm(wide * (h * np.arange(1, LEVELS + 1) / LEVELS)[:, None, None])
    return found[:, :n, :n], found[:, :n, n:]


def jitter(rng: Any, count: int, data: Any) -> dict[str, np.ndarray]:
    """Settling of the position, largest thrust, distance at the end, and decay rate between the ends."""
    v = floats(data, "")
    A, B, h = v["A_print"], v["B"], float(v["h"])
    K = boxed(rng, count, data, "K_bar", zeros_exact=True)
    free, forced = transitions(A, B, h)
    distance = np.linalg.norm(v["xi0"][:3, 0])
    x = np.zeros((count, A.shape[0]))
    x[:, :3] = directions(rng, (count, 3), distance)
    first = np.linalg.norm(x, axis=1)
    time, settled, thrust = np.zeros(count), np.zeros(count), np.zeros(count)
    # A trajectory stands still once its clock has passed the duration.
    while np.any(time < DURATION):
        active = time < DURATION
        u = np.einsum("rij,rj->ri", K, x)
        thrust = np.maximum(thrust, np.where(active, np.abs(u).max(axis=1), 0.0))
        level = rng.integers(LEVELS, size=count)
        moved = np.einsum("rij,rj->ri", free[level], x) + np.einsum("rij,rj->ri", forced[level], u)
        x = np.where(active[:, None], moved, x)
        time = time + np.where(active, h * (level + 1) / LEVELS, 0.0)
        settled = np.where(active & (np.abs(x[:, :3]).max(axis=1) > BAND), time, settled)
    rate = np.log(np.linalg.norm(x, axis=1) / first) / time
    return {
        "settling": np.where(settled < time, settled, np.inf),
        "thrust": thrust,
        "distance": np.linalg.norm(x[:, :3], axis=1),
        "rate": rate,
    }
