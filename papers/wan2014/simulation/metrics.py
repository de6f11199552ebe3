"""What is read off a run: peaks, times, costs; and the runs' common set-up."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.spacecraft.orbit import KeplerOrbit

from ..loop import Array, Batch

STARTS = ("xhat0_x0", "xhat0_r0", "xhat0_zero")
HORIZON = 6000.0  # s
KM = 1000.0  # m


def target_orbit(data: Any, eccentricity: float | None = None) -> KeplerOrbit:
    """The target's orbit in m and s, perigee radius kept for any eccentricity."""
    e = data.float("e") if eccentricity is None else eccentricity
    return KeplerOrbit(data.float("gm") * KM**3, data.float("r_p") * KM, e)


def estimates(data: Any) -> dict[str, Array]:
    """xhat(0) (6,) by case."""
    x0 = data.float("x0")[:, 0]
    return {"xhat0_x0": x0, "xhat0_r0": np.concatenate([x0[:3], np.zeros(3)]), "xhat0_zero": np.zeros(6)}


def make_batch(data: Any, model: Any, runs: list[dict[str, Any]]) -> Batch:
    """Batch of runs; a run names `estimate` and may give K, L, clip, orbit, anomaly."""
    from recontrol.exact.rational import to_float

    x0, limit, start = data.float("x0")[:, 0], data.float("u_max")[0], estimates(data)
    return Batch(
        A=to_float(model["A"]["n_printed"]),
        mass=data.float("m"),
        K=np.array([run.get("K", data.float("K")) for run in runs]),
        L=np.array([run.get("L", data.float("L_corrected")) for run in runs]),
        limit=np.array([limit if run.get("clip") else np.full(3, np.inf) for run in runs]),
        start=np.repeat(x0[:, None], len(runs), axis=1),
        estimate=np.column_stack(
            [start[r["estimate"]] if isinstance(r["estimate"], str) else r["estimate"] for r in runs]
        ),
        orbits=tuple(run.get("orbit") or target_orbit(data) for run in runs),
        anomaly=np.array([run.get("anomaly", 0.0) for run in runs]),
    )


def last_above(times: Array, values: Array, level: float) -> float | None:
    """Last time [s] at which `values` exceeds `level`; 0 if never, None if still at the end.

    Interpolated, since the samples of a run lie up to 10 s apart; `recontrol.simulate.sampled.last_outside` gives the
    sample after the last one outside, of a dense run.
    """
    above = np.flatnonzero(values > level)
    if not above.size:
        return 0.0
    if above[-1] == len(values) - 1:
        return None
    k = above[-1]
    return float(times[k] + (times[k + 1] - times[k]) * (values[k] - level) / (values[k] - values[k + 1]))


def metrics(times: Array, found: dict[str, Array], k: int) -> dict[str, Any]:
    """Quantities of run `k` of a simulated batch; units m, m/s, N, s."""
    state, command, applied = (found[name][:, :, k] for name in ("state", "command", "applied"))
    error = np.linalg.norm((found["state"] - found["estimate"])[3:, :, k], axis=0)
    distance, speed = np.linalg.norm(state[:3], axis=0), np.linalg.norm(state[3:], axis=0)
    at = {second: int(np.searchsorted(times, second)) for second in (20, 30, 60, 3000, 6000)}
    early = times <= 60
    return {
        "thrust_start": command[:, 0],
        "peak_thrust": np.abs(applied).max(axis=1),
        "peak_time": times[np.abs(applied).argmax(axis=1)],
        "peak_after_20s": np.abs(applied[:, at[20] :]).max(axis=1),
        "commanded_peak": np.abs(command).max(axis=1),
        "saturated_fraction": (np.abs(command - applied)[:, early] > 0).mean(axis=1) if early.any() else np.zeros(3),
        "velocity_error_peak": float(error.max()),
        "velocity_error_30s": float(error[at[30]]),
        "velocity_error_time": last_above(times, error, 0.05),
        "peak_velocity": np.abs(state[3:]).max(axis=1),
        "distance_3000s": float(distance[at[3000]]),
        "speed_3000s": float(speed[at[3000]]),
        "distance_6000s": float(distance[-1]),
        **{f"time_{level}m": last_above(times, distance, level) for level in (50, 10, 1)},
        "cost": float(found["cost"][-1, k]),
        "impulse": float(found["impulse"][-1, k]),
    }
