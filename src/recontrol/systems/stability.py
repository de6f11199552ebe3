"""Eigenvalues and stability: by eigenvalues for float arrays, proven for every matrix of a box of balls."""

from __future__ import annotations

import numpy as np
from flint import acb, acb_mat

from recontrol.exact.ball import exact_midpoint, midpoint, precision, to_ball
from recontrol.exact.linalg import SingularError, is_positive_definite, lyapunov
from recontrol.exact.rational import from_float, identity


class UnstableError(ValueError):
    """The system has an eigenvalue with real part >= 0: a norm or a cost over an infinite horizon does not exist."""


class UndecidedError(ValueError):
    """The balls are too wide, or the precision too low, to decide."""


def spectrum(A: np.ndarray, bits: int = 128) -> list[acb]:
    """Enclosures of the eigenvalues of an exact or ball matrix (n, n), multiplicities counted.

    Raises UndecidedError if they cannot be separated at this precision.
    """
    with precision(bits):
        try:
            return list(acb_mat(to_ball(A).tolist()).eig(multiple=True))
        except ValueError as error:
            raise UndecidedError(f"the eigenvalues cannot be enclosed at {bits} bits: {error}") from error


def is_hurwitz(A: np.ndarray, bits: int = 128) -> bool | None:
    """Whether every eigenvalue has a negative real part: for floats by eigenvalues, else proven for the whole box.

    True by a Lyapunov matrix that holds for every matrix of the box, False by an enclosed eigenvalue with positive real
    part, None if neither succeeds.
    """
    if A.dtype != object:
        return bool(np.linalg.eigvals(A).real.max() < 0)
    with precision(bits):
        if _lyapunov_proof(A) is not None:
            return True
        try:
            real_parts = [value.real for value in spectrum(A, bits)]
        except UndecidedError:
            return None
        return False if any(part > 0 for part in real_parts) else None


def _lyapunov_proof(A: np.ndarray) -> np.ndarray | None:
    """P > 0 with A'P + PA < 0 on the whole box, or None; the right-hand side is tried as I and in balanced units."""
    from scipy.linalg import matrix_balance

    _, (scale, _) = matrix_balance(midpoint(A), permute=False, separate=True)
    for weight in (np.ones(len(A)), scale**-2.0):
        try:
            P = exact_midpoint(lyapunov(to_ball(exact_midpoint(A)).T, identity(len(A)) * from_float(weight)))
        except SingularError:
            return None
        product = A.T @ P
        if is_positive_definite(P) and is_positive_definite(to_ball(-(product + product.T))):
            return P
    return None


def require_hurwitz(A: np.ndarray, bits: int = 128) -> None:
    """Raise UnstableError or UndecidedError unless ``A`` is Hurwitz (for balls: all of the box)."""
    stable = is_hurwitz(A, bits)
    if stable is None:
        raise UndecidedError("stability could not be decided for every matrix of the box")
    if not stable:
        raise UnstableError("the system matrix has an eigenvalue with non-negative real part")
