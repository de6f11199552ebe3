"""Robustness against normalised coprime factor uncertainty: the radius of a loop and the best one of a plant.

In: a single-input single-output plant and compensator with ``u = +K y``. Out: the radius b and where it is attained.
Source: McFarlane and Glover, Robust Controller Design Using Normalized Coprime Factor Plant Descriptions (1990).
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_continuous_are

from recontrol.systems.margins import UnstableLoopError, minimise_over_frequency
from recontrol.systems.statespace import StateSpace, transfer_function

Array = NDArray[np.floating[Any]]


class Radius(NamedTuple):
    """b in 0..1 and the frequency [rad/s] at which the loop is closest to instability (inf allowed)."""

    value: float
    frequency: float


def coprime_radius(plant: StateSpace, compensator: StateSpace) -> Radius:
    r"""Smallest relative perturbation of a normalised coprime factorisation that can destabilise the loop.

    .. math:: b = \min_\omega |1 - p k| / \sqrt{(1 + |k|^2)(1 + |p|^2)}

    evaluated from numerators and denominators, so poles on the imaginary axis are ordinary points.

    Raises
    ------
    UnstableLoopError
        If the loop is not stable (its radius is 0).
    """
    (bp, ap), (bk, ak) = transfer_function(plant), transfer_function(compensator)
    closed = np.polysub(np.polymul(ap, ak), np.polymul(bp, bk))
    poles = np.roots(closed)
    if np.max(poles.real) >= 0:
        raise UnstableLoopError("the loop is not stable: its coprime radius is 0")

    def ratio(w: Array) -> Array:
        s = 1j * w
        weights = [np.hypot(np.abs(np.polyval(n, s)), np.abs(np.polyval(d, s))) for n, d in ((bp, ap), (bk, ak))]
        return np.abs(np.polyval(closed, s)) / (weights[0] * weights[1])

    roots = [np.roots(p) for p in (ap, bp, ak, bk)]
    value, frequency = minimise_over_frequency(ratio, np.concatenate([poles, *roots]))
    direct = abs(compensator.D[0, 0])
    at_infinity = 1 / math.hypot(1.0, direct)  # a strictly proper plant: p -> 0, k -> D
    return Radius(at_infinity, math.inf) if at_infinity < value else Radius(value, frequency)


def best_coprime_radius(plant: StateSpace) -> float:
    """Largest radius that any compensator can give: ``(1 + lambda_max(X Z))^-1/2`` for a strictly proper plant.

    X and Z are the stabilising solutions of the control and filter Riccati equations with unit weights.
    """
    A, B, C, _ = plant
    X = solve_continuous_are(A, B, C.T @ C, np.eye(B.shape[1]))
    Z = solve_continuous_are(A.T, C.T, B @ B.T, np.eye(C.shape[0]))
    return float(1 / math.sqrt(1 + np.max(np.linalg.eigvals(X @ Z).real)))
