"""The linear loop from x(0) under periodic sampling: state, thrust, and numbers per axis."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.sampled import (
    HeldRun,
    held_linear,
    held_nonlinear,
    last_outside,
    oscillator,
    periodic,
    with_exosystem,
)

from ..sweeps import floats

DURATION, SAMPLES = 200.0, 20
AXES = "xyz"


def generator(v: dict[str, Any], orbit_matrix: str, y_r: np.ndarray, amplitude: np.ndarray) -> tuple[Any, ...]:
    """A, B, K, start of the loop with the states sin 2t, cos 2t and 1 appended as an exosystem."""
    E = np.zeros((9, 3))
    E[:, 0] = v["B1"][:, :3] @ amplitude
    E[:, 2] = v["B1"][:, 3:] @ y_r
    S = np.zeros((3, 3))
    S[:2, :2] = oscillator(2.0)
    A = with_exosystem(v[orbit_matrix], E, S)
    B, K = np.vstack([v["B"], np.zeros((3, 3))]), np.hstack([v["K"], np.zeros((3, 3))])
    return A, B, K, np.concatenate([v["xi0"][:, 0], [0.0, 1.0, 1.0]])


def loop(data: Any, orbit: str, y_r: np.ndarray, amplitude: np.ndarray, duration: float = DURATION) -> HeldRun:
    """One run of the published loop."""
    v = floats(data, "")
    name = {"w-print": "A_print", "w-geo": "A_geo"}[orbit]
    return held_linear(*generator(v, name, y_r, amplitude), periodic(v["h"], duration), SAMPLES)


def numbers(run: HeldRun, y_r: np.ndarray) -> dict[str, Any]:
    """Per axis x, y, z: peaks of thrust [N], settling [s], overshoot [m, -], peak speed [m/s], residual [m]."""
    error = run.state[:, :3] - y_r
    start = error[0]
    beyond = np.max(-np.sign(start) * error, axis=0)
    late = run.time >= 150.0

    def settling(bands: np.ndarray) -> list[float | None]:
        return [last_outside(run.time, error[:, k], bands[k]) for k in range(3)]

    table = {
        "u_peak": np.abs(run.control).max(axis=0),
        "u_peak_after_first": np.abs(run.control[1:]).max(axis=0),
        "settle_0.1": settling(np.full(3, 0.1)),
        "settle_0.01": settling(np.full(3, 0.01)),
        "settle_2pct": settling(0.02 * np.abs(start)),
        "overshoot": np.maximum(beyond, 0.0),
        "overshoot_relative": np.maximum(beyond, 0.0) / np.abs(start),
        "speed_peak": np.abs(run.state[:, 3:6]).max(axis=0),
        "residual": np.abs(error[late]).max(axis=0),
        "e_end": run.state[-1, 6:9],
    }
    out = {name: {axis: _plain(row[k]) for k, axis in enumerate(AXES)} for name, row in table.items()}
    at = {f"x_at_{t}": run.state[round(t / run.time[1]), :6] for t in (20, 50, 100)}
    return {**out, **at}


def _plain(value: Any) -> float | None:
    return None if value is None else float(value)


def cross_checks(data: Any) -> dict[str, float]:
    """Largest difference of the state [SI] over 60 s to two integrators restarted at each instant (w-print, sine)."""
    v = floats(data, "")
    y_r = floats_y(data)
    A, B, K, start = generator(v, "A_print", y_r, floats_sine(data))
    intervals = periodic(v["h"], 60.0)
    exact = held_linear(A, B, K, start, intervals, SAMPLES)
    out = {}
    for name, method, rtol, atol in (("DOP853", "DOP853", 1e-12, 1e-13), ("RK45", "RK45", 1e-9, 1e-9)):
        other = held_nonlinear(
            lambda t, x, u: A @ x + B @ u, lambda t, x: K @ x, start, intervals, SAMPLES,
            method=method, rtol=rtol, atol=atol,
        )  # fmt: skip
        out[name] = float(np.abs(exact.state[:, :9] - other.state[:, :9]).max())
    return out


def floats_y(data: Any) -> np.ndarray:
    """y_r (3,) [m]."""
    return np.asarray(data.float("y_r"), dtype=float)[0]


def floats_sine(data: Any) -> np.ndarray:
    """Amplitudes (3,) [N] of the disturbance of sec. 4, sines at 2 rad/s."""
    return np.asarray(data.float("sine"), dtype=float)[0]


def loops(data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """values: metrics -> "orbit reference disturbance" -> numbers, checks; series: time, instants, and state and
    control of each run.
    """
    hold, sine, none = floats_y(data), floats_sine(data), np.zeros(3)
    cases = {
        "w-print hold none": ("w-print", hold, none),
        "w-print hold sine": ("w-print", hold, sine),
        "w-geo hold none": ("w-geo", hold, none),
        "w-geo hold sine": ("w-geo", hold, sine),
        "w-print zero none": ("w-print", none, none),
        "w-geo zero none": ("w-geo", none, none),
    }
    metrics, series = {}, {}
    for name, (orbit, y_r, amplitude) in cases.items():
        run = loop(data, orbit, y_r, amplitude)
        metrics[name] = numbers(run, y_r)
        key = name.replace(" ", "_")
        series |= {f"{key}_state": run.state[:, :9], f"{key}_control": run.control}
        series |= {"time": run.time, "instants": run.instants}
    return {"metrics": metrics, "checks": cross_checks(data)}, series
