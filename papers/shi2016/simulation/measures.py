"""What is read off a run: settling times for several thresholds, peaks, angles at the times that the paper names."""

from __future__ import annotations

from typing import Any

import numpy as np

FRACTIONS = ("0.05", "0.02", "0.01", "0.001")
TIMES = (20.0, 50.0, 200.0, 600.0)


def settling(times: np.ndarray, largest: np.ndarray, reference: float) -> dict[str, float | str]:
    """Last time [s] with largest angle > fraction * reference, per fraction; "never" if the run ends above.

    ``largest`` (N,) [rad] is max_i |angle_i|; the resolution is the sample step.
    """
    out: dict[str, float | str] = {}
    for fraction in FRACTIONS:
        above = np.flatnonzero(largest > float(fraction) * reference)
        if not above.size:
            out[fraction] = 0.0
        elif above[-1] == len(largest) - 1:
            out[fraction] = "never"
        else:
            out[fraction] = float(times[above[-1]])
    return out


def measures(times: np.ndarray, x: np.ndarray, u: np.ndarray, z: np.ndarray, initial: float) -> dict[str, Any]:
    """Settling times and peaks of one run: states x (N, 6), torques u (N, 3) [N m], output z_inf z (N, 3).

    ``initial`` is the largest initial angle [rad], the reference of `of-x0`.
    """
    largest = np.abs(x[:, :3]).max(axis=1)
    found = {
        "of_x0": settling(times, largest, initial),
        "of_peak": settling(times, largest, float(largest.max())),
        "peak_angle": float(largest.max()),
        "peak_rate": float(np.abs(x[:, 3:]).max()),
        "peak_torque": np.abs(u).max(axis=0),
        "peak_z_inf": np.abs(z).max(axis=0),
        "initial_torque": u[0],
    }
    found["angle_at"] = {f"{t:g}": float(largest[np.searchsorted(times, t)]) for t in TIMES if t <= times[-1]}
    return found
