"""The matrix inequalities of this paper's analysis, each written once.

The paper prints none. States, input and time are left in the paper's own units, all of order one; the smallest number
is the pitch coefficient 7.1138e-3.
"""

from __future__ import annotations

from typing import Any

from recontrol.lmi.blocks import block, he, nonnegative, positive, trace


@nonnegative
def lqr(P: Any, A: Any, B: Any, Q: Any, R: Any) -> Any:
    """[A'P + PA + Q, PB; B'P, R] >= 0: P (n, n) underestimates the optimal cost x'Px of (17)."""
    return block([[he(P @ A) + Q, P @ B], [R]])


def cost(P: Any) -> Any:
    """tr P, maximised over `lqr`: the optimal cost summed over the unit initial states."""
    return trace(P)


@nonnegative
def dual(Z: Any) -> Any:
    """Z >= 0, (n + 1, n + 1): second moment of state and input along a trajectory."""
    return Z


def dual_balance(Z11: Any, Z12: Any, A: Any, B: Any, identity: Any) -> Any:
    """A Z11 + Z11 A' + B Z12' + Z12 B' + I = 0."""
    return he(A @ Z11) + he(B @ Z12.T) + identity


@positive
def energy(P: Any) -> Any:
    """P > 0."""
    return P


@positive
def decay(P: Any, M: Any) -> Any:
    """-(M'P + PM) > 0: with `energy`, every eigenvalue of M (n, n) has a negative real part."""
    return -he(P @ M)


@positive
def box(P: Any, T: Any, M0: Any, E: Any, F: Any) -> Any:
    """[-(M0'P + PM0) - F'TF, -PE; -E'P, T] > 0 for a diagonal T.

    With `energy`, M0 + sum_k d_k E_k F_k is stable for all abs(d_k) <= 1, E_k the columns of E and F_k the rows of F.
    """
    return block([[-he(P @ M0) - F.T @ T @ F, -(P @ E)], [T]])
