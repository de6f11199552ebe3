"""The matrix inequalities, each written once; every function works on CVXPY, numpy, rationals, balls and affine
matrices.

Shapes: A (6, 6), B1 and B2 (6, 3), C1 and C2 (3, 6), D1 and D2 (3, 3); X, P, P1, P2 (6, 6) symmetric; W, F and Q of (9)
(3, 6); Q (slack), N1, N2, N3, G (6, 6); Y, Z (3, 3) symmetric. The paper uses Q, W and X for several things: here the
argument names are the paper's, place by place.
"""

from __future__ import annotations

from typing import Any

from recontrol.lmi.blocks import block, equal, eye, he, negative, positive, trace


@negative
def brl(X: Any, W: Any, A: Any, B1: Any, B2: Any, C1: Any, D1: Any, D2: Any, gamma: Any) -> Any:
    """(8), 12 x 12: the bounded-real inequality with ``-gamma I`` twice; W = KX."""
    unit = gamma * eye(3)
    return block([[he(A @ X + B1 @ W), B2, (C1 @ X + D1 @ W).T], [-unit, D2.T], [-unit]])


@negative
def brl_std(X: Any, W: Any, A: Any, B1: Any, B2: Any, C1: Any, D1: Any, D2: Any, gamma: Any) -> Any:
    """(8) in the other normalisation: ``-I`` on d, ``-gamma^2 I`` on z; X is gamma times that of (8)."""
    return block([[he(A @ X + B1 @ W), B2, (C1 @ X + D1 @ W).T], [-1 * eye(3), D2.T], [-(gamma * gamma) * eye(3)]])


@negative
def brl_fixed(X: Any, K: Any, A: Any, B1: Any, B2: Any, C1: Any, D1: Any, D2: Any, gamma: Any) -> Any:
    """(8) for a given gain: W = KX."""
    return brl(X, K @ X, A, B1, B2, C1, D1, D2, gamma)


@negative
def brl_std_fixed(X: Any, K: Any, A: Any, B1: Any, B2: Any, C1: Any, D1: Any, D2: Any, gamma: Any) -> Any:
    """`brl_std` for a given gain: W = KX."""
    return brl_std(X, K @ X, A, B1, B2, C1, D1, D2, gamma)


@negative
def h2_lyapunov(X: Any, W: Any, A: Any, B1: Any, B2: Any, factor: Any) -> Any:
    """(9), first line, 6 x 6, at ``factor`` X; the paper's Q = KX is called W here, as in (8).

    The factor is 1 in SI units. In scaled units an X shared with (8) enters (9) 1/z_weight times larger, because (8)
    weighs the disturbance by 1/gamma_inf, and gamma_inf is counted in units of z_weight.
    """
    return factor * he(A @ X + B1 @ W) + B2 @ B2.T


@negative
def h2_lyapunov_fixed(X: Any, K: Any, A: Any, B1: Any, B2: Any, factor: Any) -> Any:
    """(9), first line, for a given gain."""
    return h2_lyapunov(X, K @ X, A, B1, B2, factor)


@equal
def tied_gain(X: Any, W: Any, K: Any) -> Any:
    """W = KX."""
    return W - K @ X


@equal
def tied_n2(Q: Any, N2: Any, B1: Any, K: Any) -> Any:
    """N2 = Q' B1 K, the definition in Theorem 1 (bilinear when K is unknown)."""
    return N2 - Q.T @ B1 @ K


@equal
def tied_n3(Q: Any, N3: Any, B1: Any, K: Any) -> Any:
    """N3 = B1 K Q, the definition in Theorem 1."""
    return N3 - B1 @ K @ Q


@negative
def h2_output(X: Any, Z: Any, C2: Any) -> Any:
    """(9), second line, 9 x 9."""
    return block([[-Z, C2 @ X], [-X]])


@positive
def trace_below(Z: Any, rho: Any) -> Any:
    """Tr Z < rho, as a scalar."""
    return rho - trace(Z)


@positive
def definite(X: Any) -> Any:
    """X > 0."""
    return X


@positive
def output_coupling(X: Any, Z: Any, C2: Any) -> Any:
    """[X C2'; C2 Z] > 0 of Theorem 1 (ii), (iii) and of Theorem 2, 9 x 9."""
    return block([[X, C2.T], [Z]])


@negative
def thm1_iii(X: Any, Q: Any, N2: Any, A: Any, B2: Any) -> Any:
    """(26), 21 x 21; the derivation has N2 = Q' B1 K, Theorem 2 leaves N2 free."""
    return block([[-he(Q), Q.T @ A + N2 + X, Q.T @ B2, Q.T], [-X, 0, 0], [-1 * eye(3), 0], [-X]])


@negative
def thm1_iv(X: Any, Q: Any, N3: Any, A: Any, C2: Any) -> Any:
    """(30), 21 x 21; N3 = B1 K Q."""
    return block([[-he(Q), (A @ Q + N3).T + X, Q.T @ C2.T, Q.T], [-X, 0, 0], [-1 * eye(3), 0], [-X]])


@positive
def input_coupling(X: Any, Z: Any, B2: Any) -> Any:
    """[X B2; B2' Z] > 0, the form of Theorem 1 (iv) whose sizes fit, 9 x 9."""
    return block([[X, B2], [Z]])


@negative
def dilated_inf(
    P1: Any, G: Any, F: Any, A: Any, B1: Any, B2: Any, C1: Any, D1: Any, D2: Any, e1: Any, bz: Any, bd: Any
) -> Any:
    """Dilated bounded-real inequality, 18 x 18: slack G common to all channels, F = KG; bz bd = gamma^2.

    With K = F G^{-1} the annihilator [I Acl 0 0; 0 Ccl I 0; 0 0 0 I] of the slack gives the bounded-real one in P1.
    """
    AG, CG = A @ G + B1 @ F, C1 @ G + D1 @ F
    return block(
        [
            [he(AG), P1 - G.T + e1 * AG, CG.T, B2],
            [-e1 * he(G), e1 * CG.T, 0],
            [-bz * eye(3), D2],
            [-bd * eye(3)],
        ]
    )


@negative
def dilated_h2(P2: Any, G: Any, F: Any, A: Any, B1: Any, B2: Any, e2: Any) -> Any:
    """Dilated Lyapunov inequality of the H2 channel, 15 x 15."""
    AG = A @ G + B1 @ F
    return block([[he(AG), P2 - G.T + e2 * AG, B2], [-e2 * he(G), 0], [-1 * eye(3)]])


@positive
def dilated_effort(Y: Any, F: Any, G: Any, P2: Any) -> Any:
    """[Y F; F' G + G' - P2] > 0, 9 x 9: then Tr Y bounds the squared effort, since G'P2^{-1}G >= G + G' - P2."""
    return block([[Y, F], [he(G) - P2]])


@positive
def effort(X: Any, W: Any, Y: Any) -> Any:
    """[Y W; W' X] > 0, 9 x 9: then Tr Y > Tr(K X K'), the squared effort of u = Kx."""
    return block([[Y, W], [X]])


@negative
def nonfragile(X: Any, W: Any, e: Any, A: Any, B1: Any, B2: Any, M: Any, N: Any, delta: Any) -> Any:
    """Lyapunov inequality of the H2 channel for every abs(F(t)) <= delta, 7 x 7; M (3, 1), N (1, 6) of (10)."""
    B1M = B1 @ M
    top = he(A @ X + B1 @ W) + B2 @ B2.T + (e * (delta * delta)) * (B1M @ B1M.T)
    return block([[top, X @ N.T], [-e]])


@positive
def nonfragile_dual(P: Any, z: Any, A: Any, B1: Any, N: Any) -> Any:
    """[A'P + PA + He(z N), P B1; B1'P, I] > 0, 9 x 9, z (6, 1): multipliers of `nonfragile` with `effort`.

    With `nonfragile_dual_gain` it implies Tr(K X K') >= Tr(B2'P B2) for everything that satisfies both: add the first
    inequality weighed by [P z; z' M'B1'P B1 M] to the second weighed by [I B1'P; P B1 .].
    """
    return block([[he(P @ A) + he(z @ N), P @ B1], [eye(3)]])


@positive
def nonfragile_dual_gain(P: Any, z: Any, B1: Any, M: Any) -> Any:
    """[P z; z' (B1 M)'P (B1 M)] > 0, 7 x 7; for delta = 1."""
    return block([[P, z], [(B1 @ M).T @ P @ (B1 @ M)]])


def dual_trace(P: Any, B2: Any) -> Any:
    """Tr(B2'P B2), the lower bound of the squared effort."""
    return trace(B2.T @ P @ B2)


@negative
def shared_inf(X: Any) -> Any:
    """Leading 3 x 3 block of (8): He(X12), the rates' part of X being shared with `shared_h2`."""
    return he(X[0:3, 3:6])


@positive
def shared_h2(X: Any, Ms: Any) -> Any:
    """What (26) with N2 = Q' B1 K asks of the same X through (17): He(X12 Ms) > 0, Ms = -J^{-1} (angle columns of
    V)."""
    return he(X[0:3, 3:6] @ Ms)


def output_energy(X: Any, C2: Any) -> Any:
    """Tr(C2 X C2'), the objective of the H2 channel."""
    return trace(C2 @ X @ C2.T)


def total(Z: Any) -> Any:
    """Tr Z, an objective."""
    return trace(Z)


@negative
def decay(P: Any, A: Any, rate: Any) -> Any:
    """A'P + PA + 2 rate P < 0 for a closed loop A."""
    return he(P @ A) + (2 * rate) * P
