"""V(t) of (24), (25) along the loop, with the proven P of largest margin; jumps, decay, and V with a held reference."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact import rational
from recontrol.lmi.certificate import decode
from recontrol.simulate.sampled import HeldRun, held_linear, periodic
from recontrol.systems.sampled import held_cost, monodromy

from .. import problems as pr
from ..sweeps import floats
from .loops import SAMPLES, floats_y

SEED, RANDOM_COUNT = 3, 700


def along(
    run: HeldRun, A: np.ndarray, G: np.ndarray, P: list[np.ndarray], h: float, alpha: float, shift: np.ndarray
) -> dict[str, np.ndarray]:
    """time, V (intervals, samples + 1): both ends of every interval are kept, so that jumps at the instants show.

    x' = A x + G x(t_k) over the first n = len(A) states; `shift` (n,) is taken from state and held state alike. V_2 by
    the trapezoidal rule on the samples of the exact motion, corrected by the derivative (error of fourth order).
    """
    xi, times, values = run.state[:, : len(A)] - shift, [], []
    for k, start in enumerate(run.instants):
        rows = slice(k * run.samples, (k + 1) * run.samples + 1)
        age, part = run.time[rows] - start, xi[rows]
        slope = part @ A.T + G @ part[0]
        rise = 2 * np.einsum("ij,jk,ik->i", slope, P[1], slope @ A.T)
        memory = _discounted(age, np.einsum("ij,jk,ik->i", slope, P[1], slope), rise, alpha)
        gap = part[0] - part
        own = np.einsum("ij,jk,ik->i", part, P[0], part)
        values.append(own + (h - age) * (memory + np.einsum("ij,jk,ik->i", gap, P[2], gap)))
        times.append(run.time[rows])
    return {"time": np.array(times), "V": np.array(values)}


def _discounted(age: np.ndarray, density: np.ndarray, rise: np.ndarray, alpha: float) -> np.ndarray:
    """Integral of density(s) exp(-2 alpha (age - s)), by steps of the corrected trapezoidal rule."""
    weight = np.exp(2 * alpha * age)
    f, df = density * weight, (rise + 2 * alpha * density) * weight
    step = np.diff(age)
    pieces = step / 2 * (f[1:] + f[:-1]) + step**2 / 12 * (df[:-1] - df[1:])
    return np.concatenate([[0.0], np.cumsum(pieces)]) / weight


def random_intervals() -> np.ndarray:
    """Sampling intervals [s] of the case `random`."""
    return np.random.default_rng(SEED).uniform(0.05, 0.5, RANDOM_COUNT)


def _summary(out: dict[str, np.ndarray], alpha: float) -> dict[str, float]:
    """Least V, largest rise inside an interval, largest ratio to the envelope, largest and least jump at t_k."""
    V, time = out["V"], out["time"]
    jumps = V[1:, 0] - V[:-1, -1]
    envelope = V[0, 0] * np.exp(-2 * alpha * time)
    return {
        "least": float(V.min()),
        "rise_inside": float(np.diff(V, axis=1).max()),
        "over_envelope": float((V / envelope).max()),
        "jump_up": float(jumps.max()),
        "jump_down": float(-jumps.min()),
        "start": float(V[0, 0]),
        "end": float(V[-1, -1]),
    }


def integral_by_quadrature(data: Any, orbit: str) -> dict[str, float]:
    """Integral of e'e over 300 s for the zero reference, by Gauss points in each interval, against the Stein value."""
    from scipy.linalg import solve_discrete_lyapunov

    v = floats(data, "")
    A, G, C2, h, xi0 = v[pr.ORBITS[orbit]], v["B"] @ v["K"], v["C2"], v["h"], v["xi0"][:, 0]
    M, W = monodromy(A, G, h), held_cost(A, G, C2, h)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    maps = [C2 @ monodromy(A, G, h * (1 + x) / 2) for x in nodes]
    total, state = 0.0, xi0
    for _ in range(round(300 / h)):
        total += h / 2 * sum(float(w * np.sum((L @ state) ** 2)) for w, L in zip(weights, maps, strict=True))
        state = M @ state
    return {"quadrature_300s": total, "stein": float(xi0 @ solve_discrete_lyapunov(M.T, W) @ xi0)}


def functional(data: Any, certificates: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """zero reference, periodic and random sampling; hold, raw and shifted by xi_ss; integral of e'e."""
    point = certificates["functional"]["witness"]["point"]
    P = [rational.to_float(decode(point[name])) for name in ("P1", "P2", "P3")]
    v = floats(data, "")
    A, G, none, h, alpha = v["A_print"], v["B"] @ v["K"], np.zeros(9), v["h"], v["alpha"]
    rest = rational.to_float(pr.equilibrium(pr.exact_data(data, ""), "A_print", data["y_r"].T))[:, 0]
    intervals, start = periodic(h, 200.0), v["xi0"][:, 0]
    even = held_linear(A, v["B"], v["K"], start, intervals, SAMPLES)
    uneven = held_linear(A, v["B"], v["K"], start, random_intervals(), SAMPLES)
    # The constant reference is a tenth state that stays at 1 and has no weight in V.
    A10 = np.vstack([np.hstack([A, (v["B1"][:, 3:] @ floats_y(data))[:, None]]), np.zeros((1, 10))])
    B10, K10 = np.vstack([v["B"], np.zeros((1, 3))]), np.hstack([v["K"], np.zeros((3, 1))])
    hold = held_linear(A10, B10, K10, np.append(start, 1.0), intervals, SAMPLES)
    wide = [np.pad(M, ((0, 1), (0, 1))) for M in P]
    found = {
        "periodic": along(even, A, G, P, h, alpha, none),
        "random": along(uneven, A, G, P, h, alpha, none),
        "hold-raw": along(hold, A10, B10 @ K10, wide, h, alpha, np.zeros(10)),
        "hold-shifted": along(hold, A, G, P, h, alpha, rest),
    }
    values: dict[str, Any] = {name: _summary(out, alpha) for name, out in found.items()}
    values["integral"] = {orbit: integral_by_quadrature(data, orbit) for orbit in pr.ORBITS}
    series = {f"{name}_{key}": array for name, out in found.items() for key, array in out.items()}
    return values, series
