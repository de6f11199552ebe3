"""The matrix inequalities of the paper, each written once.

Arguments are CVXPY expressions, floats, rationals, balls or affine matrices. `X` (6, 6) symmetric, `Y` (3, 6), `eps`
(6, 6) diagonal, `r` = 1/rho scalar; `F` is the matrix of the observer error, A - LC where the paper has it. Columns are
(n, 1).
"""

from __future__ import annotations

from typing import Any

from recontrol.lmi.blocks import block, equal, eye, grid, he, negative, positive, trace


@negative
def eq14(X: Any, Y: Any, eps: Any, *, A: Any, B: Any, E1: Any, E2: Any, F: Any, Qi: Any, Ri: Any, count: int) -> Any:
    """(14) without its empty fourth block (30, 30).

    `eps` is the multiplier as a matrix (6, 6), eps I in the paper; Qi, Ri are the inverse weights. `count` = 2 has R
    twice, in two columns, as printed; 1 has it once, as (21) demands (27, 27).
    """
    spread = E1 @ eps @ E1.T
    weights = [[-Ri, 0], [-Ri]] if count == 2 else [[-Ri]]
    state, error = ([Y.T, -Y.T], [-Y.T, Y.T]) if count == 2 else ([Y.T], [-Y.T])
    return block(
        [
            [he(A @ X - B @ Y) + spread, B @ Y + spread, X @ E2.T, *state, X],
            [he(F @ X) + spread, 0, *error, 0],
            [-eps, *[0] * count, 0],
            *[[*row, 0] for row in weights],
            [-Qi],
        ]
    )


@negative
def eq14_state(X: Any, Y: Any, eps: Any, *, A: Any, B: Any, E1: Any, E2: Any, Qi: Any, Ri: Any, count: int) -> Any:
    """Row and column blocks 1, 3, 5, 6, 7 of (14): what is left for any observer matrix F (24, 24)."""
    weights = [[-Ri, 0], [-Ri]] if count == 2 else [[-Ri]]
    return block(
        [
            [he(A @ X - B @ Y) + E1 @ eps @ E1.T, X @ E2.T, *([Y.T, -Y.T] if count == 2 else [Y.T]), X],
            [-eps, *[0] * count, 0],
            *[[*row, 0] for row in weights],
            [-Qi],
        ]
    )


@negative
def eq14_nominal(X: Any, Y: Any, *, A: Any, B: Any, Qi: Any, Ri: Any, count: int) -> Any:
    """`eq14_state` for a circular orbit, e = 0: no uncertainty and no multiplier (18, 18)."""
    weights = [[-Ri, 0], [-Ri]] if count == 2 else [[-Ri]]
    rows = [[he(A @ X - B @ Y), *([Y.T, -Y.T] if count == 2 else [Y.T]), X]]
    return block([*rows, *[[*row, 0] for row in weights], [-Qi]])


@negative
def eq14_margin(
    X: Any, Y: Any, eps: Any, mu: Any, *, A: Any, B: Any, E1: Any, E2: Any, F: Any, Qi: Any, Ri: Any, D: Any, count: int
) -> Any:
    """(14) held off by mu diag(D, 0) [mu in 1/s]; D (12, 12) is taken from the printed X."""
    M = eq14(X, Y, eps, A=A, B=B, E1=E1, E2=E2, F=F, Qi=Qi, Ri=Ri, count=count)
    return M + mu * padded(D, M.shape[0])


@negative
def eq14_state_margin(
    X: Any, Y: Any, eps: Any, mu: Any, *, A: Any, B: Any, E1: Any, E2: Any, Qi: Any, Ri: Any, D: Any, count: int
) -> Any:
    """`eq14_state` held off by mu diag(D, 0) [mu in 1/s], the first six rows of D."""
    M = eq14_state(X, Y, eps, A=A, B=B, E1=E1, E2=E2, Qi=Qi, Ri=Ri, count=count)
    return M + mu * padded(D[:6, :6], M.shape[0])


def padded(D: Any, size: int) -> Any:
    """diag(D, 0) of the given size."""
    return block([[D, 0], [0 * eye(size - D.shape[0])]])


@negative
def error_block(X: Any, *, F: Any) -> Any:
    """Block (2, 2) of (14) without the eps term, which only makes it harder (6, 6)."""
    return he(F @ X)


@positive
def definite(X: Any) -> Any:
    """X > 0 (6, 6)."""
    return X


@positive
def scaled_definite(X: Any, T: Any) -> Any:
    """T X T > 0 for a diagonal T > 0 (6, 6)."""
    return T @ X @ T


@positive
def eq30(X: Any, r: Any, *, xi0: Any) -> Any:
    """(30) times -1: V(0) < rho for the start xi(0) = (x(0), e(0)) given as a column (12, 1) (13, 13)."""
    return block([[r, -r * xi0.T[:, :6], -r * xi0.T[:, 6:]], [X, 0], [X]])


@positive
def eq30_state(X: Any, r: Any, *, x0: Any) -> Any:
    """(30) times -1 with e(0) = 0, its second X dropped (7, 7)."""
    return block([[r, -r * x0.T], [X]])


@positive
def eq31(X: Any, Y: Any, r: Any, *, axis: int, limit: Any, kappa: Any) -> Any:
    """(31) times -1 for one axis, its two X blocks merged by congruence: kappa Y_i X^-1 Y_i' < u_i^2 / rho (7, 7).

    `kappa` = 2 is (31) as printed, 1 is (31) without its row for e.
    """
    row = Y[axis : axis + 1, :]
    return block([[X, kappa * row.T], [kappa * limit * limit * r]])


@positive
def eq31_printed(X: Any, Y: Any, r: Any, *, axis: int, limit: Any) -> Any:
    """(31) times -1 as printed (13, 13)."""
    row = Y[axis : axis + 1, :]
    return block([[X, 0, -row.T], [X, row.T], [limit * limit * r]])


@positive
def eq37(w: Any, r: Any) -> Any:
    """(37) times -1: w > rho (2, 2)."""
    return block([[w, -1], [r]])


@negative
def fixed_gain(X: Any, eps: Any, *, K: Any, A: Any, B: Any, E1: Any, E2: Any, Qi: Any, Ri: Any, count: int) -> Any:
    """`eq14_state` with Y = K X for a given K."""
    return eq14_state(X, K @ X, eps, A=A, B=B, E1=E1, E2=E2, Qi=Qi, Ri=Ri, count=count)


@positive
def fixed_limit(X: Any, r: Any, *, K: Any, axis: int, limit: Any, kappa: Any) -> Any:
    """`eq31` with Y = K X for a given K."""
    return eq31(X, K @ X, r, axis=axis, limit=limit, kappa=kappa)


@positive
def at_least(r: Any, floor: Any) -> Any:
    """r > floor: rho stays below a multiple of its optimum (1, 1)."""
    return (r - floor) * eye(1)


@negative
def repaired(P: Any, D: Any, *, Acl: Any, Qbar: Any, a: Any, b: Any) -> Any:
    """Cost inequality with a free P (12, 12) and multiplier D (5, 5) in place of diag(P, P) and eps I (17, 17)."""
    return block([[he(P @ Acl) + Qbar + b.T @ D @ b, P @ a], [-D]])


@negative
def decreasing(P: Any, D: Any, *, Acl: Any, a: Any, b: Any) -> Any:
    """`repaired` without the cost: V decreases along every admissible uncertainty (17, 17)."""
    return block([[he(P @ Acl) + b.T @ D @ b, P @ a], [-D]])


@positive
def lyapunov(P: Any) -> Any:
    """P > 0."""
    return P


@positive
def inside(P: Any, *, xi0: Any) -> Any:
    """V(0) < 1 (1, 1)."""
    return 1 * eye(1) - xi0.T @ P @ xi0


@positive
def thrust(P: Any, gamma: Any, *, k: Any) -> Any:
    """k P^-1 k' < gamma for one row k (1, 12) of the loop's thrust over its limit (13, 13)."""
    return block([[P, k.T], [gamma]])


@equal
def product(X: Any, Y: Any, K: Any) -> Any:
    """Y = K X of (44) (3, 6)."""
    return Y - K @ X


@equal
def product_gap(X: Any, Y: Any, W: Any, S: Any, *, K0: Any, X0: Any, left: Any, right: Any) -> Any:
    """Y = K X with K = K0 + W and S standing for W (X - X0), in scaled units: left (...) right = 0 (3, 6)."""
    return left @ (Y - K0 @ X - W @ X0 - S) @ right


@positive
def gap(Z: Any, t: Any, *, A: Any, F: Any) -> Any:
    """G(Z) - t I with G(Z) = he(Z11 A + Z22 F), of the multiplier against (14) (6, 6)."""
    return he(Z[:6, :6] @ A) + he(Z[6:, 6:] @ F) - t * eye(6)


@equal
def kills_Y(Z: Any, *, B: Any) -> Any:
    """B'(Z11 - Z12) = 0, times the mass: Y drops out of <Z, (14)> (3, 6)."""
    return B.T @ (Z[:6, :6] - Z[:6, 6:])


@equal
def unit_trace(Z: Any) -> Any:
    """trace Z = 1."""
    return trace(Z) - 1 * eye(1)


def loop_matrices(A: Any, B: Any, C: Any, K: Any, L: Any) -> Any:
    """Matrix (12, 12) of (x, e) in (9), (11) without the uncertainty."""
    return grid([[A - B @ K, B @ K], [0, A - L @ C]])
