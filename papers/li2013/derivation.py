"""The form (35) plus the zero terms (36), assembled from selectors: a second route to the blocks of `conditions`."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi.blocks import he


def quadratic_form(
    point: Mapping[str, np.ndarray], A: np.ndarray, G: np.ndarray, h: Any, alpha: Any, tau: Any, decay: Any
) -> np.ndarray:
    """Pi (4n, 4n) with zeta'Pi zeta equal to the right-hand side of (35) plus both zero terms of (36).

    zeta = [xi; xi'; xi(t_k); phi]; G = B K; `decay` stands for exp(-2 alpha tau). Any kind of entries.
    """
    n = A.shape[0]
    E = _selectors(n, A.dtype == object)
    xi, slope, held, mean = E
    gap, left = held - xi, h - tau
    P1, P2, P3 = (point[name] for name in ("P1", "P2", "P3"))
    grown = he(slope.T @ P1 @ xi) + 2 * alpha * (xi.T @ P1 @ xi)
    memory = left * (slope.T @ P2 @ slope) - (decay * tau) * (mean.T @ P2 @ mean)
    jump = (2 * alpha * left - 1) * (gap.T @ P3 @ gap) - left * he(slope.T @ P3 @ gap)
    motion = (point["T1"] @ xi + point["T2"] @ slope).T @ (slope - A @ xi - G @ held)
    average = (point["S1"] @ xi + point["S2"] @ slope + point["S3"] @ held).T @ (held - xi + tau * mean)
    return grown + memory + jump + he(motion) + he(average)


def summands(
    point: Mapping[str, np.ndarray], held: np.ndarray, slope: np.ndarray, h: Any, tau: Any, memory: Any
) -> tuple[Any, Any, Any]:
    """V_1, V_2, V_3 of (25) at the age `tau` of the sample for xi(s) = held + (s - t_k) slope, columns (n, 1).

    `memory` stands for the integral of exp(-2 alpha (t - s)) from t_k to t; a bound of it gives a bound of V_2.
    """
    xi, left = held + tau * slope, h - tau
    gap = held - xi
    sizes = [(x.T @ point[name] @ x)[0, 0] for name, x in (("P1", xi), ("P2", slope), ("P3", gap))]
    return sizes[0], left * memory * sizes[1], left * sizes[2]


def _selectors(n: int, exact: bool) -> list[np.ndarray]:
    one = rational.identity(4 * n) if exact else np.eye(4 * n)
    return [one[k * n : (k + 1) * n] for k in range(4)]


def some_point(n: int, seed: int = 0) -> dict[str, np.ndarray]:
    """P_1 ... S_3 with small random integers over 7, P symmetric: generic, not definite."""
    rng = np.random.default_rng(seed)
    out = {}
    for name in ("P1", "P2", "P3", "T1", "T2", "S1", "S2", "S3"):
        M = rational.matrix(rng.integers(-9, 10, (n, n)).tolist()) * fmpq(1, 7)
        out[name] = M + M.T if name.startswith("P") else M
    return out


def trajectory_gap(data: Any, faults: str, tau: float = 0.3) -> float:
    """abs(V' + 2 alpha V - zeta'Pi zeta + gap of Jensen's step) on an exact trajectory, relative to the terms.

    The derivative is taken by Richardson's rule on V, whose memory term is integrated by Gauss points; float.
    """
    from recontrol.systems.sampled import monodromy

    from . import conditions as c
    from .sweeps import floats

    v = floats(data, "")
    A, G, h, alpha, xi0 = v["A_print"], v["B"] @ v["K"], v["h"], v["alpha"], v["xi0"][:, 0]
    rng = np.random.default_rng(1)
    point = {name: rng.normal(size=(9, 9)) for name in c.UNKNOWNS}
    point |= {name: point[name] @ point[name].T for name in ("P1", "P2", "P3")}
    nodes, weights = np.polynomial.legendre.leggauss(20)

    def slope(s: float) -> np.ndarray:
        return A @ (monodromy(A, G, s) @ xi0) + G @ xi0

    def memory(t: float, rate: float) -> float:
        ages = t * (1 + nodes) / 2
        values = [slope(s) @ point["P2"] @ slope(s) * np.exp(-2 * rate * (t - s)) for s in ages]
        return float(t / 2 * weights @ np.array(values))

    def V(t: float) -> float:
        xi = monodromy(A, G, t) @ xi0
        return float(xi @ point["P1"] @ xi + (h - t) * (memory(t, alpha) + (xi0 - xi) @ point["P3"] @ (xi0 - xi)))

    steps = [0.02 / 2**k for k in range(4)]
    table = [(V(tau + s) - V(tau - s)) / (2 * s) for s in steps]
    for order in (1, 2, 3):
        table = [(4**order * b - a) / (4**order - 1) for a, b in itertools.pairwise(table)]
    xi, mean = monodromy(A, G, tau) @ xi0, (monodromy(A, G, tau) @ xi0 - xi0) / tau
    zeta = np.concatenate([xi, slope(tau), xi0, mean])
    decay = float(np.exp(-2 * alpha * tau))
    Pi = c.block(c.functional(**point, A=A, B=v["B"], K=v["K"], h=h, alpha=alpha, tau=tau, decay=decay, faults=faults))
    jensen = memory(tau, alpha) - decay * tau * float(mean @ point["P2"] @ mean)
    left, right = table[0] + 2 * alpha * V(tau), float(zeta @ Pi @ zeta) - jensen
    return abs(left - right) / max(abs(left), abs(right), float(zeta @ zeta))
