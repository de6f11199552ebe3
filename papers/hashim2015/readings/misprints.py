"""Formulas that do not follow from the paper's definitions.

Each reading compares the printed form with its derivation. The evidence holds the correct form, whether that one does
follow (it is tested, not asserted), and whether the paper's numbers used the right version.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.values import Identity, Result
from recontrol.exact.polynomial import charpoly
from recontrol.exact.rational import identity, matrix

from ..recipe import Plant, Reduced, reduced_matrices
from ..symbols import equal, shape, stack, symbols
from .formulas import (
    compensator_rate,
    control,
    corrected_A_r,
    corrected_B_r,
    estimator,
    output_rate,
    reduced_estimator,
    reduced_state,
    state,
)

ORDER = 4
PITCH_ORDER = 2


def misprint(
    printed: np.ndarray, derived: np.ndarray, correct: str, correct_form: np.ndarray, numbers: str, **more: Any
) -> Result:
    """The printed form against the derived one; ``correct_form`` stands for ``correct`` and is held against it too."""
    follows = equal(correct_form, derived)
    evidence = {"correct form": correct, "correct form follows": follows, "numbers": numbers, **more}
    return Result(Identity(printed, derived), evidence=evidence)


def eq21() -> Result:
    """xt' = A xt against (4) less (22): true only for L = 0."""
    s = symbols(ORDER)
    derived = state(s, s.x, s.u) - estimator(s, s.C @ s.x, s.u)
    error = s.x - s.xh
    more = {"residual is -L C xt": equal(derived - s.A @ error, -(s.L @ s.C) @ error)}
    numbers = "the right version: (54) places the poles of A - LC"
    return misprint(
        s.A @ error, derived, r"$\dot{\tilde x} = (A - LC)\tilde x$", (s.A - s.L @ s.C) @ error, numbers, **more
    )


def eq22() -> Result:
    """Input matrix B_2, a block of n-1 rows from (27) on, against the n rows of B."""
    s = symbols(ORDER)
    free = s.A @ s.xh + s.F @ s.u + s.L @ (s.C @ s.x - s.C @ s.xh)
    residual = equal(state(s, s.x, s.u) - free - (s.A - s.L @ s.C) @ (s.x - s.xh), (s.B - s.F) @ s.u)
    evidence = {
        "correct form": r"$\dot{\hat x} = A\hat x + Bu + L(y - C\hat x)$",
        "another input matrix F leaves (B - F) u in the error": residual,
        "numbers": "the right version: A - BK - LC in (55) has B",
    }
    return Result(Identity(shape(s.B2), shape(s.B)), evidence=evidence)


def eq26() -> Result:
    """Left side [x'; x'] as printed against the right side's rates of [x; xt]."""
    s = symbols(ORDER)
    error = s.x - s.xh
    rate = state(s, s.x, -s.K @ s.xh)
    error_rate = rate - estimator(s, s.C @ s.x, -s.K @ s.xh)
    right = stack((s.A - s.B @ s.K) @ s.x + s.B @ s.K @ error, (s.A - s.L @ s.C) @ error)
    evidence = {
        "correct form": r"left side $\begin{bmatrix}\dot x \\ \dot{\tilde x}\end{bmatrix}$",
        "correct form follows": equal(stack(rate, error_rate), right),
        "numbers": "(55) has neither the right side's first block nor its last",
    }
    return Result(Identity(stack(rate, rate), right), evidence=evidence)


def eq32() -> Result:
    """x becomes x1 as printed, yet A becomes A22, which multiplies n-1 states."""
    s = symbols(ORDER)
    evidence = {
        "correct form": r"$x \to x_2$",
        "correct form follows": s.A22.shape[1] == s.x2.shape[0],
        "numbers": "the right version: (66) has n-1 states",
    }
    return Result(Identity(shape(s.x[:1]), shape(s.x2)), evidence=evidence)


def eq32_pitch() -> Result:
    """The same for two states, where the sizes fit: A22 x1 + A21 x1 + B2 u is not the rate of x2."""
    s = symbols(PITCH_ORDER)
    x1 = s.x[:1]
    return Result(Identity(reduced_state(s, x1, x1, s.u), reduced_state(s, s.x[1:], x1, s.u)))


def eq35() -> Result:
    """y' - A21 y - B1 u as printed: a scalar less a column of n-1 entries."""
    s = symbols(ORDER)
    evidence = {
        "correct form": r"$y \to \dot y - A_{11} y - B_1 u$",
        "correct form follows": equal(output_rate(s, s.x2, s.y, s.u) - s.A11 @ s.y - s.B1 @ s.u, s.A12 @ s.x2),
        "numbers": "the right version, by way of (37) in (66), (67)",
    }
    return Result(Identity(shape(s.A21 @ s.y), shape(s.dy)), evidence=evidence)


def eq35_pitch() -> Result:
    """The same for two states, where the sizes fit: the known part of (31) has A11."""
    s = symbols(PITCH_ORDER)
    dy = output_rate(s, s.x2, s.y, s.u)
    return Result(Identity(dy - s.A21 @ s.y - s.B1 @ s.u, s.A12 @ s.x2))


def _printed_37(n: int) -> tuple[np.ndarray, np.ndarray, bool]:
    s = symbols(n)
    dy = output_rate(s, s.x2, s.y, s.u)
    bracket = dy - s.A11 @ s.y + s.B1 @ s.u - s.A12 @ s.x2
    printed = reduced_state(s, s.x2, s.y, s.u) + s.L_r @ bracket
    residual = printed - reduced_state(s, s.x2, s.y, s.u)
    twice = s.L_r @ s.B1 @ s.u
    return printed, reduced_state(s, s.x2, s.y, s.u), equal(residual, twice + twice)


def eq37() -> Result:
    """With the printed +B1 u an estimate that is right, xh2 = x2, does not stay right."""
    printed, derived, residual = _printed_37(ORDER)
    evidence = {
        "correct form": r"$\dot{\hat x}_2 = A_{22}\hat x_2 + A_{21} y + B_2 u"
        r" + L(\dot y - A_{11} y - B_1 u - A_{12}\hat x_2)$",
        "residual at xh2 = x2 is 2 L B1 u": residual,
        "numbers": "the right version: (66), (67) follow from B2 - L B1",
    }
    return Result(Identity(printed, derived), evidence=evidence)


def eq39() -> Result:
    """(A22 - L A12) times the estimate as printed, against the rate of the error."""
    s = symbols(ORDER)
    dy = output_rate(s, s.x2, s.y, s.u)
    derived = reduced_state(s, s.x2, s.y, s.u) - reduced_estimator(s, dy)
    M = s.A22 - s.L_r @ s.A12
    numbers = "the right version: the poles of A22 - L A12 are those of the estimator"
    return misprint(
        M @ s.xh2, derived, r"$\dot{\tilde x}_2 = (A_{22} - L A_{12})\tilde x_2$", M @ (s.x2 - s.xh2), numbers
    )


def eq40() -> Result:
    """Two equal terms in xh2, no L and no output, against the rearranged (37)."""
    s = symbols(ORDER)
    M = s.A22 - s.L_r @ s.A12
    derived = reduced_estimator(s, s.dy)
    # y' is a scalar; the print adds it to n-1 rows, read here with the most favourable reading, y' in each row.
    rate = stack(*[s.dy] * (ORDER - 1))
    printed = M @ s.xh2 + M @ s.xh2 + s.B2 @ s.u + rate
    correct_form = M @ s.xh2 + (s.A21 - s.L_r @ s.A11) @ s.y + (s.B2 - s.L_r @ s.B1) @ s.u + s.L_r @ s.dy
    correct = r"$\dot{\hat x}_2 = (A_{22} - L A_{12})\hat x_2 + (A_{21} - L A_{11}) y + (B_2 - L B_1) u + L\dot y$"
    return misprint(printed, derived, correct, correct_form, "the right version, by way of (42)")


def eq43() -> Result:
    """K1 y - K2 y xh2 as printed: a product of signals and a positive sign of K1."""
    s = symbols(ORDER)
    estimate = stack(s.y, s.xh2)
    derived = -s.K @ estimate
    printed = s.K1 @ s.y - s.K2 @ s.xh2 @ s.y
    first = s.K @ estimate
    return misprint(
        printed,
        derived,
        r"$u = -K_1 y - K_2\hat x_2$",
        control(s, s.xh2),
        "the right version: (69) is -K1 - K2 L",
        **{"first equality [K1 K2][y; xh2] as printed": equal(first, derived)},
    )


def eq46() -> Result:
    """+(B2 - L B1) K2 as printed, against (42) closed with u."""
    s = symbols(ORDER)
    derived = compensator_rate(s) - corrected_B_r(s) @ s.y
    printed = s.A22 - s.L_r @ s.A12 + (s.B2 - s.L_r @ s.B1) @ s.K2
    return misprint(
        printed @ s.xc,
        derived,
        r"$A_r = A_{22} - L A_{12} - (B_2 - L B_1) K_2$",
        corrected_A_r(s) @ s.xc,
        "the right version: the columns of (66) give one L with it and exclude each other with the print",
    )


def eq47() -> Result:
    """-(B2 - L B1) K2 as printed: a square matrix added to a column."""
    s = symbols(ORDER)
    derived = compensator_rate(s) - corrected_A_r(s) @ s.xc
    evidence = {
        "correct form": r"$B_r = A_r L + A_{21} - L A_{11} - (B_2 - L B_1) K_1$",
        "correct form follows": equal(corrected_B_r(s) @ s.y, derived),
        "numbers": "the right version: (67) follows from it",
    }
    return Result(Identity(shape((s.B2 - s.L_r @ s.B1) @ s.K2), shape(s.A21)), evidence=evidence)


def eq47_pitch() -> Result:
    """The same for two states, where the sizes fit: K2 is not K1."""
    s = symbols(PITCH_ORDER)
    printed = corrected_A_r(s) @ s.L_r + s.A21 - s.L_r @ s.A11 - (s.B2 - s.L_r @ s.B1) @ s.K2
    return Result(Identity(printed @ s.y, compensator_rate(s) - corrected_A_r(s) @ s.xc))


def eq46_loop() -> Result:
    """Separation with the printed sign: det of the loop matrix against det(sI - A + BK) det(sI - A22 + L A12).

    A rational plant and gains of order 4, drawn once with a fixed seed, y = x1.
    """
    plant, K, L = random_design(seed=7)
    product = charpoly(plant.A - plant.B @ K) * charpoly(plant.A[1:, 1:] - L @ plant.A[:1, 1:])
    M = reduced_matrices(plant, K, L)
    printed_A = M.A + M.B_u @ M.C * fmpq(-2)
    evidence = {"loop identity with the correct sign": bool(x1_loop(plant, M.A, M) == product)}
    return Result(Identity(x1_loop(plant, printed_A, M), product), evidence=evidence)


def random_design(seed: int) -> tuple[Plant, np.ndarray, np.ndarray]:
    """Plant of order 4 with y = x1, gains K (1, 4) and L (3, 1), small rationals."""
    draw = np.random.default_rng(seed).integers

    def rationals(rows: int, columns: int) -> np.ndarray:
        return matrix([[fmpq(int(draw(-9, 10)), int(draw(1, 8))) for _ in range(columns)] for _ in range(rows)])

    plant = Plant(rationals(4, 4), rationals(4, 1), identity(4)[:1])
    return plant, rationals(1, 4), rationals(3, 1)


def x1_loop(plant: Plant, A_r: np.ndarray, M: Reduced) -> Any:
    """det(sI - [A + B D e1', B C; B_r e1', A_r]) for a compensator with another state matrix ``A_r``."""
    B_r = A_r @ M.L + M.B - M.A @ M.L
    return charpoly(np.block([[plant.A + plant.B @ M.D @ plant.C, plant.B @ M.C], [B_r @ plant.C, A_r]]))
