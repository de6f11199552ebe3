r"""Minimal solutions of the positive quadratic Riccati equation, enclosed from both sides.

.. math:: R(P) = A'P + PA + Q + PSP = 0, \qquad Q \ge 0,\ S \ge 0,\ A\ \text{Hurwitz}.

Bounded-real inequalities with a fixed gain reduce to this form, and the least value of a trace objective over them is
attained at its minimal solution, so it is the oracle for the semidefinite programs. Two facts make it rigorous:

* every P with ``R(P) < 0`` is feasible, so it bounds the infimum from above;
* if ``R(P_) > 0`` and ``A + S P_`` is Hurwitz, then ``P_ <= P`` for every P with ``R(P) <= 0``: their difference D
  satisfies ``(A + S P_)'D + D(A + S P_) >= D S D >= 0``.

Source: Lancaster and Rodman, Algebraic Riccati Equations (1995), chapter 9 (comparison theorems, Newton's method).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import exact_midpoint, midpoint, precision, to_ball
from recontrol.exact.linalg import SingularError, is_positive_definite, lyapunov
from recontrol.exact.rational import from_float, identity

SHIFT = fmpq(1, 10**12)


class NoSolutionError(ValueError):
    """Newton's iteration does not converge: the equation has no (stabilising) solution, or it is too near the limit."""


@dataclass(frozen=True)
class RiccatiBounds:
    """``lower <= P <= upper`` for the minimal solution P; exact symmetric matrices (n, n), both proven."""

    lower: np.ndarray
    upper: np.ndarray

    def trace(self, C: np.ndarray) -> arb:
        """Ball that contains the least ``Tr(C P C')`` over all feasible P."""
        low, high = (np.trace(C @ P @ C.T) for P in (self.lower, self.upper))
        return arb(low).union(arb(high))


def residual(A: np.ndarray, Q: np.ndarray, S: np.ndarray, P: np.ndarray) -> np.ndarray:
    """``A'P + PA + Q + PSP`` for symmetric P, symmetric as stored."""
    half = A.T @ P
    value = half + half.T + Q + P @ S @ P
    return (value + value.T) * fmpq(1, 2)


def minimal_solution(
    A: np.ndarray, Q: np.ndarray, S: np.ndarray, *, bits: int = 160, iterations: int = 120
) -> np.ndarray:
    """Approximate minimal solution (n, n) by Newton's method, as exact dyadic matrix; not a proof.

    Parameters: object arrays of fmpq or arb, all (n, n); balls enter with their midpoints. The start is the solution in
    doubles where it is stabilising, else zero. From there the iterates rise monotonically, linearly by halves when the
    solution is nearly not stabilising, quadratically otherwise. Raises NoSolutionError.
    """
    with precision(bits):
        A, Q, S = (exact_midpoint(M) for M in (A, Q, S))
        A, Q, S = to_ball(A), to_ball((Q + Q.T) * fmpq(1, 2)), to_ball((S + S.T) * fmpq(1, 2))
        P = to_ball(_start(A, Q, S))
        last = None
        for _ in range(iterations):
            try:
                new = to_ball(exact_midpoint(lyapunov((A + S @ P).T, _symmetric(Q - P @ S @ P))))
            except SingularError as error:
                raise NoSolutionError("Newton's iteration met a singular Lyapunov equation") from error
            size = max(abs(float(x)) for x in new.flat)
            step = max(abs(float(x)) for x in (new - P).flat)
            if not np.isfinite(size) or float(np.min([float(x) for x in np.diag(new)])) < 0:
                raise NoSolutionError("Newton's iteration left the positive semidefinite matrices")
            P = new
            if last is not None and step <= 2.0 ** (-bits // 2) * size:
                return exact_midpoint((P + P.T) * fmpq(1, 2))
            last = step
    raise NoSolutionError(f"Newton's iteration did not converge in {iterations} steps (last step {last:.1e})")


def _start(A: np.ndarray, Q: np.ndarray, S: np.ndarray) -> np.ndarray:
    """The minimal solution in doubles, exact as they stand, if it is positive and stabilising; else zero."""
    try:
        a, q, s = (midpoint(M) for M in (A, Q, S))
        P = float_minimal_solution(a, q, s)
        if np.linalg.eigvalsh(P)[0] >= 0 and np.linalg.eigvals(a + s @ P).real.max() < 0:
            return from_float(P)
    except (NoSolutionError, np.linalg.LinAlgError, ValueError, OverflowError):
        pass
    return np.array([[fmpq(0)] * len(A)] * len(A), dtype=object)


def _symmetric(M: np.ndarray) -> np.ndarray:
    mid = exact_midpoint(M)
    return to_ball((mid + mid.T) * fmpq(1, 2))


def bounds(A: np.ndarray, Q: np.ndarray, S: np.ndarray, *, shift: fmpq = SHIFT, bits: int = 160) -> RiccatiBounds:
    """Proven bounds of the minimal solution, from the equations with Q moved by ``shift (1 + max|Q|) I`` either way.

    Parameters: as `minimal_solution`; for balls the bounds hold for every matrix of the box (choose ``shift`` above its
    effect). Raises NoSolutionError if a side cannot be proven.
    """
    from recontrol.systems.stability import is_hurwitz

    scale = fmpq(1) + max(abs(exact_midpoint(q)) for q in np.ravel(Q))
    offset = identity(len(A)) * (shift * scale)
    upper = minimal_solution(A, Q + offset, S, bits=bits)
    lower = minimal_solution(A, Q - offset, S, bits=bits)
    with precision(bits):
        if not is_positive_definite(-to_ball(residual(A, Q, S, upper))):
            raise NoSolutionError("the upper bound is not proven: R(P) is not negative definite")
        if not is_positive_definite(to_ball(residual(A, Q, S, lower))) or not is_hurwitz(A + S @ lower):
            raise NoSolutionError("the lower bound is not proven")
    return RiccatiBounds(lower, upper)


def float_minimal_solution(A: np.ndarray, Q: np.ndarray, S: np.ndarray) -> np.ndarray:
    """Minimal solution (n, n) in doubles, from the stable invariant subspace of the Hamiltonian matrix.

    An independent route for tests and plots. Raises NoSolutionError if eigenvalues lie on the imaginary axis.
    """
    from scipy.linalg import schur

    n = len(A)
    hamiltonian: Any = np.block([[A, S], [-Q, -A.T]])
    _, basis, stable = schur(hamiltonian, sort="lhp")
    if stable != n:
        raise NoSolutionError(f"expected {n} stable eigenvalues of the Hamiltonian matrix, found {stable}")
    P = np.linalg.solve(basis[:n, :n].T, basis[n:, :n].T).T
    return (P + P.T) / 2
