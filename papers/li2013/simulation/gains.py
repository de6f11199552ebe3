"""How strongly d_bar = [d; y_r] acts on z: continuous limit, sampled gain by lifting, and a proven lower bound."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.exact.ball import precision, to_ball
from recontrol.systems.sampled import interval_cost, lifted, monodromy, sampled_gain, zero_order_hold

from .. import problems as pr
from ..sweeps import floats

PARTS = (8, 16, 32)
CHANNELS = {"both": range(6), "d-only": range(3), "yr-only": range(3, 6)}


def continuous(A: np.ndarray, B: np.ndarray, C: np.ndarray) -> dict[str, float]:
    """H-infinity norm of C (sI - A)^-1 B, its frequency [rad/s] and the static gain, by the Hamiltonian test."""

    def gain(frequency: float) -> float:
        return float(np.linalg.norm(C @ np.linalg.solve(1j * frequency * np.eye(len(A)) - A, B), 2))

    at, best = max(((w, gain(w)) for w in np.concatenate([[0.0], np.geomspace(1e-3, 1e2, 200)])), key=lambda p: p[1])
    for _ in range(60):
        level = best * (1 + 1e-10)
        H = np.block([[A, B @ B.T / level**2], [-C.T @ C, -A.T]])
        poles = np.linalg.eigvals(H)
        on_axis = np.sort(poles.imag[(np.abs(poles.real) < 1e-9 * np.abs(poles).max()) & (poles.imag > 0)])
        if on_axis.size < 2:
            break
        middles = [(a + b) / 2 for a, b in itertools.pairwise(on_axis)]
        new = max(((w, gain(w)) for w in middles), key=lambda p: p[1])
        if new[1] <= best:
            break
        at, best = new
    return {"norm": best, "frequency": float(at), "static": gain(0.0)}


def pulse_ratio(data: Any, orbit: str, count: int) -> Any:
    """Ball: (||z|| / ||d_bar||)^2 for y_r held over `count` intervals and zero afterwards, d = 0, xi(0) = 0.

    The tail after `top` intervals more is left out, so that the ball bounds the ratio from below.
    """
    exact = pr.exact_data(data, "")
    A, G, C2, h = exact[pr.ORBITS[orbit]], exact["B"] @ exact["K"], exact["C2"], data["h"]
    E = exact["B1"][:, 3:] @ data["y_r"].T
    n = A.shape[0]
    with precision(128):
        # State, held state and a constant 1 that carries y_r.
        F = np.vstack([np.hstack([A, G, E]), rational.zeros(n + 1, 2 * n + 1)])
        Q = rational.zeros(2 * n + 1)
        Q[:n, :n] = C2.T @ C2
        W, M = interval_cost(F, Q, h), monodromy(A, G, h)
        _, push = zero_order_hold(A, E, h)
        x, total = to_ball(rational.zeros(n, 1)), to_ball(fmpq(0))
        for k in range(count + 120):
            on = fmpq(int(k < count))
            stacked = np.vstack([x, x, np.array([[on]], dtype=object)])
            total = total + (stacked.T @ W @ stacked)[0, 0]
            x = M @ x + push * on
        energy = sum((y * y for y in data["y_r"].flat), fmpq(0)) * count * h
        return total / energy


def gains(data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """continuous and sampled: orbit -> channel -> numbers; pulse: intervals held -> ball of the squared ratio."""
    values: dict[str, Any] = {"continuous": {}, "sampled": {}, "pulse": {}}
    v = floats(data, "")
    for orbit, name in pr.ORBITS.items():
        A, G = v[name], v["B"] @ v["K"]
        for channel, columns in CHANNELS.items():
            B1 = v["B1"][:, list(columns)]
            values["continuous"].setdefault(orbit, {})[channel] = continuous(A + G, B1, v["C2"])
            rows = {}
            for parts in PARTS:
                gain, angle = sampled_gain(lifted(A, G, B1, v["C2"], v["h"], parts), grid=40, rounds=25)
                rows[str(parts)] = {"gain": gain, "frequency": angle / v["h"]}
            values["sampled"].setdefault(orbit, {})[channel] = rows
        values["pulse"][orbit] = {str(n): pulse_ratio(data, orbit, n) for n in (8, 40)}
    return values, {"parts": np.array(PARTS, dtype=float)}
