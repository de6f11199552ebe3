"""The matrix inequalities of the paper, each written once.

tau = lambda^2. The rows that belong to W0 are scaled by lambda, so tau enters affinely, and the rows of e and W0 are
cut to the three that are not zero. ``W`` (3, 6) = [0 Xi_J]; the non-zero columns of E equal B. S, N define the
Lyapunov matrix P = [[Y, N], [N, -N]] with Y = S - N. The bodies of (13) and (17) did not survive in the text at hand
(NOTES, lmi-bodies).
"""

from __future__ import annotations

import numpy as np

from recontrol.lmi.blocks import block, eye, grid, negative, nonnegative, nonpositive, positive
from recontrol.systems.input_bound import covers, decay, level
from recontrol.systems.robust import scaled_disk, scaled_hinf


def _zero(rows, columns):
    return np.zeros((rows, columns), dtype=int)


def lyapunov(S, N):
    """P (12, 12) of the structured Lyapunov function in the controller's own coordinates."""
    return block([[S - N, N], [-N]])


@positive
def shape_S(S):
    """S > 0 (6, 6)."""
    return S


@negative
def shape_N(N):
    """N < 0 (6, 6)."""
    return N


@positive
def sign_tau(tau):
    """lambda^2 > 0."""
    return tau


@positive
def sign_D1(D1):
    """Multiplier of Delta H > 0 (12, 12), diagonal."""
    return D1


@positive
def sign_D2(D2):
    """Multiplier of the gain drift > 0 (12, 12), diagonal."""
    return D2


@negative
def eq12(P, tau, gamma2, *, A, B, C, W, a, b):
    """Lemma 3, (12), 36 rows: disk and H-infinity bound of one loop; A (12, 12), B (12, 3), C (3, 12), W (3, 12)."""
    return block(
        [
            [-(b * b / a) * P, -(P @ B), P @ B, tau * (A.T @ W.T), C.T, (A + a * eye(12)).T @ P],
            [-tau * eye(3), 0, -tau * (B.T @ W.T), 0, 0],
            [-gamma2 * eye(3), tau * (B.T @ W.T), 0, 0],
            [-tau * eye(3), 0, 0],
            [-eye(3), 0],
            [-a * P],
        ]
    )


@negative
def eq12_structured(S, N, tau, gamma2, *, A, B, C, W, a, b):
    """(12) with P = [[Y, N], [N, -N]] in the coordinates of the printed controller."""
    return eq12(lyapunov(S, N), tau, gamma2, A=A, B=B, C=C, W=W, a=a, b=b)


@negative
def eq12_convex(X, Y, Ah, Bh, Ch, tau, gamma2, *, A, B, C, W, a, b):
    """(12) after the change of variables of Scherer et al.; A (6, 6), B (6, 3), C (3, 6), W (3, 6)."""
    P = block([[X, eye(6)], [Y]])
    PB = grid([[B], [Y @ B]])
    AX = A @ X + B @ Ch
    PA = grid([[AX, A], [Ah, Y @ A + Bh @ C]])
    WA = tau * grid([[W @ AX, W @ A]])
    return block(
        [
            [-(b * b / a) * P, -PB, PB, WA.T, grid([[X @ C.T], [C.T]]), PA.T + a * P],
            [-tau * eye(3), 0, -tau * (B.T @ W.T), 0, 0],
            [-gamma2 * eye(3), tau * (B.T @ W.T), 0, 0],
            [-tau * eye(3), 0, 0],
            [-eye(3), 0],
            [-a * P],
        ]
    )


@negative
def eq12_convex_rigid(X, Y, Ah, Bh, Ch, gamma2, *, A, B, C, a, b):
    """`eq12_convex` without the inertia channel (rows of e and W0 dropped), 30 rows."""
    P = block([[X, eye(6)], [Y]])
    PA = grid([[A @ X + B @ Ch, A], [Ah, Y @ A + Bh @ C]])
    return block(
        [
            [-(b * b / a) * P, grid([[B], [Y @ B]]), grid([[X @ C.T], [C.T]]), PA.T + a * P],
            [-gamma2 * eye(3), 0, 0],
            [-eye(3), 0],
            [-a * P],
        ]
    )


def _body(S, N, F_a, F_b, C_f, tau, D1, D2, gamma2, coupling, *, A, B, C, L, K, W, a, b, delta_m):
    """81 rows of (13); ``coupling`` holds the two terms (C_f'B'S, C_f'B'Y) of block (1,5)."""
    Y, c, CC = S - N, b * b / a, C.T @ C
    SB, YB = S @ B, Y @ B
    corner = block([[CC - c * S, CC - c * S], [CC - c * Y]])
    inputs = grid([[SB], [YB]])
    link = A.T @ S + a * S
    right = A.T @ Y + C.T @ F_b.T
    shifted = grid([[link + coupling[0], right + F_a.T + a * S + coupling[1]], [link, right + a * Y]])
    derivative = tau * grid([[(A + B @ C_f).T @ W.T], [A.T @ W.T]])
    drift_in = grid([[eye(6), C.T, C_f.T], [0, C.T, 0]]) @ D2
    drift_W = grid([[_zero(3, 9), (tau * delta_m) * (W @ B)]])
    drift_P = delta_m * grid([[0, 0, SB], [F_a, F_b, YB]])
    return block(
        [
            [corner, -inputs, inputs, derivative, shifted, grid([[K.T], [K.T]]) @ D1, 0, drift_in, 0],
            [-tau * eye(3), 0, -tau * (B.T @ W.T), 0, 0, 0, 0, 0],
            [-gamma2 * eye(3), tau * (B.T @ W.T), 0, 0, 0, 0, 0],
            [-tau * eye(3), 0, 0, tau * (W @ L), 0, drift_W],
            [-a * block([[S, S], [Y]]), 0, grid([[S @ L], [Y @ L]]), 0, drift_P],
            [-D1, 0, 0, 0],
            [-D1, 0, 0],
            [-D2, 0],
            [-D2],
        ]
    )


@negative
def eq13(S, N, F_a, F_b, tau, D1, D2, gamma2, *, C_f, A, B, C, L, K, W, a, b, delta_m):
    """(13) for a given C_f: an LMI in S, N, F_a, F_b, tau, the diagonal multipliers D1, D2 (12, 12) and gamma^2.

    The paper has D1 = eps1 I and D2 = eps2 I (reading R1) or I / eps2 (R2); every diagonal D1, D2 > 0 is sound, because
    Delta H and F are diagonal.
    """
    coupling = (C_f.T @ B.T @ S, C_f.T @ B.T @ (S - N))
    data = {"A": A, "B": B, "C": C, "L": L, "K": K, "W": W, "a": a, "b": b, "delta_m": delta_m}
    return _body(S, N, F_a, F_b, C_f, tau, D1, D2, gamma2, coupling, **data)


@negative
def eq13_gains(S, N, tau, D1, D2, gamma2, *, A_f, B_f, C_f, A, B, C, L, K, W, a, b, delta_m):
    """(13) at a given controller: F_a = N A_f, F_b = N B_f."""
    data = {"C_f": C_f, "A": A, "B": B, "C": C, "L": L, "K": K, "W": W, "a": a, "b": b, "delta_m": delta_m}
    return eq13(S, N, N @ A_f, N @ B_f, tau, D1, D2, gamma2, **data)


@negative
def eq17(S, N, F_a, F_b, C_f, gamma2, *, tau, e1, e2, lambda1, on, columns, A, B, C, L, K, W, a, b, delta_m):
    """(17) with fixed scalars; lambda1 multiplies the factor with C_f (``on`` "C") or S ("S"); ``columns`` 6 or 3."""
    data = {"A": A, "B": B, "C": C, "L": L, "K": K, "W": W, "a": a, "b": b, "delta_m": delta_m}
    Xi = _body(S, N, F_a, F_b, C_f, tau, e1 * eye(12), e2 * eye(12), gamma2, (_zero(6, 6), _zero(6, 6)), **data)
    left, above, below = (C_f.T @ B.T, S, S - N) if columns == 6 else (C_f.T, S @ B, (S - N) @ B)
    on_C, on_S = (lambda1, 1 / lambda1) if on == "C" else (1 / lambda1, lambda1)
    border = grid([[on_C * left], [_zero(15, columns)], [on_S * above], [on_S * below], [_zero(48, columns)]])
    return block([[Xi, border], [-2 * eye(columns)]])


@negative
def eq17_minor(S, *, A, C, a, b):
    """Rows 1-1 and 5-1 of (17), 12 x 12: the same in all eight readings, and free of every other unknown."""
    return block([[C.T @ C - (b * b / a) * S, A.T @ S + a * S], [-a * S]])


@nonpositive
def eq19(S, N, *, C_f, theta, u2, eps3, delta_m):
    """(19), 18 rows: the ellipsoid P <= theta keeps the squared torque below u2 for every drift of C_f."""
    return block(
        [
            [-(u2 - eps3 * delta_m * delta_m) * eye(3), -C_f, 0, 0],
            [-S / theta, -S / theta, C_f.T],
            [-(S - N) / theta, 0],
            [-eps3 * eye(3)],
        ]
    )


@nonpositive
def eq20_printed(S, N, *, x0, theta):
    """(20) as printed, 13 rows; x0 (6, 1). Equivalent to x0' S^-1 x0 <= theta."""
    return block([[-theta * eye(1), -x0.T, -x0.T], [-S, -S], [-(S - N)]])


@nonpositive
def eq20_derived(S, N, *, x0, theta):
    """(20) as the proof needs it, reduced to its scalar x0' (S - N) x0 <= theta."""
    return x0.T @ (S - N) @ x0 - theta * eye(1)


@negative
def state_feedback(X, Z, gamma2, *, A, B, C, L, K, W, a, b, delta_m, lam, eps1, e2):
    """(SF), 78 rows: necessary for (13) whatever A_f, B_f are; X = S^-1, Z = C_f X; rows of W0 unscaled."""
    AX = A @ X + B @ Z
    drift = e2 * grid([[X, X @ C.T, Z.T]])
    return block(
        [
            [-(b * b / a) * X, -B, B, lam * (AX.T @ W.T), AX.T + a * X, X @ C.T, eps1 * (X @ K.T), 0, drift, 0],
            [-(lam * lam) * eye(3), 0, -lam * (B.T @ W.T), 0, 0, 0, 0, 0, 0],
            [-gamma2 * eye(3), lam * (B.T @ W.T), 0, 0, 0, 0, 0, 0],
            [-eye(3), 0, 0, 0, lam * (W @ L), 0, (lam * delta_m) * (W @ B)],
            [-a * X, 0, 0, L, 0, delta_m * B],
            [-eye(3), 0, 0, 0, 0],
            [-eps1 * eye(12), 0, 0, 0],
            [-eps1 * eye(12), 0, 0],
            [-e2 * eye(12), 0],
            [-e2 * eye(3)],
        ]
    )


@nonpositive
def state_feedback_torque(X, Z, *, theta, u2, eps3, delta_m):
    """Torque part of (SF), 12 rows."""
    return block(
        [
            [-(u2 - eps3 * delta_m * delta_m) * eye(3), -Z, 0],
            [-X / theta, Z.T],
            [-eps3 * eye(3)],
        ]
    )


@nonpositive
def state_feedback_start(X, *, x0, theta):
    """Start inside the ellipsoid: x0' X^-1 x0 <= theta, 7 rows."""
    return block([[-theta * eye(1), -x0.T], [-X]])


@negative
def robust_disk(P, Lam, *, A, Bp, Cq, Dq, a, b):
    """Poles in D(a, b) for every frozen diagonal uncertainty of the channels Bp, Cq, Dq (beyond the paper)."""
    return scaled_disk(P, Lam, A=A, Bp=Bp, Cq=Cq, Dq=Dq, a=a, b=b)


@negative
def robust_hinf(P, Lam, gamma2, *, A, Bp, B, C, Cq, Dq, Dd):
    """H-infinity norm below gamma for every diagonal uncertainty of the channels, at any speed (beyond the paper)."""
    return scaled_hinf(P, Lam, gamma2, A=A, Bp=Bp, B=B, C=C, Cq=Cq, Dq=Dq, Dd=Dd)


@nonpositive
def torque_decay(P, *, A):
    """P decreases along the loop (beyond the paper)."""
    return decay(P, A=A)


@nonnegative
def torque_cover(P, *, K):
    """x'P x covers the squared torque (beyond the paper)."""
    return covers(P, K=K)


def torque_level(P, xi0):
    """xi0' P xi0, the bound of the squared torque [N^2 m^2]."""
    return level(P, xi0)
