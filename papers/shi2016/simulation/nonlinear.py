"""Nonlinear runs: Euler's equations with the full gravity gradient, 3-2-1 angles to LVLH, feedback of angles and rates.

A run ends where the pitch reaches 1.5 rad, since the angles are no chart beyond it: that is shown as "chart ends",
never as settling.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.spacecraft.attitude import angle_rates, body_rate, rigid_attitude

from .. import plant
from .linear import DEFAULT_DISTURBANCE, HORIZON, PERTURBED, Loop
from .measures import measures

PITCH_LIMIT = 1.5


def nonlinear(data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Values per run (gain, gain-N-printed, gain-N-interleaved): measures, end of the run; series of the largest
    angle."""
    values: dict[str, Any] = {}
    series: dict[str, np.ndarray] = {}
    inertia = [float(j) for j in plant.inertias(data)]
    for gain in plant.GAINS:
        loop = Loop(data, gain)
        for shape in (None, *PERTURBED):
            name = gain if shape is None else f"{gain}-{shape}"
            times, x, end = _run(loop, inertia, shape)
            values[name] = _measures(loop, times, x, shape) | {"end": end, "end_time": float(times[-1])}
            series[f"{name}.t"] = times[::25]
            series[f"{name}.largest"] = np.abs(x[::25, :3]).max(axis=1)
    return values, series


def _run(loop: Loop, inertia: list[float], shape: str | None) -> tuple[np.ndarray, np.ndarray, str]:
    """Times, states (angles, angle rates) and how the run ended: "horizon" or "chart ends"."""
    from scipy.integrate import solve_ivp

    rate = loop.plant["rate"]
    motion = rigid_attitude(inertia, rate)

    def rhs(t: float, y: np.ndarray) -> list[float]:
        state = y.tolist()
        rates = angle_rates(state[:3], state[3:], rate)
        torque = (loop.K + loop.change(t, shape)) @ [*state[:3], *rates] + loop.d(t, DEFAULT_DISTURBANCE)
        return motion(state, torque.tolist())

    def chart(_: float, y: np.ndarray) -> float:
        return PITCH_LIMIT - abs(y[1])

    chart.terminal = True  # type: ignore[attr-defined]
    start = [*loop.x0[:3], *body_rate(loop.x0[:3].tolist(), loop.x0[3:].tolist(), rate)]
    run = solve_ivp(
        rhs, (0.0, HORIZON), start, method="DOP853", t_eval=loop.times, events=chart, rtol=1e-10, atol=1e-13
    )
    rates = np.array([angle_rates(y[:3], y[3:], rate) for y in run.y.T.tolist()])
    return run.t, np.hstack([run.y[:3].T, rates]), "chart ends" if run.status == 1 else "horizon"


def _measures(loop: Loop, times: np.ndarray, x: np.ndarray, shape: str | None) -> dict[str, Any]:
    u = x @ loop.K.T
    if shape is not None:
        u += np.sin(loop.frequency * times + loop.phase)[:, None] * (x @ loop.rows[shape].T)
    z = loop.weight * (u + x @ loop.plant["low"].T + loop.d(times, DEFAULT_DISTURBANCE))
    return measures(times, x, u, z, loop.largest_angle)
