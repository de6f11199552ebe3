"""Robustness ensemble of the two-body motion: start of the rendezvous, orbit, and error of the observer.

Printed K, corrected L, thrust not clipped. The bounds beside the distributions are proven for the two-body motion.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.campaign.draws import directions

from .loop import Batch, simulate
from .simulation.metrics import estimates, last_above, make_batch, target_orbit
from .simulation.sweeps import VELOCITY_BALL

HORIZON = 3000.0  # s, as in the paper's figures
ECCENTRICITY = 2.0  # times the printed one, the largest drawn
NEAR = 50.0  # m
TOLERANCE = 1e-8


TIMES = np.concatenate([np.arange(0, 30, 0.1), np.arange(30, HORIZON + 1, 10.0)])


def drawn(rng: Any, count: int, data: Any, model: Any) -> Batch:
    """Uniform: true anomaly, eccentricity up to twice the printed one, velocity error in a ball of 5 m/s."""
    anomaly = rng.uniform(0, 2 * np.pi, count)
    eccentricity = data.float("e") * ECCENTRICITY * rng.uniform(0, 1, count)
    error = directions(rng, (count, 3)) * VELOCITY_BALL * rng.uniform(0, 1, (count, 1)) ** (1 / 3)
    exact = estimates(data)["xhat0_x0"]
    runs = [
        {
            "estimate": exact - np.append(np.zeros(3), error[k]),
            "anomaly": anomaly[k],
            "orbit": target_orbit(data, float(eccentricity[k])),
        }
        for k in range(count)
    ]
    return make_batch(data, model, runs)


def start(rng: Any, count: int, data: Any, model: Any) -> dict[str, np.ndarray]:
    """Cost, largest thrust, distance at the end, and last time farther away than `NEAR`."""
    found = simulate(drawn(rng, count, data, model), TIMES, rtol=TOLERANCE)
    distance = np.linalg.norm(found["state"][:3], axis=0)
    near = [last_above(TIMES, distance[:, k], NEAR) for k in range(count)]
    return {
        "cost": found["cost"][-1],
        "thrust": np.abs(found["applied"]).max(axis=(0, 1)),
        "distance": distance[-1],
        "near": np.array([np.inf if t is None else t for t in near]),
    }
