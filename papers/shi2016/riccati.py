"""Least rho of the fixed-gain problems from Riccati equations, enclosed in balls: no semidefinite program is involved.

In scaled units D1 = D2 = I and C = C1 + K. With c = g^2 - 1 and At = Acl + B2 C / c, the Schur complement of (8) is
``At X + X At' + (g/c)(B2 B2' + X C'C X) < 0``; `brl_std` differs in the weights, Theorem 2 uses X^{-1}.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import precision, to_ball
from recontrol.systems.riccati import SHIFT, bounds

from . import plant

KINDS = ("trad", "std", "prt")


def least_rho(matrices: dict[str, np.ndarray], K: np.ndarray, kind: str, g: fmpq, shift: fmpq = SHIFT) -> arb:
    """Infimum of rho in scaled units. Raises NoSolutionError if g is not above the scaled H-infinity norm."""
    weights = {"trad": (g, g), "std": (g * g, fmpq(1)), "prt": (g, g)}[kind]
    with precision(160):
        closed, source, feedback = (to_ball(M) for M in bounded_real(matrices, K, g, weights))
        if kind == "prt":
            found = bounds(closed, feedback, source, shift=shift)
        else:
            found = bounds(closed.T, source, feedback, shift=shift)
        return found.trace(matrices["C2"])


def bounded_real(
    matrices: dict[str, np.ndarray], K: np.ndarray, g: fmpq, weights: tuple[fmpq, fmpq] | None = None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """At, w1/c B2 B2' and w2/c C'C of the head of this module, scaled units; ``weights`` w1, w2 are g, g for (8)."""
    first, second = weights or (g, g)
    B, C, excess = matrices["B2"], matrices["C1"] + K, g * g - 1
    closed = plant.closed_loop(matrices, K) + B @ C * (1 / excess)
    return closed, B @ B.T * (first / excess), C.T @ C * (second / excess)


def unit_of(data: Any, kind: str, name: str) -> fmpq:
    """Factor from scaled to printed rho, which is in SI units (see `plant.scale_factors`)."""
    factors = plant.scale_factors(data, name)
    return {"trad": factors["h8"], "std": factors["h"], "prt": 1 / factors["h8"]}[kind]


def h2_squared(matrices: dict[str, np.ndarray], K: np.ndarray) -> arb:
    """Squared H2 norm from d to z2, same units as `matrices`."""
    from recontrol.systems.norms import h2_norm

    return h2_norm(plant.closed_loop(matrices, K), matrices["B2"], matrices["C2"], bits=plant.BITS) ** 2


def effort_squared(matrices: dict[str, np.ndarray], K: np.ndarray) -> arb:
    """Squared H2 norm from d to u = Kx."""
    from recontrol.systems.norms import h2_norm

    return h2_norm(plant.closed_loop(matrices, K), matrices["B2"], K, bits=plant.BITS) ** 2
