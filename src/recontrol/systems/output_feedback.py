r"""Full-order dynamic output feedback ``x_f' = A_f x_f + B_f y, u = C_f x_f`` of a plant ``x' = A x + B u, y = C x``.

Loops, the change of variables that makes their synthesis convex, and what is unique about a controller. Entries of
``(A_f, B_f, C_f)`` depend on the coordinates of ``x_f``: two controllers are compared by their transfer function.

With the Lyapunov matrix ``P = [[Y, N], [N, -N]]`` (a choice of coordinates, no restriction) and ``X = (Y + N)^{-1}``:

.. math::  C_h = C_f X,\quad B_h = N B_f,\quad A_h = N A_f X + N B_f C X + Y B C_f X + Y A X .

Source: Scherer, Gahinet, Chilali, Multiobjective output-feedback control via LMI optimization, IEEE TAC 42 (1997),
(38)-(41). Everything but the frequency responses works on floats, rationals and balls alike.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from recontrol.systems.generic import inverse, solve, zeros

Array = np.ndarray


class Controller(NamedTuple):
    """Controller ``x_f' = A x_f + B y, u = C x_f``: A (n, n), B (n, n_y), C (n_u, n)."""

    A: Array
    B: Array
    C: Array


class ConvexVariables(NamedTuple):
    """The convex variables of the change of variables: X, Y, Ah (n, n), Bh (n, n_y), Ch (n_u, n)."""

    X: Array
    Y: Array
    Ah: Array
    Bh: Array
    Ch: Array


def closed_loop(A: Array, B: Array, C: Array, controller: Controller, sign: int = 1) -> Array:
    """State matrix (n + n_f, n + n_f) of the loop with ``u = sign * C_f x_f``.

    Raises ValueError if the shapes of plant and controller do not fit.
    """
    n_u, n_y = B.shape[1], C.shape[0]
    if controller.C.shape[0] != n_u or controller.B.shape[1] != n_y:
        raise ValueError(
            f"controller: expected {n_y} inputs and {n_u} outputs, "
            f"found {controller.B.shape[1]} and {controller.C.shape[0]}"
        )
    upper = np.hstack([A, (B @ controller.C) * sign])
    return np.vstack([upper, np.hstack([controller.B @ C, controller.A])])


def extended(B: Array, C: Array, order: int) -> tuple[Array, Array]:
    """Input and output matrices of the loop for a controller of that order: ``[B; 0]`` and ``[C 0]``."""
    return np.vstack([B, zeros(B, order, B.shape[1])]), np.hstack([C, zeros(C, C.shape[0], order)])


def structured(S: Array, N: Array) -> Array:
    """``P = [[S - N, N], [N, -N]]``; positive definite if and only if S > 0 and N < 0."""
    return np.vstack([np.hstack([S - N, N]), np.hstack([N, -N])])


def convex_variables(A: Array, B: Array, C: Array, S: Array, N: Array, controller: Controller) -> ConvexVariables:
    """Variables of the convex conditions that belong to a controller and its ``P = structured(S, N)``."""
    X, Y = inverse(S), S - N
    NB = N @ controller.B
    Ah = N @ controller.A @ X + NB @ C @ X + Y @ B @ controller.C @ X + Y @ A @ X
    return ConvexVariables(X, Y, Ah, NB, controller.C @ X)


def controller_of(A: Array, B: Array, C: Array, v: ConvexVariables) -> Controller:
    """Controller of convex variables with ``[[X, I], [I, Y]] > 0``; inverse of `convex_variables`."""
    Xi = inverse(v.X)
    N = Xi - v.Y
    C_f, B_f = v.Ch @ Xi, solve(N, v.Bh)
    A_f = solve(N, (v.Ah - v.Bh @ C @ v.X - v.Y @ B @ v.Ch - v.Y @ A @ v.X) @ Xi)
    return Controller(A_f, B_f, C_f)


def structured_coordinates(P: Array, controller: Controller) -> Controller:
    """The same controller in the coordinates where the Lyapunov matrix P (2n, 2n) of its loop reads [[Y, N], [N, -N]].

    ``x_f = T x_new`` with ``T = -P22^{-1} P21``. Raises numpy's or flint's error if ``P21`` is singular.
    """
    n = len(controller.A)
    T = -solve(P[n:, n:], P[n:, :n])
    return Controller(solve(T, controller.A @ T), solve(T, controller.B), controller.C @ T)


def drifted(controller: Controller, drift: Array) -> Controller:
    """Controllers with multiplicative drift: columns of A and B, rows of C (batch, ...).

    ``drift`` (batch, n + n_y + n_u): ``A (I + F1), B (I + F2), (I + F3) C`` with diagonal F1, F2, F3, in this order.
    """
    n, n_y = len(controller.A), controller.B.shape[1]
    f1, f2, f3 = drift[:, :n], drift[:, n : n + n_y], drift[:, n + n_y :]
    return Controller(
        controller.A * (1 + f1)[:, None, :], controller.B * (1 + f2)[:, None, :], controller.C * (1 + f3)[:, :, None]
    )


def frequency_response(controller: Controller, omega: Array) -> Array:
    """``K(j omega)``, complex (len(omega), n_u, n_y), for frequencies [rad/s]."""
    s = 1j * np.asarray(omega, dtype=float)[:, None, None]
    return controller.C @ np.linalg.solve(s * np.eye(len(controller.A)) - controller.A, controller.B.astype(complex))


def response_distance(controller: Controller, reference: Controller, omega: Array) -> float:
    """Largest ``||K - K_ref||_2`` over the frequencies, divided by the largest ``||K_ref||_2``.

    Independent of the coordinates of either controller.
    """
    K, R = frequency_response(controller, omega), frequency_response(reference, omega)
    return float(np.linalg.norm(K - R, 2, axis=(1, 2)).max() / np.linalg.norm(R, 2, axis=(1, 2)).max())


def entry_distances(controller: Controller, reference: Controller) -> dict[str, float]:
    """Relative Frobenius distances of A, B and C, entry by entry; informative only in equal coordinates."""
    pairs: dict[str, tuple[Any, Any]] = {k: (getattr(controller, k), getattr(reference, k)) for k in "ABC"}
    return {k: float(np.linalg.norm(a - b) / np.linalg.norm(b)) for k, (a, b) in pairs.items()}
