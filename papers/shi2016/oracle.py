"""Least rho of the fixed-gain problems from Riccati equations, enclosed in balls: no semidefinite program is involved.

In scaled units D1 = D2 = I and C = C1 + K. With c = g^2 - 1 and At = Acl + B2 C / c, the Schur complement of (8) is
``At X + X At' + (g/c)(B2 B2' + X C'C X) < 0``; `brl_std` differs in the weights, Theorem 2 uses X^{-1}.
"""

from __future__ import annotations

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import precision, to_ball
from recontrol.systems import riccati

from . import plant

KINDS = ("trad", "std", "prt")


def least_rho(matrices: dict[str, np.ndarray], K: np.ndarray, kind: str, g: fmpq, shift: fmpq = riccati.SHIFT) -> arb:
    """Infimum of rho in scaled units. Raises NoSolutionError if g is not above the scaled H-infinity norm."""
    with precision(160):
        A, B, C2 = plant.closed_loop(matrices, K), matrices["B2"], matrices["C2"]
        C, excess = matrices["C1"] + K, g * g - 1
        closed = to_ball(A + B @ C * (1 / excess))
        source, feedback = B @ B.T, C.T @ C
        weights = {"trad": (g, g), "std": (g * g, fmpq(1)), "prt": (g, g)}[kind]
        if kind == "prt":
            found = riccati.bounds(closed, _times(feedback, g / excess), _times(source, g / excess), shift=shift)
        else:
            first, second = weights
            found = riccati.bounds(
                closed.T, _times(source, first / excess), _times(feedback, second / excess), shift=shift
            )
        return found.trace(C2)


def _times(M: np.ndarray, factor: fmpq) -> np.ndarray:
    return to_ball(M * factor)


def unit_of(kind: str, name: str) -> fmpq:
    """Factor from scaled to printed rho, which is in SI units (see `plant.scale_factors`)."""
    h = plant.scale_factors(name)["h"]
    return {"trad": 1000 * h, "std": h, "prt": 1 / (1000 * h)}[kind]


def h2_squared(matrices: dict[str, np.ndarray], K: np.ndarray) -> arb:
    """Squared H2 norm from d to z2, same units as `matrices`."""
    from recontrol.systems.norms import h2_norm

    return h2_norm(plant.closed_loop(matrices, K), matrices["B2"], matrices["C2"], bits=plant.BITS) ** 2


def effort_squared(matrices: dict[str, np.ndarray], K: np.ndarray) -> arb:
    """Squared H2 norm from d to u = Kx."""
    from recontrol.systems.norms import h2_norm

    return h2_norm(plant.closed_loop(matrices, K), matrices["B2"], K, bits=plant.BITS) ** 2
