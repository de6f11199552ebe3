"""The matrix inequalities of the paper, each written once; printed and derived blocks differ by a switch.

The derived blocks follow from the functional (24), (25) and the zero terms (36); `faults` names where the print (23),
(41) departs from them, so that the printed blocks are the derived ones with all six faults. Variables: P_1, P_2, P_3
symmetric, T_1, T_2, S_1, S_2, S_3 full, all (n, n). `decay` stands for exp(-2 alpha h): a rational bound on the safe
side keeps a proof exact. Rows belong to xi, its derivative, xi(t_k) and the mean derivative phi.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.lmi.blocks import block, equal, eye, he, negative, nonnegative, positive

FAULTS = {
    "sign-P3": "block 12: -(h - tau) P3 for +(h - tau) P3",
    "no-AT2": "block 12: A'T2 is missing",
    "no-S2": "block 12: S2 is missing",
    "no-S3": "block 13: S3 is missing",
    "S2-twice": "block 23: S2 + S2' for S2'",
    "no-Pi24": "block 24: zero for tau S2'",
}
"""Where the print departs from the derivation: name -> what stands there."""
DERIVED, PRINTED = "", " ".join(FAULTS)
# In alphabetical order, as a certificate file lists them.
UNKNOWNS = ("P1", "P2", "P3", "S1", "S2", "S3", "T1", "T2")


def functional(
    P1: Any, P2: Any, P3: Any, T1: Any, T2: Any, S1: Any, S2: Any, S3: Any,
    A: Any, B: Any, K: Any, h: Any, alpha: Any, tau: Any, decay: Any, faults: str = DERIVED,
) -> list[list[Any]]:  # fmt: skip
    """Blocks (i, j), i <= j, of Pi at the age `tau` of the sample, as rows; `decay` is exp(-2 alpha tau).

    Raises ValueError for a fault that has no name.
    """
    wrong = set(faults.split())
    if unknown := wrong - set(FAULTS):
        raise ValueError(f"unknown fault {sorted(unknown)[0]!r}; there are {', '.join(FAULTS)}")
    left, BK = h - tau, B @ K
    age = 2 * alpha * left
    b11 = 2 * alpha * P1 - P3 + age * P3 - he(T1.T @ A) - he(S1)
    b12 = P1 + T1.T + (-left if "sign-P3" in wrong else left) * P3
    if "no-AT2" not in wrong:
        b12 = b12 - A.T @ T2
    if "no-S2" not in wrong:
        b12 = b12 - S2
    b13 = P3 - age * P3 - T1.T @ BK + S1.T
    if "no-S3" not in wrong:
        b13 = b13 - S3
    b22 = left * P2 + he(T2)
    b23 = -left * P3 - T2.T @ BK + S2.T
    if "S2-twice" in wrong:
        b23 = b23 + S2
    b24 = 0 if "no-Pi24" in wrong else tau * S2.T
    b33 = -P3 + age * P3 + he(S3)
    return [[b11, b12, b13, tau * S1.T], [b22, b23, b24], [b33, tau * S3.T], [-(decay * tau) * P2]]


def _without_last(rows: list[list[Any]]) -> list[list[Any]]:
    return [row[:-1] for row in rows[:-1]]


@negative
def phi(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults):
    """(21), first matrix (3n, 3n): tau = 0, the row of phi deleted."""
    return block(_without_last(functional(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, 0 * h, 1, faults)))


@negative
def phi_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults):
    """(21), second matrix (4n, 4n): tau = h."""
    return block(functional(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, h, decay, faults))


@negative
def thrust(P1, K, rho, u_max, axis):
    """(22) of one axis: rho K_i'K_i - u_max^2 P_1 (n, n)."""
    row = K[axis : axis + 1, :]
    return rho * (row.T @ row) - (u_max * u_max) * P1


@nonnegative
def initial_bound(P1, xi0, rho):
    """(47) at t_1 = 0, where V_2 and V_3 vanish: rho - xi0'P_1 xi0 (1, 1)."""
    return rho * eye(1) - xi0.T @ P1 @ xi0


@equal
def initial_value(P1, xi0, V0):
    """V(0) equal to a given number: xi0'P_1 xi0 - V0 (1, 1)."""
    return xi0.T @ P1 @ xi0 - V0 * eye(1)


def value_at_start(P1, xi0):
    """Objective V(0) = xi0'P_1 xi0 (1, 1)."""
    return xi0.T @ P1 @ xi0


def _with_exogenous(rows: list[list[Any]], T1: Any, T2: Any, B1: Any, C2: Any, gamma2: Any, schur: bool) -> Any:
    """(55): rows of Phi bordered by Gamma; with `schur` the block -I of z is eliminated, which is equivalent."""
    n, q, p = B1.shape[0], B1.shape[1], C2.shape[0]
    weight = -gamma2 * eye(q)
    columns = [-T1.T @ B1, -T2.T @ B1, *[0] * (len(rows) - 2)]
    if schur:
        first = [rows[0][0] + C2.T @ C2, *rows[0][1:]]
        out = [[*row, column] for row, column in zip([first, *rows[1:]], columns, strict=True)]
        return block([*out, [weight]])
    outputs = [C2.T, *[np.zeros((n, p), dtype=int)] * (len(rows) - 1)]
    out = [[*row, d, z] for row, d, z in zip(rows, columns, outputs, strict=True)]
    return block([*out, [weight, 0], [-eye(p)]])


@negative
def performance(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, zero, B1, C2, gamma2, faults, schur):
    """(55), first matrix (3n + q + p): Phi at alpha = 0 with the exogenous inputs (columns of `B1`) and z = C2 xi."""
    rows = _without_last(functional(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, zero, 0 * h, 1, faults))
    return _with_exogenous(rows, T1, T2, B1, C2, gamma2, schur)


@negative
def performance_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, zero, B1, C2, gamma2, faults, schur):
    """(55), second matrix (4n + q + p), with the fourth zero row of Gamma_2 that the print lacks."""
    rows = functional(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, zero, h, 1, faults)
    return _with_exogenous(rows, T1, T2, B1, C2, gamma2, schur)


@negative
def congruent_phi(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults, R):
    """R' Phi R < 0, which implies Phi < 0; a good R keeps the balls of a box of gains from growing in the proof."""
    return R.T @ phi(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults) @ R


@negative
def congruent_phi_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults, R):
    """R' Phi_hat R < 0."""
    return R.T @ phi_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults) @ R


@positive
def definite(P):
    """P > 0."""
    return P


@positive
def along_phi(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults, x):
    """A direction in which (21)'s first matrix is positive, so that it is not negative definite there."""
    return x.T @ phi(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults) @ x


@positive
def along_phi_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults, x):
    """The same for (21)'s second matrix."""
    return x.T @ phi_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults) @ x


@positive
def along_thrust(P1, K, rho, u_max, axis, factor, x):
    """The same for (22) with P_1 multiplied by `factor`."""
    return x.T @ thrust(factor * P1, K, rho, u_max, axis) @ x


# -- margins: the largest t by which the strict inequalities hold; `unit` (n, n) is the identity of the chosen units --


@nonnegative
def phi_margin(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults, t, unit):
    """-t I - Phi >= 0."""
    step = t * unit
    M = phi(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, faults)
    return -M - block([[step, 0, 0], [step, 0], [step]])


@nonnegative
def phi_hat_margin(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults, t, unit):
    """-t I - Phi_hat >= 0."""
    step = t * unit
    M = phi_hat(P1, P2, P3, T1, T2, S1, S2, S3, A, B, K, h, alpha, decay, faults)
    return -M - block([[step, 0, 0, 0], [step, 0, 0], [step, 0], [step]])


@nonnegative
def definite_margin(P, t, unit):
    """P - t I >= 0."""
    return P - t * unit


@nonnegative
def thrust_margin(P1, K, rho, u_max, axis, t, unit):
    """P_1 - (rho / u_max^2) K_i'K_i - t I >= 0."""
    return -(thrust(P1, K, rho, u_max, axis) * (1 / (u_max * u_max))) - t * unit


def margin(t):
    """Objective t."""
    return t


def weight(gamma2):
    """Objective gamma^2."""
    return gamma2


# -- beyond the paper: the functional with a constant double integral, and the synthesis that the paper lacks --------


@negative
def time_independent(P, R, T1, T2, T3, A, B, K, h):
    """Input-delay condition (3n, 3n) of the functional xi'P xi + h * double integral of xi_dot'R xi_dot.

    Source: E. Fridman, A. Seuret, J.-P. Richard, Automatica 40 (2004), with free matrices for xi, xi_dot, xi(t_k).
    """
    BK = B @ K
    return block(
        [
            [-R - he(T1.T @ A), P + T1.T - A.T @ T2, R - T1.T @ BK - A.T @ T3],
            [h * h * R + he(T2), -T2.T @ BK + T3],
            [-R - he(T3.T @ BK)],
        ]
    )


def _synthesis(P1, P2, P3, S1, S2, S3, X, Y, A, B, h, alpha, tau, decay, slope):
    left = h - tau
    age = 2 * alpha * left
    b11 = 2 * alpha * P1 - P3 + age * P3 + he(A @ X) - he(S1)
    b12 = P1 + left * P3 - X + slope * (X.T @ A.T) - S2
    b13 = P3 - age * P3 + B @ Y + S1.T - S3
    b22 = left * P2 - slope * he(X)
    b23 = -left * P3 + slope * (B @ Y) + S2.T
    b33 = -P3 + age * P3 + he(S3)
    return [[b11, b12, b13, tau * S1.T], [b22, b23, tau * S2.T], [b33, tau * S3.T], [-(decay * tau) * P2]]


@negative
def synthesis(P1, P2, P3, S1, S2, S3, X, Y, A, B, h, alpha, slope):
    """Derived (21), first matrix, after T1 = -X^-1, T2 = slope T1, congruence by X and Y = K X."""
    return block(_without_last(_synthesis(P1, P2, P3, S1, S2, S3, X, Y, A, B, h, alpha, 0 * h, 1, slope)))


@negative
def synthesis_hat(P1, P2, P3, S1, S2, S3, X, Y, A, B, h, alpha, decay, slope):
    """Derived (21), second matrix, in the same variables."""
    return block(_synthesis(P1, P2, P3, S1, S2, S3, X, Y, A, B, h, alpha, h, decay, slope))


@nonnegative
def synthesis_thrust(P1, Y, u2, axis):
    """[P1, Y_i'; Y_i, u^2] >= 0: |u_i| <= u on the set xi'X^-T P1 X^-1 xi <= 1."""
    row = Y[axis : axis + 1, :]
    return block([[P1, row.T], [u2 * eye(1)]])


@nonnegative
def synthesis_start(P1, X, xi0):
    """[1, xi0'; xi0, X + X' - P1] >= 0: the initial state lies in that set, since X P1^-1 X' >= X + X' - P1."""
    return block([[eye(1), xi0.T], [he(X) - P1]])
