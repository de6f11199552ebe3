"""Bounds that hold for every member of an ensemble of linear loops, proven in ball arithmetic.

In: a loop matrix whose entries are balls or rationals (the whole box of an ensemble), n <= 12 or so. Out: a number that
no member can exceed, from a Lyapunov matrix that is computed in floats and then proven; None where that fails.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from flint import arb, arb_poly

from recontrol.exact.ball import exact_midpoint, exact_radius, has_balls, midpoint, precision
from recontrol.exact.linalg import is_positive_definite
from recontrol.exact.polynomial import is_hurwitz, kharitonov_corners
from recontrol.exact.rational import from_float, identity, to_float

Array = Any
BITS = 128
SLACKS = tuple(10.0 ** (-k / 4) for k in range(24, 1, -1))


def decay_bound(M: Array) -> float | None:
    """Proven upper bound of the spectral abscissa [1/s] over the box of ``M`` (n, n).

    With P > 0 and M'P + PM - 2 a P < 0, every eigenvalue has a real part below a. The bound sought is the abscissa of
    the midpoint and a little more.
    """
    centre = _floats(M)
    spectrum = np.linalg.eigvals(centre)
    largest, scale = float(spectrum.real.max()), float(np.abs(spectrum).max())
    for slack in SLACKS:
        level = largest + slack * scale
        rate = from_float(level)
        with precision(BITS):
            for P in _lyapunov_matrices(centre, level):
                if is_positive_definite(P) and is_positive_definite(_he(-(P @ M)) + 2 * rate * P):
                    return level
    return None


def root_bound(p: Any) -> float | None:
    """Proven upper bound of the real parts of the roots [1/s] of every member of a ball polynomial ``p``.

    Kharitonov's test of the monic p(s + a). Tighter than a matrix bound where the entries of a matrix are tied.
    """
    roots = np.roots(midpoint(np.array(p.coeffs()[::-1], dtype=object)))
    largest, scale = float(roots.real.max()), float(np.abs(roots).max())
    for slack in SLACKS:
        level = largest + slack * scale
        with precision(BITS):
            shifted = np.array(p(arb_poly([arb(from_float(level)), 1])).coeffs()[:-1], dtype=object)
        middle, half = exact_midpoint(shifted), exact_radius(shifted)
        ends = list(zip((middle - half).tolist(), (middle + half).tolist(), strict=True))
        if all(is_hurwitz(corner) is True for corner in kharitonov_corners(ends)):
            return level
    return None


def _lyapunov_matrices(centre: Array, level: float) -> Iterator[Array]:
    """Candidates: of the shifted Lyapunov equation, and of the eigenvectors (each mode decays at its own rate)."""
    from scipy.linalg import solve_continuous_lyapunov

    n = centre.shape[0]
    found = solve_continuous_lyapunov((centre - level * np.eye(n)).T, -np.eye(n))
    yield _symmetric(found / np.abs(found).max())
    modes = np.linalg.inv(np.linalg.eig(centre)[1])
    found = (modes.conj().T @ modes).real
    yield _symmetric(found / np.abs(found).max())


def integral_bound(M: Array, row: Array, starts: Array) -> float | None:
    """Proven upper bound of the integral of ``(row x)^2`` over 0..inf for unit starts, over the box of ``M``.

    starts: exact (n, k), x(0) = starts w with abs(w) <= 1; row: exact (1, n). With W > 0 and M'W + WM + row'row < 0 the
    integral is at most x(0)'W x(0) <= b for b I - starts'W starts > 0.
    """
    from scipy.linalg import solve_continuous_lyapunov

    centre, output, directions = _floats(M), to_float(row), to_float(starts)
    n, k = directions.shape
    for slack in SLACKS:
        weight = output.T @ output + slack * np.eye(n)
        found = solve_continuous_lyapunov(centre.T, -weight)
        W = _symmetric(found)
        level = float(np.linalg.eigvalsh(directions.T @ found @ directions).max()) * (1 + slack)
        with precision(BITS):
            dissipates = is_positive_definite(W) and is_positive_definite(-_he(W @ M) - row.T @ row)
            if dissipates and is_positive_definite(from_float(level) * identity(k) - starts.T @ W @ starts):
                return level
    return None


def _floats(M: Array) -> Array:
    return np.asarray(midpoint(M) if has_balls(M) else to_float(M), dtype=float)


def _symmetric(M: Array) -> Array:
    return from_float((M + M.T) / 2)


def _he(M: Array) -> Array:
    """M + M', mirrored so that both halves are the same balls."""
    total = M + M.T
    for i, j in zip(*np.tril_indices(total.shape[0], -1), strict=True):
        total[i, j] = total[j, i]
    return total
