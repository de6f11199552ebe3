"""Eigenvalues with error bounds: of a rational matrix isolated, of a ball matrix enclosed for the whole box."""

from __future__ import annotations

import numpy as np
from flint import acb, arb, arb_mat, fmpq

from recontrol.exact.ball import has_balls, precision, to_ball
from recontrol.exact.polynomial import PRECISION, charpoly, degree_sorted, is_hurwitz, roots


def eigenvalues(M: np.ndarray, bits: int = PRECISION) -> list[acb]:
    """Eigenvalues of ``M`` (n, n), fastest first, of a conjugate pair the member above the axis first.

    Rational ``M``: isolated roots of the exact characteristic polynomial, with multiplicity. Ball ``M``: enclosures for
    every matrix of the box, from flint's verified eigenvalues. Raises ValueError if the balls do not separate them.
    """
    if not has_balls(M):
        return roots(charpoly(M), bits)
    with precision(bits):
        return degree_sorted(_on_the_axis(arb_mat(to_ball(M).tolist()).eig()))


def _on_the_axis(found: list[acb]) -> list[acb]:
    """The same with imaginary part 0 where an eigenvalue must be real.

    The enclosures are disjoint, one eigenvalue each, and the conjugate of an eigenvalue is one too: if the mirror image
    of an enclosure meets no other enclosure, its eigenvalue is its own conjugate.
    """
    out = []
    for z in found:
        mirror = acb(z.real, -z.imag)
        real = mirror.overlaps(z) and not any(mirror.overlaps(other) for other in found if other is not z)
        out.append(acb(z.real) if real else z)
    return out


def spectral_abscissa(M: np.ndarray, bits: int = PRECISION) -> arb:
    """Largest real part of the eigenvalues."""
    with precision(bits):
        real_parts = [z.real for z in eigenvalues(M, bits)]
        largest = real_parts[0]
        for x in real_parts[1:]:
            largest = largest.max(x)
        return largest


def is_stable(M: np.ndarray, bits: int = PRECISION) -> bool | None:
    """Whether every matrix of ``M`` (a point or a box) is Hurwitz, by Routh's array; None: the balls are too wide."""
    with precision(bits):
        return is_hurwitz(charpoly(M))


def companion(coefficients: list[arb] | list[fmpq]) -> np.ndarray:
    """Matrix (n, n) whose characteristic polynomial is s^n + ... + c_1 s + c_0, ``coefficients`` c_0..c_(n-1)."""
    n = len(coefficients)
    M = np.full((n, n), fmpq(0), dtype=object)
    M[0, :] = [-c for c in reversed(coefficients)]
    for i in range(1, n):
        M[i, i - 1] = fmpq(1)
    return M
