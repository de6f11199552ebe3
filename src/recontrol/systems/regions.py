r"""Disk pole regions ``D(a, b)``: centre ``-a``, radius ``b``.

The poles of A lie in D(a, b) if and only if some P > 0 has ``(A + aI)' P (A + aI) - b^2 P < 0`` (a Stein inequality for
``(A + aI) / b``; Chilali and Gahinet, IEEE TAC 41, 1996). For a box of matrices one P that serves all of it is a proof.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact.ball import midpoint, precision, to_ball
from recontrol.exact.linalg import is_positive_definite
from recontrol.exact.rational import from_float, identity, rational, symmetric_part

Array = np.ndarray


def disk_radius(poles: Array, centre: float) -> Array:
    """Largest distance of the poles (..., n) from ``-centre``."""
    return np.abs(np.asarray(poles) + centre).max(axis=-1)


def stein_matrix(A: Array, centre: Any, radius: Any) -> Array:
    """P (n, n) with ``Ad' P Ad - P = -I`` for ``Ad = (A + centre I) / radius``, for a float matrix A.

    Raises ValueError if the poles are not in the disk.
    """
    from scipy.linalg import solve_discrete_lyapunov

    Ad = (A + float(centre) * np.eye(len(A))) / float(radius)
    if np.abs(np.linalg.eigvals(Ad)).max() >= 1:
        raise ValueError(f"the poles are not all within {float(radius):g} of {-float(centre):g}")
    P = solve_discrete_lyapunov(Ad.T, np.eye(len(A)))
    return (P + P.T) / 2


def prove_in_disk(A: Array, centre: Any, radius: Any, *, bits: int = 200) -> Array | None:
    """Exact P that proves every matrix of the box A (object array of balls or rationals) to have its poles in the disk.

    ``centre`` and ``radius`` are exact (int, fmpq, decimal text). P comes from the float Stein equation of the midpoint
    and is then checked in balls; None means "not proven" (the box may still lie in the disk).
    """
    a, r = rational(centre), rational(radius)
    try:
        P = symmetric_part(from_float(stein_matrix(midpoint(A), float(midpoint(a)), float(midpoint(r)))))
    except ValueError:
        return None
    return P if verify_in_disk(A, P, a, r, bits=bits) else None


def shifted_gap(A: Array, P: Array, centre: Any, radius: Any) -> Array:
    """``radius^2 P - (A + centre I)' P (A + centre I)`` in balls at the present precision."""
    a, r = rational(centre), rational(radius)
    shifted = to_ball(A) + identity(len(A)) * a
    return to_ball(P * (r * r) - shifted.T @ P @ shifted)


def verify_in_disk(A: Array, P: Array, centre: Any, radius: Any, *, bits: int = 200) -> bool:
    """Whether ``P > 0`` and `shifted_gap` > 0 for every matrix of the box, by L D L' in balls."""
    with precision(bits):
        return is_positive_definite(P) and is_positive_definite(shifted_gap(A, P, centre, radius))
