"""Numbers of the simulations."""

from __future__ import annotations

from typing import Any

import numpy as np

METRICS = (
    "thrust_start",
    "peak_thrust",
    "peak_time",
    "peak_after_20s",
    "commanded_peak",
    "saturated_fraction",
    "velocity_error_peak",
    "velocity_error_30s",
    "velocity_error_time",
    "peak_velocity",
    "distance_3000s",
    "speed_3000s",
    "distance_6000s",
    "time_50m",
    "time_10m",
    "time_1m",
    "cost",
    "impulse",
)


def _plain(value: Any) -> Any:
    return np.asarray(value) if isinstance(value, (list, np.ndarray)) else value


def quantities(simulation: Any) -> dict[str, Any]:
    """Quantities of this topic."""
    main, gains = simulation["main"]["values"], simulation["gains"]["values"]
    runs = {**main, **{f"xhat0_r0, {name}": entry for name, entry in gains.items() if name != "printed"}}
    found = {f"sim_{metric}": {case: _plain(entry[metric]) for case, entry in runs.items()} for metric in METRICS}
    sweeps, ensemble = simulation["sweeps"]["values"], simulation["ensemble"]["values"]
    drift, floquet = simulation["drift"]["values"], simulation["floquet"]["values"]
    linear = simulation["linear_cost"]["values"]
    cases = [name for name in sweeps if name != "worst"]
    return {
        **found,
        "fluctuation": {
            f"{case}, {when}": float(main[case][key])
            for case in ("xhat0_x0", "xhat0_r0", "xhat0_zero")
            for when, key in (("first 10 s", "fluctuation_10s"), ("from 20 s on", "fluctuation_later"))
        },
        "route_gap": {name: float(v) for name, v in simulation["routes"]["values"]["gap"].items()},
        "sweep_cost": {name: float(sweeps[name]["cost"]) for name in cases},
        "sweep_peak_thrust": {name: _plain(sweeps[name]["peak_thrust"]) for name in cases},
        "sweep_distance_3000s": {name: float(sweeps[name]["distance_3000s"]) for name in cases},
        "linear_cost_worst": {case: float(linear[case]["worst"]) for case in ("e0_zero", "e0_velocity", "e0_full")},
        "floquet_multiplier": {route: float(entry["multiplier"]) for route, entry in floquet.items()},
        "floquet_decay_rate": {route: float(entry["decay_rate"]) for route, entry in floquet.items()},
        "model_drift": {name: _plain(v) for name, v in drift.items() if name != "times"},
        "ensemble_cost": _plain(ensemble["cost"]),
        "ensemble_time_50m": _plain(ensemble["time_50m"]),
        "ensemble_peak_thrust": {axis: _plain(v) for axis, v in ensemble["peak_thrust"].items()},
    }
