"""Integral and stationary costs of stable linear systems from Lyapunov equations.

In: a Hurwitz matrix with outputs, initial states or noise. Out: infinite-horizon costs without a sum over time.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import solve_continuous_lyapunov

from recontrol.systems.stability import UnstableError
from recontrol.systems.statespace import StateSpace, spectral_abscissa

Array = NDArray[np.float64]


def _require_stable(A: Array) -> None:
    abscissa = spectral_abscissa(A)
    if not abscissa < 0:
        raise UnstableError(f"the state matrix has spectral abscissa {abscissa:.3g}, expected a negative one")


def observability_gramian(A: ArrayLike, C: ArrayLike) -> Array:
    """W with ``A' W + W A + C' C = 0``; ``x0' W x0`` is the integral of ``abs(C x)^2`` from x0."""
    a, c = np.asarray(A, dtype=float), np.atleast_2d(np.asarray(C, dtype=float))
    _require_stable(a)
    return solve_continuous_lyapunov(a.T, -c.T @ c)


def covariance(A: ArrayLike, W: ArrayLike) -> Array:
    """Stationary covariance X of ``x' = A x + w``, intensity W: ``A X + X A' + W = 0``."""
    a = np.asarray(A, dtype=float)
    _require_stable(a)
    return solve_continuous_lyapunov(a, -np.asarray(W, dtype=float))


def integral_square(A: ArrayLike, C: ArrayLike, x0: ArrayLike) -> Array:
    """Integral of ``abs(C x)^2`` over 0..inf for each initial state; x0 is (n,) or (n, batch)."""
    W = observability_gramian(A, C)
    states = np.asarray(x0, dtype=float)
    return np.einsum("i...,ij,j...->...", states, W, states)


def noise_cost(system: StateSpace) -> float:
    """``E[abs(y)^2]`` of a stable system driven by unit white noise; inf if the noise reaches y directly."""
    if np.any(system.D):
        return math.inf
    X = covariance(system.A, system.B @ system.B.T)
    return float(np.trace(system.C @ X @ system.C.T))
