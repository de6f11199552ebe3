"""The recipe by which every gain of the paper can be recovered, in rational and ball arithmetic.

K: LQR with Q = q C'C, R = 1, q = 1. Estimator poles: the same design with q = 10 (the largest weight of
section 2.2), placed on (A', C'). The reduced estimator takes the first n-1 of them. Neither q nor the pole
list is printed; the evidence is that all printed numbers follow.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, arb, arb_poly, fmpq, fmpq_poly

from recontrol.exact.ball import precision
from recontrol.exact.linalg import inverse
from recontrol.exact.polynomial import (
    PRECISION,
    ackermann,
    charpoly,
    from_roots,
    left_roots,
    place_estimator,
    real_part,
    reflect,
    spectral_factor,
)
from recontrol.exact.rational import identity

CONTROL_WEIGHT = fmpq(1)


@dataclass(frozen=True)
class Plant:
    """Rational state space A (n, n), B (n, 1), C (1, n)."""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray

    @property
    def n(self) -> int:
        return self.A.shape[0]

    @property
    def a(self) -> fmpq_poly:
        """Denominator det(sI - A)."""
        return charpoly(self.A)

    @property
    def b(self) -> fmpq_poly:
        """Numerator det(sI - A + BC) - det(sI - A) of C (sI - A)^-1 B."""
        return charpoly(self.A - self.B @ self.C) - self.a


def plant_of(model: dict[str, Any], axis: str) -> Plant:
    """The rational plant of one axis of the model artifact."""
    exact = model[axis]["exact"]
    return Plant(exact["A"], exact["B"], exact["C"])


def lqr_spectrum(plant: Plant, q: fmpq) -> fmpq_poly:
    """a(s)a(-s) + q b(s)b(-s), whose Hurwitz factor is the closed loop of Q = q C'C, R = 1."""
    return plant.a * reflect(plant.a) + plant.b * reflect(plant.b) * q


def controller_poly(plant: Plant, q: fmpq = CONTROL_WEIGHT) -> arb_poly:
    """p(s) = det(sI - A + BK) of the LQR gain."""
    return spectral_factor(lqr_spectrum(plant, q))


def controller_gain(plant: Plant, q: fmpq = CONTROL_WEIGHT) -> np.ndarray:
    """LQR gain K (1, n) in balls."""
    with precision(PRECISION):
        return ackermann(plant.A, plant.B, controller_poly(plant, q))


def estimator_poles(plant: Plant, q: fmpq) -> list[acb]:
    """Estimator poles, fast pair first, the member above the axis first."""
    return left_roots(lqr_spectrum(plant, q))


def decimal_round(x: arb, places: int) -> fmpq:
    """``x`` rounded to ``places`` decimals; raises ValueError if the ball straddles a tie."""
    scaled = x * 10**places + arb(fmpq(1, 2))
    whole = scaled.floor().unique_fmpz()
    if whole is None:
        raise ValueError(f"{x} cannot be rounded to {places} decimals")
    return fmpq(whole, 10**places)


def typed(poles: list[acb], places: int = 4) -> list[tuple[fmpq, fmpq]]:
    """Real and imaginary parts as somebody types them who reads ``places`` decimals."""
    return [(decimal_round(z.real, places), decimal_round(z.imag, places)) for z in poles]


def typed_poly(poles: list[tuple[fmpq, fmpq]]) -> fmpq_poly:
    """Real part of prod(s - p_i) for rational poles; exact.

    The real part matters where a complex pole stands without its conjugate: a classic Ackermann routine
    discards the imaginary part silently.
    """
    real, imag = fmpq_poly([1]), fmpq_poly([0])
    for x, y in poles:
        factor = fmpq_poly([-x, 1])
        real, imag = real * factor + imag * y, imag * factor - real * y
    return real


def exact_poly(poles: list[acb]) -> arb_poly:
    """Real part of prod(s - p_i) for ball poles."""
    with precision(PRECISION):
        return real_part(from_roots(poles))


@dataclass(frozen=True)
class Reduced:
    """Reduced compensator xc' = A xc + B m + B_u u, u = C xc + D m of the measured signal m, with u inserted in A.

    L is its estimator gain (n-1, 1); the matrices follow (46)-(49) with the correct signs.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    B_u: np.ndarray
    L: np.ndarray


def partition(M: Plant, K: np.ndarray) -> tuple[np.ndarray, ...]:
    """A11, A12, A21, A22, B1, B2, K1, K2 as in (27) and (58)-(65)."""
    return (M.A[:1, :1], M.A[:1, 1:], M.A[1:, :1], M.A[1:, 1:], M.B[:1], M.B[1:], K[:, :1], K[:, 1:])


def reduced_matrices(plant: Plant, K: np.ndarray, L: np.ndarray) -> Reduced:
    """(46)-(49), correct forms, for the partition of ``plant`` whose first state is measured."""
    A11, A12, A21, A22, B1, B2, K1, K2 = partition(plant, K)
    B_u = B2 - L @ B1
    A_r = A22 - L @ A12 - B_u @ K2
    B_r = A_r @ L + A21 - L @ A11 - B_u @ K1
    return Reduced(A=A_r, B=B_r, C=-K2, D=-K1 - K2 @ L, B_u=B_u, L=L)


def reduced_design(plant: Plant, K: np.ndarray, p: Any) -> Reduced:
    """Reduced compensator whose error polynomial det(sI - A22 + L A12) is ``p`` (degree n-1)."""
    with precision(PRECISION):
        _, A12, _, A22, *_ = partition(plant, K)
        return reduced_matrices(plant, K, place_estimator(A22, A12, p))


def measured_basis(plant: Plant) -> np.ndarray:
    """T (n, n) whose first row is C: T = [C; e1; e3; e4], for pitch the states swapped."""
    rows = [plant.C[0]] + [identity(plant.n)[i] for i in range(plant.n) if i != 1]
    return np.array(rows, dtype=object)


def in_measured_basis(plant: Plant, K: np.ndarray) -> tuple[Plant, np.ndarray, np.ndarray]:
    """Plant and gain in the states T x, and T; then y is the first state and the premise of (28) holds."""
    T = measured_basis(plant)
    back = inverse(T)
    return Plant(T @ plant.A @ back, T @ plant.B, plant.C @ back), K @ back, T
