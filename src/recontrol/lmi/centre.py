r"""Analytic centre of a set of affine matrix inequalities: the maximiser of ``log det`` of the slacks.

The centre is unique where the set is bounded, so it is a canonical choice where a solver's own point is not: any
correct method gives the same digits. Source: Boyd and Vandenberghe, Convex Optimization, sections 8.5.3 and 9.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

Array = np.ndarray


class Centre(NamedTuple):
    """The centre x (m,), the squared Newton decrement reached, and the number of Newton steps."""

    x: Array
    decrement: float
    steps: int


def analytic_centre(
    constants: Sequence[Array],
    coefficients: Sequence[Array],
    start: Array,
    *,
    tolerance: float = 1e-16,
    limit: int = 200,
) -> Centre:
    r"""Maximise ``sum_k log det (M_0k + sum_i x_i M_ik)`` by damped Newton steps.

    Parameters
    ----------
    constants : the M_0k (n_k, n_k)
    coefficients : for each k the array (m, n_k, n_k) of the M_ik
    start : (m,), a strictly feasible point
    tolerance : stop when the squared Newton decrement is below it

    Raises
    ------
    ValueError
        If the start is not strictly feasible, or the decrement does not get there (the set may be unbounded).
    """
    x = np.array(start, dtype=float)
    for step in range(limit):
        gradient, hessian = _derivatives(constants, coefficients, x)
        direction = np.linalg.solve(hessian, gradient)
        decrement = float(gradient @ direction)
        if decrement < tolerance:
            return Centre(x, decrement, step)
        # Damping keeps the iterate feasible (self-concordance); full steps once Newton converges quadratically.
        x = x + direction / (1 + np.sqrt(decrement) if decrement > 0.06 else 1.0)
    raise ValueError(f"no centre after {limit} Newton steps: squared decrement {decrement:.3g}, wanted {tolerance:.3g}")


def _derivatives(constants: Sequence[Array], coefficients: Sequence[Array], x: Array) -> tuple[Array, Array]:
    """Gradient and negated Hessian of the sum of log det."""
    m = len(x)
    gradient, hessian = np.zeros(m), np.zeros((m, m))
    for M0, M in zip(constants, coefficients, strict=True):
        try:
            root = np.linalg.cholesky(M0 + np.tensordot(x, M, 1))
        except np.linalg.LinAlgError:
            raise ValueError("the point is not strictly feasible: a slack matrix is not positive definite") from None
        inverse = np.linalg.inv(root)
        W = inverse @ M @ inverse.T
        gradient += np.trace(W, axis1=1, axis2=2)
        flat = W.reshape(m, -1)
        hessian += flat @ flat.T
    return gradient, hessian
