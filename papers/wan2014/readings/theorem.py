"""Section 3: the algebra of Theorems 2 and 3 as exact identities at random rational matrices."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.values import Approx, Identity, Result, Size, Statement
from recontrol.exact import linalg
from recontrol.exact.rational import diagonal, identity, zeros
from recontrol.lmi.blocks import block, grid, he

from .. import conditions

SEED = 2014


def draw() -> SimpleNamespace:
    """Random rational matrices of the paper's sizes (fixed seed); P, Q, R symmetric positive definite, K = Y X^-1."""
    random = np.random.default_rng(SEED)

    def full(m: int, n: int) -> np.ndarray:
        entries = [[fmpq(int(k), 7) for k in row] for row in random.integers(-20, 21, size=(m, n))]
        return np.array(entries, dtype=object)

    def definite(n: int) -> np.ndarray:
        G = full(n, n)
        return G @ G.T + identity(n)

    s = SimpleNamespace(A=full(6, 6), B=full(6, 3), C=full(3, 6), L=full(6, 3), K=full(3, 6))
    s.E1, s.E2, s.Lambda = full(6, 6), full(6, 6), diagonal([fmpq(k, 9) for k in (1, -2, 3, -4, 5, -6)])
    s.P, s.Q, s.R = definite(6), definite(6), definite(3)
    s.x, s.estimate, s.xi, s.eps, s.rho, s.limit = (
        full(6, 1),
        full(6, 1),
        full(12, 1),
        fmpq(3, 5),
        fmpq(11, 4),
        fmpq(40),
    )
    s.X, s.F, s.dA = linalg.inverse(s.P), s.A - s.L @ s.C, s.E1 @ s.Lambda @ s.E2
    s.Y = s.K @ s.X
    return s


def eq9_error() -> Identity:
    """Rate of x by (1), (10) less that of the estimate by (6) to (8), against (9)."""
    s = draw()
    u = -s.K @ s.estimate
    rate = (s.A + s.dA) @ s.x + s.B @ u
    observed = s.A @ s.estimate + s.B @ u + s.L @ (s.C @ s.x - s.C @ s.estimate)
    return Identity(rate - observed, s.F @ (s.x - s.estimate) + s.dA @ s.x)


def eq11_loop() -> Identity:
    """Rate of x under u = -K times the estimate, against (11) in x and e."""
    s = draw()
    rate = (s.A + s.dA) @ s.x - s.B @ s.K @ s.estimate
    return Identity(rate, (s.A + s.dA - s.B @ s.K) @ s.x + s.B @ s.K @ (s.x - s.estimate))


def sec31_error_stable(simulation: Any) -> Result:
    """K = 0: the plant drifts and drives e, which then grows from revolution to revolution."""
    open_loop = simulation["linear_cost"]["values"]["open_loop"]
    decay = open_loop["second"] - open_loop["tenth"]
    joint = simulation["floquet"]["values"]["integration"]["multiplier"]
    return Result(
        Statement({"norm(e), second minus tenth revolution, K = 0": Approx(float(decay), 1e-4)}),
        {**open_loop, "largest multiplier of (x, e) with the printed K": float(joint)},
    )


def derivative(s: SimpleNamespace) -> np.ndarray:
    """The printed matrix of (18)."""
    return block([[he(s.P @ (s.A + s.dA - s.B @ s.K)), s.P @ s.B @ s.K + s.dA.T @ s.P], [he(s.P @ s.F)]])


def eq18_vdot() -> Identity:
    """Derivative of x'Px + e'Pe along (9), (11) as a matrix, against (18)."""
    s = draw()
    loop = grid([[s.A + s.dA - s.B @ s.K, s.B @ s.K], [s.dA, s.F]])
    both = block([[s.P, 0], [s.P]])
    return Identity(he(both @ loop), derivative(s))


def thrust_cost(s: SimpleNamespace) -> np.ndarray:
    """[K -K]' R [K -K] (12, 12)."""
    row = np.hstack([s.K, -s.K])
    return row.T @ s.R @ row


def eq21(s: SimpleNamespace) -> np.ndarray:
    """The printed matrix of (21)."""
    weight = s.K.T @ s.R @ s.K
    return block(
        [
            [he(s.P @ (s.A + s.dA - s.B @ s.K)) + s.Q + weight, s.P @ s.B @ s.K + s.dA.T @ s.P - weight],
            [he(s.P @ s.F) + weight],
        ]
    )


def eq21_matrix() -> Identity:
    """(18) plus x'Qx + u'Ru, against (21)."""
    s = draw()
    return Identity(derivative(s) + block([[s.Q, 0], [zeros(6)]]) + thrust_cost(s), eq21(s))


def psi(s: SimpleNamespace) -> np.ndarray:
    """Psi of (23)."""
    weight = s.K.T @ s.R @ s.K
    return block(
        [
            [he(s.P @ (s.A - s.B @ s.K)) + s.Q + weight, s.P @ s.B @ s.K - weight],
            [he(s.P @ s.F) + weight],
        ]
    )


def factors(s: SimpleNamespace) -> tuple[np.ndarray, np.ndarray]:
    """Delta and E of (23)."""
    return np.block([[s.P @ s.E1, zeros(6)], [s.P @ s.E1, zeros(6)]]), np.block(
        [[s.E2, zeros(6)], [zeros(6), zeros(6)]]
    )


def eq22_split() -> Identity:
    """Psi + he(Delta Phi E) with the factors of (23), against (21)."""
    s = draw()
    delta, E = factors(s)
    phi = np.block([[s.Lambda, zeros(6)], [zeros(6), zeros(6)]])
    return Identity(psi(s) + he(delta @ phi @ E), eq21(s))


def eq24(s: SimpleNamespace) -> np.ndarray:
    """The matrix of (24): the uncertain part of (22) bounded by the weight eps."""
    delta, E = factors(s)
    return psi(s) + s.eps * (delta @ delta.T) + (1 / s.eps) * (E.T @ E)


def eq26(s: SimpleNamespace) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gamma_11, Gamma_12, Gamma_22 as printed."""
    spread = s.eps * (s.P @ s.E1 @ s.E1.T @ s.P)
    first = block([[he(s.P @ (s.A - s.B @ s.K)) + spread, s.P @ s.B @ s.K + spread], [he(s.P @ s.F) + spread]])
    one, nil = identity(6), zeros(6)
    columns = np.block([[s.E2.T, nil, s.K.T, -s.K.T, one], [nil, nil, -s.K.T, s.K.T, nil]])
    inverse_weight = linalg.inverse(s.R)
    corner = block(
        [
            [-s.eps * one, 0, 0, 0, 0],
            [-s.eps * one, 0, 0, 0],
            [-inverse_weight, 0, 0],
            [-inverse_weight, 0],
            [-linalg.inverse(s.Q)],
        ]
    )
    return first, columns, corner


def complement(s: SimpleNamespace) -> np.ndarray:
    """Schur complement (12, 12) of the printed (26)."""
    first, columns, corner = eq26(s)
    return first - columns @ linalg.inverse(corner) @ columns.T


def eq26_schur() -> Identity:
    """Schur complement of (26) as printed, against (24)."""
    s = draw()
    return Identity(complement(s), eq24(s))


def eq26_twice() -> Identity:
    """The same complement, against (24) with [K -K]'R[K -K] once more."""
    s = draw()
    return Identity(complement(s), eq24(s) + thrust_cost(s))


def eq14_congruence() -> Identity:
    """(26) as printed times diag(X, X, I) on both sides, its empty block dropped, against our condition."""
    s = draw()
    first, columns, corner = eq26(s)
    keep = [*range(18), *range(24, 36)]
    full = np.block([[first, columns], [columns.T, corner]])[np.ix_(keep, keep)]
    T = block([[s.X, 0, 0], [s.X, 0], [identity(18)]])
    weights = {"Qi": linalg.inverse(s.Q), "Ri": linalg.inverse(s.R)}
    ours = conditions.eq14(s.X, s.Y, s.eps * identity(6), A=s.A, B=s.B, E1=s.E1, E2=s.E2, F=s.F, **weights, count=2)
    return Identity(T @ full @ T, ours)


def thm2_refs() -> Size:
    """Size of (24), which the proof says is multiplied by diag(X, X, I)."""
    return Size(*eq24(draw()).shape)


def thm2_refs_25() -> Size:
    """Size of (25): block (1,1) of (26) and its corner."""
    first, _, corner = eq26(draw())
    size = first.shape[0] + corner.shape[0]
    return Size(size, size)


def eq29(s: SimpleNamespace, corner: Any) -> np.ndarray:
    """The matrix of (29) with a given corner."""
    return block([[corner, s.xi.T], [-block([[s.X, 0], [s.X]])]])


def eq29_sign() -> Statement:
    """A negative definite matrix has negative diagonal entries; the printed corner is +rho, rho > 0."""
    s = draw()
    return Statement({"minus the corner of (29)": -eq29(s, s.rho)[0, 0]})


def eq29_minus() -> Identity:
    """(29) with the corner -rho, against (15), whose block is the inverse of diag(P, P)."""
    s = draw()
    inverse = linalg.inverse(block([[s.P, 0], [s.P]]))
    return Identity(eq29(s, -s.rho), block([[-s.rho, s.xi.T], [-inverse]]))


def eq30() -> Identity:
    """(15) times diag(1/rho, I) on both sides, against (30)."""
    s = draw()
    eq15 = eq29(s, -s.rho)
    T = block([[1 / s.rho, 0], [identity(12)]])
    return Identity(T @ eq15 @ T, -conditions.eq30(s.X, 1 / s.rho, xi0=s.xi))


def eq31() -> Identity:
    """(34) to (36), the congruence to (31), and the shorter form used here, for one axis."""
    s = draw()
    row, r, bound = s.K[1:2, :], 1 / s.rho, s.limit * s.limit
    pair = np.hstack([row, -row])
    both = block([[s.P, 0], [s.P]])
    eq36 = block([[-both, pair.T], [np.array([[-bound * r]], dtype=object)]])
    eq35 = pair.T @ pair * (1 / bound) - r * both
    schur = (eq36[:12, :12] + pair.T @ pair / (bound * r)) * r
    T = block([[s.X, 0, 0], [s.X, 0], [1]])
    axis: dict[str, Any] = {"axis": 1, "limit": s.limit}
    short = conditions.eq31(s.X, s.Y, r, kappa=2, **axis)
    return Identity(
        (schur, T @ eq36 @ T, _corner(short)),
        (
            eq35,
            -conditions.eq31_printed(s.X, s.Y, r, **axis),
            2 * _corner(conditions.eq31_printed(s.X, s.Y, r, **axis)),
        ),
    )


def _corner(M: np.ndarray) -> Any:
    """Schur complement of the last entry."""
    return (M[-1:, -1:] - M[-1:, :-1] @ linalg.solve(M[:-1, :-1], M[:-1, -1:]))[0, 0]


def eq37() -> Identity:
    """Schur complement of (37) times w, against w/rho - 1, whose sign is that of w - rho."""
    s = draw()
    w, r = fmpq(17, 3), 1 / s.rho
    M = conditions.eq37(w, r)
    return Identity(_corner(M) * w, w * r - 1)
