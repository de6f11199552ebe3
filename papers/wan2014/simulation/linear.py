"""The paper's linear model (1) with the error dynamics (9): worst cost over the start, and Floquet multipliers."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.spacecraft import orbit

from ..loop import Array
from .metrics import target_orbit

HORIZON = 9000.0  # s
PHASES = tuple(range(0, 360, 30))  # deg, mean anomaly at the start


def _parts(data: Any, model: Any, K: Array, L: Array) -> tuple[float, float, Array, Array, Array]:
    """n, e, the constant matrix (12, 12) of (9), (11), and the coefficients (12, 12) of cos M and sin M."""
    from recontrol.exact.rational import to_float

    n, e = float(to_float(model["n"]["n_printed"])), data.float("e")
    A, B, C = to_float(model["A"]["n_printed"]), to_float(model["B"]), data.float("C")
    constant = np.block([[A - B @ K, B @ K], [np.zeros((6, 6)), A - L @ C]])
    terms = []
    for cos_m, sin_m in ((1.0, 0.0), (0.0, 1.0)):
        term = np.zeros((12, 12))
        term[:6, :6] = term[6:, :6] = orbit.near_circular(n, e, cos_m, sin_m)
        terms.append(term)
    return n, e, constant, terms[0], terms[1]


def linear_cost(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """J of the linear model over 9000 s for three e(0), worst over the phase; and e(t) with K = 0."""
    from recontrol.exact.rational import to_float
    from recontrol.simulate.ode import integrate

    K, L = data.float("K"), data.float("L_corrected")
    n, _, constant, cosine, sine = _parts(data, model, K, L)
    cases = list(model["xi0"])
    starts = np.column_stack([to_float(model["xi0"][case])[:, 0] for case in cases for _ in PHASES])
    phases = np.tile(np.radians(PHASES), len(cases))
    gain = np.hstack([K, -K])

    def rhs(t: float, flat: Array) -> Array:
        s = flat.reshape(13, -1)
        x, angle = s[:12], n * t + phases
        rate = constant @ x + (cosine @ x) * np.cos(angle) + (sine @ x) * np.sin(angle)
        return np.vstack([rate, (x[:6] ** 2).sum(axis=0) + ((gain @ x) ** 2).sum(axis=0)]).ravel()

    first = np.vstack([starts, np.zeros(starts.shape[1])])
    atol = np.repeat([*[1e-8] * 3, *[1e-11] * 3, *[1e-8] * 3, *[1e-11] * 3, 1e-3], starts.shape[1])
    cost = integrate(rhs, first.ravel(), [0.0, HORIZON], rtol=1e-11, atol=atol)[-1].reshape(13, -1)[12]
    table = cost.reshape(len(cases), len(PHASES))
    values = {
        case: {"worst": float(row.max()), "best": float(row.min())} for case, row in zip(cases, table, strict=True)
    }
    return values | {"open_loop": _open_loop(data, model, L)}, {"cost": table, "phase": np.array(PHASES, dtype=float)}


def _open_loop(data: Any, model: Any, L: Array) -> dict[str, float]:
    """Largest norm(e) with K = 0, e(0) = 0, over the second and over the tenth revolution [m, m/s mixed]."""
    from recontrol.simulate.ode import integrate

    n, _, constant, cosine, sine = _parts(data, model, np.zeros((3, 6)), L)
    first = np.concatenate([data.float("x0")[:, 0], np.zeros(6)])
    period = 2 * np.pi / n
    times = np.linspace(0, 10 * period, 2001)
    states = integrate(
        lambda t, x: (constant + cosine * np.cos(n * t) + sine * np.sin(n * t)) @ x, first, times, rtol=1e-9, atol=1e-9
    )
    size = np.linalg.norm(states[:, 6:], axis=1)
    return {"second": float(size[200:401].max()), "tenth": float(size[1800:].max())}


def _leading(monodromy: Array, period: float) -> dict[str, float]:
    largest = float(np.abs(np.linalg.eigvals(monodromy)).max())
    return {"multiplier": largest, "decay_rate": float(-np.log(largest) / period)}


def floquet(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """Largest Floquet multiplier over 2 pi/n and decay rate [1/s], by integration and by a product of exponentials;
    and, over the target's true period, with the exact elliptic linearisation in place of (2)."""
    from scipy.linalg import expm

    from recontrol.simulate.ode import integrate

    K, L = data.float("K"), data.float("L_corrected")
    n, _, constant, cosine, sine = _parts(data, model, K, L)
    period = 2 * np.pi / n

    def matrix(t: float) -> Array:
        return constant + cosine * np.cos(n * t) + sine * np.sin(n * t)

    # A fourth-order Magnus step: two Gauss points and their commutator.
    steps, shift = 3000, np.sqrt(3) / 6
    h = period / steps
    product = np.eye(12)
    for k in range(steps):
        low, high = matrix((k + 0.5 - shift) * h), matrix((k + 0.5 + shift) * h)
        product = expm(h / 2 * (low + high) - shift / 2 * h**2 * (low @ high - high @ low)) @ product
    target = target_orbit(data)
    A = orbit.clohessy_wiltshire(n)
    values = {
        "integration": _leading(_monodromy(matrix, period, integrate), period),
        "exponentials": _leading(product, period),
    }

    def elliptic(t: float) -> Array:
        """Plant exactly linearised, observer still with the circular A."""
        exact = orbit.linear_relative(target, float(target.true_anomaly(t)))
        change = np.zeros((12, 12))
        change[:6, :6] = change[6:, :6] = exact - A
        return constant + change

    values["elliptic"] = _leading(_monodromy(elliptic, target.period, integrate), target.period)
    return values, {"monodromy": product}


def _monodromy(matrix: Any, period: float, integrate: Any) -> Array:
    """Monodromy (12, 12); the error is relative to the slow states, the fast observer modes end below it."""
    flat = integrate(
        lambda t, s: (matrix(t) @ s.reshape(12, 12)).ravel(),
        np.eye(12).ravel(),
        [0.0, period],
        rtol=1e-11,
        atol=np.repeat([*[1e-12] * 3, *[1e-15] * 3] * 2, 12),
    )
    return flat[-1].reshape(12, 12)
