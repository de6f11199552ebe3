r"""Linear periodic systems ``x' = (A + sum_k sin(w_k t + phase_k) A_k) x``: monodromy, multipliers, stability radius.

The monodromy matrix is enclosed by a validated Taylor method. Each step's transition matrix is a truncated series plus
Cauchy's bound on the rest. A rounding box of the data is not carried through the product of the steps, where the balls
would grow exponentially (wrapping); with ``S_j`` the steps of the midpoint and ``S_j + E_j`` those of a member,

.. math:: X_k = \Phi_k + \sum_{j<k} \Phi(k, j+1) E_j X_j

bounds the deviation entry by entry with the true transition matrices of the midpoint.

Source: Hartman, Ordinary Differential Equations, IV.6 (Floquet theory); Nedialkov, Jackson, Corliss, Appl. Math.
Comput. 105 (1999) 21-68 (validated Taylor methods and wrapping).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from recontrol.exact.ball import exact_midpoint, precision, to_ball
from recontrol.systems.norms import hinf_norm
from recontrol.systems.stability import UndecidedError


@dataclass(frozen=True)
class Mode:
    """One sinusoidal part of the system matrix: ``sin(frequency * t + phase) * matrix``.

    ``matrix`` (n, n) exact or ball; ``frequency`` [rad/s] and ``phase`` [rad] are rationals or balls.
    """

    matrix: np.ndarray
    frequency: Any
    phase: Any


def monodromy(
    A: np.ndarray, modes: Sequence[Mode], period: Any, *, steps: int = 128, order: int = 30, bits: int = 200
) -> np.ndarray:
    """Ball matrix (n, n) that contains the monodromy matrix of every system of the box.

    Parameters: ``A`` (n, n) exact or ball, ``modes`` the sinusoidal parts, ``period`` [s] a rational or ball.
    The boxes may vary independently in every entry.
    """
    with precision(bits):
        period = arb(period)
        step = period / steps
        centre = [exact_midpoint(A), *(exact_midpoint(mode.matrix) for mode in modes)]
        box = [A, *(mode.matrix for mode in modes)]
        wide = any(isinstance(x, arb) and x.rad() > 0 for M in box for x in M.flat)
        exact_steps, deviations = [], []
        for j in range(steps):
            waves = [_wave(mode, step * j, order) for mode in modes]
            S = _taylor_step(centre, waves, modes, step, order)
            exact_steps.append(S)
            if wide:
                deviations.append(_magnitude(_taylor_step(box, waves, modes, step, order) - S))
        product, deviation = _propagate(exact_steps, deviations)
        return _widened(product, deviation)


def _wave(mode: Mode, start: arb, order: int) -> list[arb]:
    """Taylor coefficients of ``sin(frequency * (start + h) + phase)`` in h, orders 0 to ``order``."""
    frequency = arb(mode.frequency)
    s, c = (frequency * start + arb(mode.phase)).sin_cos()
    cycle, factor, out = (s, c, -s, -c), arb(1), []
    for k in range(order + 1):
        out.append(cycle[k % 4] * factor)
        factor = factor * frequency / (k + 1)
    return out


def _taylor_step(
    matrices: list[np.ndarray], waves: list[list[arb]], modes: Sequence[Mode], step: arb, order: int
) -> arb_mat:
    """Transition matrix over one step, remainder included."""
    A, *parts = [arb_mat(to_ball(M).tolist()) for M in matrices]
    n = A.nrows()
    terms = [arb_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])]
    for k in range(order):
        derivative = A * terms[k]
        for part, wave in zip(parts, waves, strict=True):
            mixed = terms[k] * wave[0]
            for j in range(1, k + 1):
                mixed = mixed + terms[k - j] * wave[j]
            derivative = derivative + part * mixed
        terms.append(derivative * (1 / arb(k + 1)))
    total = terms[order]
    for term in reversed(terms[:order]):
        total = total * step + term
    rest = arb(0, _remainder(A, parts, modes, step, order).upper())
    return total + arb_mat(n, n, [rest] * (n * n))


def _remainder(A: arb_mat, parts: list[arb_mat], modes: Sequence[Mode], step: arb, order: int) -> arb:
    """Cauchy's bound on the rest: ``|X(z)| <= exp(M R)`` on the complex disc of radius R, here eight steps."""
    radius = 8 * step
    size = _row_norm(A)
    for part, mode in zip(parts, modes, strict=True):
        size += _row_norm(part) * (arb(mode.frequency) * radius).cosh()
    ratio = step / radius
    return (size * radius).exp() * ratio ** (order + 1) / (1 - ratio)


def _row_norm(M: arb_mat) -> arb:
    rows = [sum((abs(M[i, j]) for j in range(M.ncols())), arb(0)).upper() for i in range(M.nrows())]
    return max(rows)


def _magnitude(M: arb_mat) -> arb_mat:
    """Entrywise upper bound of the absolute value, as exact balls."""
    return arb_mat([[abs(M[i, j]).upper() for j in range(M.ncols())] for i in range(M.nrows())])


def _propagate(steps: list[arb_mat], deviations: list[arb_mat]) -> tuple[arb_mat, arb_mat | None]:
    """Product of the midpoint steps and the entrywise bound on the deviation of the box."""
    n = steps[0].nrows()
    unit = arb_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])
    products = [unit]
    for S in steps:
        products.append(S * products[-1])
    if not deviations:
        return products[-1], None
    sizes: list[arb_mat] = [arb_mat(n, n)]
    tails: list[arb_mat] = []  # entry j: transition from the end of step j to the present time
    forcing: list[arb_mat] = []
    for k, S in enumerate(steps):
        tails = [S * tail for tail in tails]
        tails.append(unit)
        forcing.append(_magnitude(deviations[k]) * (_magnitude(products[k]) + sizes[k]))
        total = arb_mat(n, n)
        for tail, force in zip(tails, forcing, strict=True):
            total = total + _magnitude(tail) * force
        sizes.append(_magnitude(total))
    return products[-1], sizes[-1]


def _widened(product: arb_mat, deviation: arb_mat | None) -> np.ndarray:
    n = product.nrows()
    out = np.empty((n, n), dtype=object)
    for i, j in np.ndindex(n, n):
        out[i, j] = product[i, j] + (arb(0, deviation[i, j].upper()) if deviation is not None else 0)
    return out


def multiplier_discs(matrix: np.ndarray, *, bits: int = 200) -> list[tuple[acb, arb]]:
    """Gershgorin discs (centre, radius) of a ball matrix in the eigenbasis of its midpoint; their union holds all
    multipliers, and a disc apart from the others holds exactly one.

    Raises UndecidedError if the midpoint has no usable eigenbasis.
    """
    with precision(bits):
        M = acb_mat(to_ball(matrix).tolist())
        middle = acb_mat(to_ball(exact_midpoint(matrix)).tolist())
        basis = middle.eig(right=True, algorithm="approx")[1]
        try:
            similar = basis.solve(M * basis)
        except ZeroDivisionError as error:
            raise UndecidedError("the midpoint has no usable eigenbasis") from error
        discs = []
        for i in range(M.nrows()):
            others = sum((abs(similar[i, j]) for j in range(M.nrows()) if j != i), arb(0))
            discs.append((similar[i, i], arb(others.upper())))
        return discs


def spectral_radius(matrix: np.ndarray, *, bits: int = 200) -> arb:
    """Ball that contains the largest absolute multiplier of every matrix of the box."""
    with precision(bits):
        discs = multiplier_discs(matrix, bits=bits)
        upper = max(arb((abs(centre) + radius).upper()) for centre, radius in discs)
        lower = arb(0)
        for i, (centre, radius) in enumerate(discs):
            apart = all(abs(centre - c) > radius + r for j, (c, r) in enumerate(discs) if j != i)
            if apart:
                lower = max(lower, arb((abs(centre) - radius).lower()))
        return lower.union(upper)


def period_doubling_margin(matrix: np.ndarray, *, bits: int = 200) -> arb:
    """``-det(I + Phi)``: positive proves an odd number of real multipliers below -1, hence instability.

    The product of ``1 + mu`` is negative only if a real multiplier lies below -1 (complex ones come in pairs).
    """
    with precision(bits):
        n = len(matrix)
        shifted = to_ball(matrix) + np.array([[arb(int(i == j)) for j in range(n)] for i in range(n)])
        return -arb_mat(shifted.tolist()).det()


def quadratic_stability_radius(
    A: np.ndarray, B: np.ndarray, C: np.ndarray, *, rtol: float = 1e-9, bits: int = 160
) -> arb:
    """Ball around ``1 / ||C (sI - A)^{-1} B||_inf``.

    ``x' = (A + B F(t) C) x`` has one quadratic Lyapunov function for every measurable F with ``|F| <= delta`` exactly
    if delta is below this radius (Khargonekar, Petersen, Zhou, IEEE TAC 35, 1990, 356-361).
    """
    zero = np.empty((C.shape[0], B.shape[1]), dtype=object)
    zero[...] = exact_midpoint(arb(0))
    norm = hinf_norm(A, B, C, zero, rtol=rtol, bits=bits)
    with precision(bits):
        return 1 / norm.value
