"""The LQR gain by routes of different kind, and an enclosure of its optimal cost, every axis.

Artifact, one entry per axis: ``K`` with one gain (1, n) per route, ``spread`` the largest deviation of each route from
the spectral factor, ``trace`` {"lower", "upper"}: rational bounds of tr P, each proven below, ``P`` the Riccati
solution in floats.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact.ball import exact_midpoint, midpoint
from recontrol.exact.linalg import is_positive_definite, lyapunov
from recontrol.exact.rational import identity, rounded, to_float, trace_product

from .. import recipe
from ..conditions import lqr as lqr_condition
from ..model import AXES

DECIMALS = 10
SLACK = fmpq(1, 10**9)


class EnclosureError(ArithmeticError):
    """A rounded witness does not prove its bound."""


def upper_bound(plant: recipe.Plant, Q: np.ndarray, K: np.ndarray) -> fmpq:
    """Cost tr(Z (Q + G'G)) of the rational gain G, K to ten decimals: an upper bound of tr P, exact.

    (A - BG) Z + Z (A - BG)' + I = 0. The gap to tr P is of second order in G - K.
    """
    G = rounded(exact_midpoint(K), DECIMALS)
    Z = lyapunov(plant.A - plant.B @ G, identity(plant.n))
    if not is_positive_definite(Z):
        raise EnclosureError("the rounded gain does not stabilise the plant")
    return trace_product(Q + G.T @ G, Z)


def lower_bound(plant: recipe.Plant, Q: np.ndarray) -> fmpq:
    """tr P of a rational P with [A'P + PA + Q, PB; B'P, R] > 0, exact.

    P is the float Riccati solution for Q - 1e-9 I, rounded.
    """
    from scipy.linalg import solve_continuous_are

    A, B = to_float(plant.A), to_float(plant.B)
    P = solve_continuous_are(A, B, to_float(Q) - float(SLACK) * np.eye(plant.n), np.eye(1))
    exact = rounded((P + P.T) / 2, DECIMALS + 4)
    if not is_positive_definite(lqr_condition(exact, plant.A, plant.B, Q, identity(1))):
        raise EnclosureError("the rounded Riccati solution does not satisfy the LQR inequality")
    return sum((exact[i, i] for i in range(plant.n)), fmpq(0))


def routes(plant: recipe.Plant) -> dict[str, np.ndarray]:
    """K by the Riccati equation and by a library's lqr (spectral factor: the artifact ``gains``)."""
    import control
    from scipy.linalg import solve_continuous_are

    A, B, Q = to_float(plant.A), to_float(plant.B), to_float(plant.C.T @ plant.C)
    return {
        "Riccati equation": B.T @ solve_continuous_are(A, B, Q, np.eye(1)),
        "control.lqr": np.asarray(control.lqr(A, B, Q, np.eye(1))[0]),
    }


def lqr(model: dict[str, Any]) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    return {axis: one_axis(recipe.plant_of(model, axis)) for axis in AXES}


def one_axis(plant: recipe.Plant) -> dict[str, Any]:
    """Routes, spread and enclosure of one axis."""
    from scipy.linalg import solve_continuous_are

    Q = plant.C.T @ plant.C
    K = recipe.controller_gain(plant)
    found = {"spectral factor": midpoint(K), **routes(plant)}
    spread = {name: float(np.abs(gain - found["spectral factor"]).max()) for name, gain in found.items()}
    return {
        "K": found,
        "spread": spread,
        "P": solve_continuous_are(to_float(plant.A), to_float(plant.B), to_float(Q), np.eye(1)),
        "trace": {"lower": lower_bound(plant, Q), "upper": upper_bound(plant, Q, K)},
    }
