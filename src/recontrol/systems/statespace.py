"""Single-loop state-space pieces: realisations, transfer polynomials, compensator loops.

In: float arrays. Out: :class:`StateSpace` records, polynomial coefficients (highest power first), loop matrices.
Sign convention of every loop here: the compensator's output is added at the plant's input, ``u = +K y + r``.
"""

from typing import Any, NamedTuple

import numpy as np
from flint import fmpq, fmpq_mat
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.floating[Any]]


class ShapeError(ValueError):
    """Matrices of a realisation do not fit together."""


class StateSpace(NamedTuple):
    """``x' = A x + B u``, ``y = C x + D u``; A is (n_x, n_x), B (n_x, n_u), C (n_y, n_x), D (n_y, n_u)."""

    A: Array
    B: Array
    C: Array
    D: Array


def state_space(A: ArrayLike, B: ArrayLike, C: ArrayLike, D: ArrayLike | None = None) -> StateSpace:
    """A checked realisation. One-dimensional B is a column, one-dimensional C a row; D defaults to zero.

    Raises
    ------
    ShapeError
        Naming the matrix, the shape found and the shape expected.
    """
    a = np.atleast_2d(np.asarray(A, dtype=float))
    n = a.shape[0]
    b, c = np.asarray(B, dtype=float), np.asarray(C, dtype=float)
    b = b.reshape(n, 1) if b.ndim < 2 and b.size == n else b
    c = c.reshape(1, n) if c.ndim < 2 and c.size == n else c
    if a.shape != (n, n):
        raise ShapeError(f"A is {a.shape}, expected a square matrix")
    if b.ndim != 2 or b.shape[0] != n:
        raise ShapeError(f"B is {b.shape}, expected ({n}, n_u) as A is {a.shape}")
    if c.ndim != 2 or c.shape[1] != n:
        raise ShapeError(f"C is {c.shape}, expected (n_y, {n}) as A is {a.shape}")
    shape = (c.shape[0], b.shape[1])
    d = np.zeros(shape) if D is None else np.asarray(D, dtype=float)
    d = d.reshape(1, 1) if d.ndim < 2 and d.size == 1 else d
    if d.shape != shape:
        raise ShapeError(f"D is {d.shape}, expected {shape}")
    return StateSpace(a, b, c, d)


def spectral_abscissa(A: ArrayLike) -> float:
    """Largest real part of the eigenvalues of A, shape (n, n)."""
    return float(np.max(np.linalg.eigvals(np.asarray(A, dtype=float)).real))


def characteristic_polynomial(A: ArrayLike) -> Array:
    """Coefficients of det(sI - A), highest power first.

    The doubles of A are taken as the rationals they are and the polynomial is formed exactly; each coefficient is
    rounded once. Differences of two such polynomials therefore keep their small coefficients.
    """
    a = np.asarray(A, dtype=float)
    exact = fmpq_mat(a.shape[0], a.shape[1], [fmpq(*float(v).as_integer_ratio()) for v in a.ravel()])
    return np.array([int(c.p) / int(c.q) for c in reversed(exact.charpoly().coeffs())])


def transfer_function(system: StateSpace) -> tuple[Array, Array]:
    """Numerator and denominator of a single-input single-output system, without cancellation.

    From ``det(sI - A + B C) = den + C adj(sI - A) B``. The numerator has the length of the denominator.
    """
    _check_siso(system)
    den = characteristic_polynomial(system.A)
    num = characteristic_polynomial(system.A - system.B @ system.C) - den + system.D[0, 0] * den
    return num, den


def frequency_response(system: StateSpace, omega: ArrayLike) -> NDArray[Any]:
    """``C (j omega I - A)^-1 B + D``, shape (len(omega), n_y, n_u); omega [rad/s] must avoid poles on the axis."""
    w = np.atleast_1d(np.asarray(omega, dtype=float))
    n = system.A.shape[0]
    resolvent = 1j * w[:, None, None] * np.eye(n) - system.A
    columns = np.broadcast_to(system.B, (w.size, *system.B.shape)).astype(complex)
    return system.C @ np.linalg.solve(resolvent, columns) + system.D


def loop_matrix(plant: StateSpace, compensator: StateSpace) -> Array:
    """State matrix of the loop ``u = +K y``, states ordered plant, compensator. The plant has no direct term."""
    _check_loop(plant, compensator)
    A, B, C, _ = plant
    Ak, Bk, Ck, Dk = compensator
    return np.block([[A + B @ Dk @ C, B @ Ck], [Bk @ C, Ak]])


def input_sensitivity(plant: StateSpace, compensator: StateSpace) -> StateSpace:
    """Realisation of ``S = (1 - K P)^-1``: from r in ``u = K y + r`` to u."""
    n = compensator.A.shape[0]
    m = plant.B.shape[1]
    return StateSpace(
        loop_matrix(plant, compensator),
        np.vstack([plant.B, np.zeros((n, m))]),
        np.hstack([compensator.D @ plant.C, compensator.C]),
        np.eye(m),
    )


def _check_siso(system: StateSpace) -> None:
    if system.D.shape != (1, 1):
        raise ShapeError(f"the system has D of shape {system.D.shape}, expected one input and one output")


def _check_loop(plant: StateSpace, compensator: StateSpace) -> None:
    if compensator.D.shape != plant.D.shape[::-1]:
        raise ShapeError(
            f"the compensator has D of shape {compensator.D.shape}, expected {plant.D.shape[::-1]} for a plant with "
            f"{plant.D.shape[1]} inputs and {plant.D.shape[0]} outputs"
        )
    if np.any(plant.D):
        raise ShapeError("the plant has a direct term D: absorb it in the compensator first")
