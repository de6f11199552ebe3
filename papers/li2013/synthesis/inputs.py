"""Least integral of e'e over the first 30 s for any held thrust within the limits: what no gain can beat."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.systems.sampled import interval_cost, zero_order_hold

from .. import problems as pr
from ..sweeps import run, values_of

STEPS = 60


def _quadratic(A: np.ndarray, B: np.ndarray, C: np.ndarray, x0: np.ndarray, h: float) -> tuple[Any, Any, float]:
    """H, f, c with integral = u'H u + f'u + c for the stacked held inputs u (STEPS * 3,)."""
    n, m = B.shape
    free, forced = zero_order_hold(A, B, h)
    F = np.vstack([np.hstack([A, B]), np.zeros((m, n + m))])
    Q = np.zeros((n + m, n + m))
    Q[:n, :n] = C.T @ C
    W = interval_cost(F, Q, h)
    state, inputs = x0, np.zeros((n, STEPS * m))
    H, f, c = np.zeros((STEPS * m, STEPS * m)), np.zeros(STEPS * m), 0.0
    for k in range(STEPS):
        pick = np.zeros((m, STEPS * m))
        pick[:, k * m : (k + 1) * m] = np.eye(m)
        L, offset = np.vstack([inputs, pick]), np.concatenate([state, np.zeros(m)])
        H, f, c = H + L.T @ W @ L, f + 2 * L.T @ W @ offset, c + float(offset @ W @ offset)
        state, inputs = free @ state, free @ inputs + forced @ pick
    return (H + H.T) / 2, f, c


def least_integral(data: Any, w: fmpq) -> dict[str, Any]:
    """value: found by the solver; bound: from below by the gradient at its point over the box; u (STEPS, 3) [N]."""
    import cvxpy

    plant = {name: rational.to_float(M) for name, M in pr.plant(w, data["mass"]).items()}
    limit, h = (float(rational.to_float(data[name])) for name in ("thrust_max", "h"))
    x0 = rational.to_float(pr.exact_data(data, "")["xi0"])[:, 0]
    H, f, c = _quadratic(plant["A"], plant["B"] * limit, plant["C2"], x0, h)
    u = cvxpy.Variable(STEPS * 3)
    problem = cvxpy.Problem(cvxpy.Minimize(cvxpy.quad_form(u, cvxpy.psd_wrap(H)) + f @ u), [u <= 1, u >= -1])
    found = np.clip(values_of(problem, run(problem))[u.id], -1, 1)
    gradient = 2 * H @ found + f
    value = float(found @ H @ found + f @ found + c)
    bound = value - float(np.sum(np.abs(gradient)) + gradient @ found)
    return {"value": value, "bound": bound, "u": found.reshape(STEPS, 3) * limit}


def inputs(data: Any) -> dict[str, Any]:
    """w-print and w = 0: least integral of e'e [m^2 s^3] over 30 s of held thrusts from x(0), with its lower bound."""
    return {"w-print": least_integral(data, data["w-print"]), "w=0": least_integral(data, fmpq(0))}
