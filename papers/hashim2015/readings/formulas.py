"""Formulas of the paper that follow from its definitions: each is compared with its derivation, symbol by symbol.

The symbols stand for every plant of order 4, so an agreement here is a proof for yaw and roll; the pitch order is
tested beside it. Formulas that fail are in `misprints`.
"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from recontrol.claims.values import Identity

from ..symbols import stack, symbolic_charpoly, symbols

ORDER = 4


def state(s: SimpleNamespace, x: np.ndarray, u: np.ndarray) -> np.ndarray:
    """(4)."""
    return s.A @ x + s.B @ u


def estimator_form(
    A: np.ndarray, known: np.ndarray, y: np.ndarray, C: np.ndarray, L: np.ndarray, xh: np.ndarray
) -> np.ndarray:
    """A xh + (known input) + L (y - C xh), the form of (22) into which (32) to (36) substitute."""
    return A @ xh + known + L @ (y - C @ xh)


def estimator(s: SimpleNamespace, y: np.ndarray, u: np.ndarray) -> np.ndarray:
    """(22) with the input matrix B."""
    return estimator_form(s.A, s.B @ u, y, s.C, s.L, s.xh)


def reduced_state(s: SimpleNamespace, x2: np.ndarray, y: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Rate of x2 by (4) where x1 = y."""
    return state(s, stack(y, x2), u)[1:]


def output_rate(s: SimpleNamespace, x2: np.ndarray, y: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Rate of y by (4) where x1 = y."""
    return state(s, stack(y, x2), u)[:1]


def reduced_estimator(s: SimpleNamespace, dy: np.ndarray) -> np.ndarray:
    """The form of (22) with (32) to (36), correct: x2, A22, A21 y + B2 u, y' - A11 y - B1 u, A12."""
    known, measured = s.A21 @ s.y + s.B2 @ s.u, dy - s.A11 @ s.y - s.B1 @ s.u
    return estimator_form(s.A22, known, measured, s.A12, s.L_r, s.xh2)


def control(s: SimpleNamespace, xh2: np.ndarray) -> np.ndarray:
    """(43) with the correct signs."""
    return -s.K1 @ s.y - s.K2 @ xh2


def corrected_A_r(s: SimpleNamespace) -> np.ndarray:
    """(46) with the correct sign."""
    return s.A22 - s.L_r @ s.A12 - (s.B2 - s.L_r @ s.B1) @ s.K2


def corrected_B_r(s: SimpleNamespace) -> np.ndarray:
    """(47) with K1 where the print has K2."""
    return corrected_A_r(s) @ s.L_r + s.A21 - s.L_r @ s.A11 - (s.B2 - s.L_r @ s.B1) @ s.K1


def eq15() -> Identity:
    """u = -Kx minimises (17): completion of squares with K = B'P, R = 1, P a Riccati solution with Q."""
    s = symbols(ORDER)
    K = s.B.T @ s.P
    Q = K.T @ K - s.A.T @ s.P - s.P @ s.A
    value_rate = s.x.T @ s.P @ state(s, s.x, s.u)
    cost_and_value = s.x.T @ Q @ s.x + s.u @ s.u + value_rate + value_rate
    square = s.u + K @ s.x
    return Identity(cost_and_value, square @ square)


def eq16() -> Identity:
    """(15) in (4)."""
    s = symbols(ORDER)
    return Identity((s.A - s.B @ s.K) @ s.x, state(s, s.x, -s.K @ s.x))


def eq20() -> Identity:
    """With the error so defined, xh = x - xt turns (24) into (25)."""
    s = symbols(ORDER)
    error = s.x - s.xh
    return Identity(s.A @ s.x - s.B @ s.K @ (s.x - error), state(s, s.x, -s.K @ s.xh))


def eq23() -> Identity:
    """(4) less (22)."""
    s = symbols(ORDER)
    return Identity((s.A - s.L @ s.C) @ (s.x - s.xh), state(s, s.x, s.u) - estimator(s, s.C @ s.x, s.u))


def eq24() -> Identity:
    """The control law on the estimate in (4)."""
    s = symbols(ORDER)
    return Identity(s.A @ s.x - s.B @ s.K @ s.xh, state(s, s.x, -s.K @ s.xh))


def eq25() -> Identity:
    """(24) in terms of the error of (20)."""
    s = symbols(ORDER)
    error = s.x - s.xh
    return Identity(s.A @ s.x - s.B @ s.K @ (s.x - error), s.A @ s.x - s.B @ s.K @ s.xh)


def eq27() -> Identity:
    """The blocks put together are (4)."""
    s = symbols(ORDER)
    upper = s.A11 @ s.x[:1] + s.A12 @ s.x[1:] + s.B1 @ s.u
    lower = s.A21 @ s.x[:1] + s.A22 @ s.x[1:] + s.B2 @ s.u
    return Identity(stack(upper, lower), state(s, s.x, s.u))


def eq29() -> Identity:
    """Lower rows of (4)."""
    s = symbols(ORDER)
    return Identity(s.A22 @ s.x[1:] + s.A21 @ s.x[:1] + s.B2 @ s.u, state(s, s.x, s.u)[1:])


def eq30() -> Identity:
    """First row of (4) where y = x1."""
    s = symbols(ORDER)
    return Identity(s.A11 @ s.x[:1] + s.A12 @ s.x[1:] + s.B1 @ s.u, state(s, s.x, s.u)[:1])


def eq31() -> Identity:
    """(30) with the known terms on one side."""
    s = symbols(ORDER)
    known = state(s, s.x, s.u)[:1] - s.A11 @ s.x[:1] - s.B1 @ s.u
    return Identity(known, s.A12 @ s.x[1:])


def eq33() -> Identity:
    """The state matrix of (29) is what A of (22) becomes: the change of (29) with x2."""
    s = symbols(ORDER)
    change = reduced_state(s, s.x2 + s.xh2, s.y, s.u) - reduced_state(s, s.x2, s.y, s.u)
    return Identity(s.A22 @ s.xh2, change)


def eq34() -> Identity:
    """The known input of (29): what is left of it at x2 = 0."""
    s = symbols(ORDER)
    return Identity(s.A21 @ s.y + s.B2 @ s.u, reduced_state(s, s.x2 - s.x2, s.y, s.u))


def eq36() -> Identity:
    """The output matrix of (31): the known left side as a function of x2."""
    s = symbols(ORDER)
    known = output_rate(s, s.x2, s.y, s.u) - s.A11 @ s.y - s.B1 @ s.u
    return Identity(s.A12 @ s.x2, known)


def eq38() -> Identity:
    """With the error so defined, (29) less the correct (37) is (A22 - L A12) xt2."""
    s = symbols(ORDER)
    rate = reduced_state(s, s.x2, s.y, s.u) - reduced_estimator(s, output_rate(s, s.x2, s.y, s.u))
    return Identity((s.A22 - s.L_r @ s.A12) @ (s.x2 - s.xh2), rate)


def eq41() -> Identity:
    """The new state's derivative has no y': it is the same for two values of y'."""
    s = symbols(ORDER)
    return Identity(reduced_estimator(s, s.dy) - s.L_r @ s.dy, reduced_estimator(s, s.dy * 0))


def eq42() -> Identity:
    """Derivative of xh2 - L y by the correct (37)."""
    s = symbols(ORDER)
    printed = (s.A22 - s.L_r @ s.A12) @ s.xh2 + (s.A21 - s.L_r @ s.A11) @ s.y + (s.B2 - s.L_r @ s.B1) @ s.u
    return Identity(printed, reduced_estimator(s, s.dy) - s.L_r @ s.dy)


def compensator_rate(s: SimpleNamespace) -> np.ndarray:
    """(42) closed with the correct (43), as a function of xc = xh2 - L y and y."""
    xh2 = s.xc + s.L_r @ s.y
    u = control(s, xh2)
    return (s.A22 - s.L_r @ s.A12) @ xh2 + (s.A21 - s.L_r @ s.A11) @ s.y + (s.B2 - s.L_r @ s.B1) @ u


def eq44() -> Identity:
    """(42) closed with the correct (43) has this form, with the correct (46), (47)."""
    s = symbols(ORDER)
    return Identity(corrected_A_r(s) @ s.xc + corrected_B_r(s) @ s.y, compensator_rate(s))


def eq45() -> Identity:
    """The correct (43) has this form, with (48), (49)."""
    s = symbols(ORDER)
    return Identity(-s.K2 @ s.xc + (-s.K1 - s.K2 @ s.L_r) @ s.y, control(s, s.xc + s.L_r @ s.y))


def eq48() -> Identity:
    """What u gains with xc."""
    s = symbols(ORDER)
    u = control(s, s.xc + s.L_r @ s.y) - control(s, s.L_r @ s.y)
    return Identity(-s.K2 @ s.xc, u)


def eq49() -> Identity:
    """What u gains with y at xc = 0."""
    s = symbols(ORDER)
    return Identity((-s.K1 - s.K2 @ s.L_r) @ s.y, control(s, s.L_r @ s.y))


def krylov(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """[B AB ... A^(n-1) B], (n, n)."""
    columns = [B]
    while len(columns) < A.shape[0]:
        columns.append(A @ columns[-1])
    return np.hstack(columns)


def eq50() -> Identity:
    """The n columns of (50) span all further A^k B: A^n B is their combination with the characteristic coefficients."""
    s = symbols(ORDER)
    return Identity(_next_column(s.A, s.B), s.A @ krylov(s.A, s.B)[:, -1:])


def eq51() -> Identity:
    """(50) of (A', C') transposed: the n rows of (51) span all further C A^k."""
    s = symbols(ORDER)
    return Identity(_next_column(s.A.T, s.C.T).T, krylov(s.A.T, s.C.T)[:, -1:].T @ s.A)


def _next_column(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    coefficients = np.empty((A.shape[0], 1), dtype=object)
    for k, c in enumerate(symbolic_charpoly(A)[:-1]):
        coefficients[k, 0] = -c
    return krylov(A, B) @ coefficients
