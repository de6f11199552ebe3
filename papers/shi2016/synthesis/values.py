"""Least rho of the printed problems: for the published gains, and along a family that drives it to zero."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import precision, to_ball
from recontrol.exact.rational import decimal, diagonal, from_float, identity, zeros

from .. import plant, problems, riccati

LEVELS = ("1.0001", "1.001", "1.01", "1.1", "2", "10", "100", "1000")
"""g = gamma_inf / z_weight."""

SOLVED_LEVELS = ("1.001", "1.01", "1.1", "2", "10", "100")
"""Where the semidefinite program is solved too; nearer to the limit and far above it, solvers lose digits."""


def fixed_gain(data: Any) -> dict[str, Any]:
    """Per gain: ``h2_squared`` and, per kind and level g, ``rho`` (ball, Riccati) and ``solved`` (CLARABEL), SI
    units."""
    return {gain: _fixed(data, gain) for gain in plant.GAINS}


def _fixed(data: Any, gain: str) -> dict[str, Any]:
    scaled, K = plant.scaled(data, plant.orbital_rate(data), gain), plant.scaled_gain(data, gain)
    with precision(plant.BITS):
        h2 = riccati.h2_squared(scaled, K) * plant.scale_factors(data, gain)["h"]
    out: dict[str, Any] = {"h2_squared": h2, "levels": np.array([float(g) for g in LEVELS])}
    for kind in riccati.KINDS:
        unit = riccati.unit_of(data, kind, gain)
        rho = [_ball(riccati.least_rho(scaled, K, kind, decimal(g)) * unit) for g in LEVELS]
        solved = {}
        for g in SOLVED_LEVELS:
            answer = problems.fixed(data, gain, kind, decimal(g)).solve()
            value = None if answer.value is None else answer.value * float(arb(unit))
            solved[g] = {"value": value, "outcome": answer.outcome, "words": answer.words}
        out[kind] = {"rho": np.array(rho, dtype=object), "solved": solved}
    return out


def _ball(value: Any) -> arb:
    return to_ball(value)


FAMILY = ("1", "1e-2", "1e-4", "1e-6")
FAMILY_LEVEL = "1.01"


def vanishing(data: Any) -> dict[str, Any]:
    """The family V_k = -[k I, 1.05 sqrt(2 k J_i)] at g = 1.01: rho_prt, rho_trad, h2 in SI units, and what solvers say.

    V = K + low makes the loop three double integrators, so the orbital rate drops out. Stiffness k [N m/rad].
    """
    members = {k: _member(data, decimal(k)) for k in FAMILY}
    level = decimal(FAMILY_LEVEL)
    free = {"extended": problems.extended(data, level), "traditional": problems.traditional(data, level)}
    words = {
        name: {solver: problem.solve(solver, time_limit=20).record() for solver in ("CLARABEL", "CVXOPT", "SDPA")}
        for name, problem in free.items()
    }
    return {"k": np.array([float(k) for k in FAMILY]), "members": members, "solvers": words}


def _member(data: Any, k: fmpq) -> dict[str, Any]:
    inertia = plant.inertias(data)
    damping = [from_float(1.05 * float(np.sqrt(2 * float(k) * float(j)))) for j in inertia]
    frequency, torque = from_float(float(np.sqrt(float(k) / 15))), k
    state = diagonal([fmpq(1)] * 3 + [1 / frequency] * 3)
    back = diagonal([fmpq(1)] * 3 + [frequency] * 3)
    B = np.vstack([zeros(3), diagonal([1 / j for j in inertia])])
    A = np.vstack([np.hstack([zeros(3), identity(3)]), zeros(3, 6)])
    V = -np.hstack([identity(3) * k, diagonal(damping)])
    scaled = {
        "A": state @ A @ back * (1 / frequency),
        "B1": state @ B * (torque / frequency),
        "B2": state @ B * (torque / frequency),
        "C1": zeros(3, 6),
        "C2": np.hstack([identity(3), zeros(3)]),
    }
    K = V @ back * (1 / torque)
    h, level = frequency / torque**2, decimal(FAMILY_LEVEL)
    h8 = h / data["z_weight"]
    with precision(plant.BITS):
        return {
            "rho_prt": riccati.least_rho(scaled, K, "prt", level) * (1 / h8),
            "rho_trad": riccati.least_rho(scaled, K, "trad", level) * h8,
            "h2": (riccati.h2_squared(scaled, K) * h).sqrt(),
        }
