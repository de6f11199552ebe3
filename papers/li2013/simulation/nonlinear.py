"""The nonlinear equations (1), repaired, held against the linear loop on consistent orbits; and one warning."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.sampled import HeldRun, held_linear, held_nonlinear, periodic
from recontrol.spacecraft.orbit import clohessy_wiltshire

from ..sweeps import floats
from .loops import SAMPLES, floats_y

DURATION = 120.0


def rates(gm: float, radius: float, w: float, mass: float) -> Any:
    """Right-hand side of (1) with z_c in the third line, and of the integral of y - y_r; [m, s, N].

    The terms w^2 (r + x) and gm (r + x)/d^3 nearly cancel; they are combined so that the difference keeps its digits.
    """
    pull, excess = gm / radius**3, w * w - gm / radius**3

    def acceleration(x: np.ndarray, y_r: np.ndarray, u: np.ndarray) -> np.ndarray:
        position, velocity = x[:3], x[3:6]
        ratio = (2 * radius * position[0] + position @ position) / radius**2
        weaker = -np.expm1(-1.5 * np.log1p(ratio))  # 1 - (r / d)^3
        out = position * (excess + pull * weaker)
        out[0] += radius * (excess + pull * weaker)
        out[2] -= w * w * position[2]
        out += np.array([2 * w * velocity[1], -2 * w * velocity[0], 0.0]) + u / mass
        return np.concatenate([velocity, out, position - y_r])

    return acceleration


def run(data: Any, gm: float, radius: float, w: float) -> tuple[HeldRun, HeldRun]:
    """Nonlinear and linear run for one pair (radius [m], w [rad/s])."""
    v, y_r = floats(data, ""), floats_y(data)
    rate = rates(gm, radius, w, float(data.float("mass")))
    K, start, intervals = v["K"], v["xi0"][:, 0], periodic(v["h"], DURATION)
    nonlinear = held_nonlinear(
        lambda t, x, u: rate(x, y_r, u), lambda t, x: K @ x, start, intervals, SAMPLES, rtol=1e-11, atol=1e-12
    )
    A = v["A_print"].copy()
    A[:6, :6] = clohessy_wiltshire(w)
    # The constant reference enters as one more state that stays at 1.
    push = np.vstack([np.hstack([A, (v["B1"][:, 3:] @ y_r)[:, None]]), np.zeros((1, 10))])
    wide = np.vstack([v["B"], np.zeros((1, 3))]), np.hstack([K, np.zeros((3, 1))])
    linear = held_linear(push, *wide, np.append(start, 1.0), intervals, SAMPLES)
    return nonlinear, linear


def nonlinear(data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Consistent pairs: largest position difference to the linear loop [m]. Inconsistent pair (1.117e-3 rad/s at
    42241 km): residual acceleration at the origin [m/s^2], as a force [N], and the largest |u| [N] over 120 s.
    """
    gm = float(data.float("gm_earth")) * 1e9
    w_print, printed_radius = float(data.float("w-print")), float(data.float("orbit_radius")) * 1e3
    pairs = {
        "w-print": ((gm / w_print**2) ** (1 / 3), w_print),
        "radius-print": (printed_radius, (gm / printed_radius**3) ** 0.5),
    }
    values: dict[str, Any] = {"difference": {}}
    series = {}
    for name, (radius, w) in pairs.items():
        curved, straight = run(data, gm, radius, w)
        gap = np.linalg.norm(curved.state[:, :3] - straight.state[:, :3], axis=1)
        values["difference"][name] = float(gap.max())
        series |= {f"{name}_gap": gap, "time": curved.time}
    wrong, _ = run(data, gm, printed_radius, w_print)
    residual = printed_radius * (w_print**2 - gm / printed_radius**3)
    values["inconsistent"] = {
        "acceleration": residual,
        "force": residual * float(data.float("mass")),
        "u_peak": float(np.abs(wrong.control).max()),
        "distance_end": float(np.linalg.norm(wrong.state[-1, :3])),
    }
    return values, series
