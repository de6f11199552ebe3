"""Start anomaly and eccentricity swept, and an ensemble of start errors; gains and observer unchanged."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..loop import Array, simulate, time_grid
from .metrics import HORIZON, estimates, make_batch, metrics, target_orbit

ECCENTRICITIES = ("0", "0.01", "0.05", "0.1", "0.3")
ANOMALIES = tuple(range(0, 360, 30))  # deg
SUMMARY = ("cost", "peak_thrust", "distance_3000s")
SEED, RUNS, VELOCITY_BALL = 2014, 200, 5.0  # -, -, m/s


def _summary(times: Array, found: dict[str, Array], k: int) -> dict[str, Any]:
    full = metrics(times, found, k)
    return {name: full[name] for name in SUMMARY}


def sweeps(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """J, peak thrust and distance at 3000 s over start anomaly and eccentricity, perigee radius kept."""
    runs = {
        f"e_{e}_anomaly_{a:03d}": {"orbit": target_orbit(data, float(e)), "anomaly": np.radians(a)}
        for e in ECCENTRICITIES
        for a in ANOMALIES
    }
    times = time_grid(HORIZON)
    found = simulate(make_batch(data, model, [{"estimate": "xhat0_r0", **run} for run in runs.values()]), times)
    values = {name: _summary(times, found, k) for k, name in enumerate(runs)}
    values["worst"] = {
        e: {name: _largest(name, [values[f"e_{e}_anomaly_{a:03d}"][name] for a in ANOMALIES]) for name in SUMMARY}
        for e in ECCENTRICITIES
    }
    return values, {"anomaly": np.array(ANOMALIES)}


def _largest(name: str, found: list[Any]) -> Any:
    return np.max(found, axis=0) if name == "peak_thrust" else max(found)


def ensemble(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """200 runs: start anomaly uniform, velocity error uniform in the ball of 5 m/s, no position error; quantiles."""
    random = np.random.default_rng(SEED)
    anomaly = random.uniform(0, 2 * np.pi, RUNS)
    direction = random.normal(size=(3, RUNS))
    radius = VELOCITY_BALL * random.uniform(size=RUNS) ** (1 / 3)
    error = direction / np.linalg.norm(direction, axis=0) * radius
    exact = estimates(data)["xhat0_x0"]
    runs = [
        {"estimate": exact - np.concatenate([np.zeros(3), error[:, k]]), "anomaly": anomaly[k]} for k in range(RUNS)
    ]
    times = np.concatenate([np.arange(0, 30, 0.05), np.arange(30, HORIZON + 1, 5.0)])
    found = simulate(make_batch(data, model, runs), times, rtol=1e-9)
    rows = [metrics(times, found, k) for k in range(RUNS)]
    peaks = np.array([row["peak_thrust"] for row in rows])
    quantiles = (0.0, 0.05, 0.5, 0.95, 1.0)
    values = {
        "quantiles": list(quantiles),
        "cost": np.quantile([row["cost"] for row in rows], quantiles),
        "time_50m": np.quantile([row["time_50m"] for row in rows], quantiles),
        "peak_thrust": {axis: np.quantile(peaks[:, i], quantiles) for i, axis in enumerate("xyz")},
    }
    return values, {"peak_thrust": peaks, "velocity_error": error.T}
