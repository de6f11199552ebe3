r"""Comparison of a whole box of loops with one system of decoupled modes, in ball arithmetic.

With V approximately the eigenvectors of the midpoint of the box and z = V^{-1} x, every member of the box obeys
``z' = (Lambda + Delta) z`` with ``abs(Delta) <= spread`` entry by entry. Then ``abs(z(t)) <= w(t)`` and

.. math::  |z(t) - e^{\Lambda t} z(0)| \le w(t) - e^{t\,\mathrm{Re} \Lambda} |z(0)|, \quad w' = N w, \quad
           N = \mathrm{Re} \Lambda + \mathrm{spread}, \quad w(0) = |z(0)| ,

also if Delta varies with time. What proves it is variation of constants and N having no negative entry off its diagonal
(Coppel, Stability and Asymptotic Behavior of Differential Equations, 1965, ch. III). Small boxes lose little by it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from recontrol.exact.ball import midpoint, precision, to_ball

Array = Any
BITS = 128


@dataclass(frozen=True)
class Modes:
    """values: Lambda (n,); right, left: V and its inverse (n, n); metzler: N (n, n), upper bounds of its entries."""

    values: list[acb]
    right: acb_mat
    left: acb_mat
    metzler: arb_mat

    @property
    def order(self) -> int:
        """n."""
        return len(self.values)

    def seen(self, rows: Array) -> acb_mat:
        """``rows V`` for exact rows (k, n)."""
        return acb_mat(to_ball(rows).tolist()) * self.right

    def entered(self, starts: Array) -> acb_mat:
        """``V^{-1} starts`` for exact starts (n, k)."""
        return self.left * acb_mat(to_ball(starts).tolist())


def modes(M: Array, tied: tuple[Array, Array] | None = None) -> Modes:
    """Modes of the box ``M`` (n, n) of balls or rationals. Raises ZeroDivisionError if no eigenvectors are found.

    tied: exact E (n, k), F (k, n): the members are ``M + E diag(d) F`` with abs(d) <= 1. A parameter that stands in
    several entries loses less this way than in a box of the entries.
    """
    eigenvalues, vectors = np.linalg.eig(np.asarray(midpoint(M), dtype=float))
    n = len(eigenvalues)
    with precision(BITS):
        right, values = acb_mat([[_exact(x) for x in row] for row in vectors]), [_exact(x) for x in eigenvalues]
        left = right.inv()
        rotated = left * acb_mat(to_ball(M).tolist()) * right
        entries = [[upper(abs(rotated[i, j] - (values[i] if i == j else 0))) for j in range(n)] for i in range(n)]
        if tied is not None:
            into, out = (acb_mat(to_ball(factor).tolist()) for factor in tied)
            entries = _plus(entries, _magnitudes(left * into) * _magnitudes(out * right))
        for i in range(n):
            entries[i][i] += values[i].real
        return Modes(values, right, left, arb_mat(entries))


def _magnitudes(A: acb_mat) -> arb_mat:
    return arb_mat([[upper(abs(A[i, j])) for j in range(A.ncols())] for i in range(A.nrows())])


def _plus(entries: list[list[arb]], more: arb_mat) -> list[list[arb]]:
    return [[x + more[i, j] for j, x in enumerate(row)] for i, row in enumerate(entries)]


def supersolution(found: Modes, weights: list[arb], growth: float) -> tuple[list[arb], arb] | None:
    """Positive p (n,) and the least a with ``N p <= a p``: from ``w(0) <= q p`` follows ``w(t) <= q e^{a t} p``.

    weights: positive right-hand side that shapes p; growth: above the abscissa of N, the a sought. None without such p.
    """
    right = np.array([float(x.mid()) for x in weights])
    try:
        guess = np.linalg.solve(growth * np.eye(found.order) - _floats(found), right)
    except np.linalg.LinAlgError:
        return None
    if not np.all(guess > 0) or not np.all(np.isfinite(guess)):
        return None
    p = [arb(float(x)) for x in guess]
    image = found.metzler * arb_mat([[x] for x in p])
    return p, max(upper(image[i, 0] / p[i]) for i in range(found.order))


def growth_bound(found: Modes) -> float:
    """Proven upper bound of the spectral abscissa [1/s] of every member of the box; inf if there is none."""
    largest = float(np.linalg.eigvals(_floats(found)).real.max())
    scale = max(float(abs(value).mid()) for value in found.values)
    for slack in (1e-9, 1e-6, 1e-3):
        with precision(BITS):
            proven = supersolution(found, [arb(1)] * found.order, largest + slack * scale)
        if proven is not None:
            return float(np.nextafter(float(proven[1]), np.inf))
    return float("inf")


def _floats(found: Modes) -> Array:
    n = found.order
    return np.array([[float(found.metzler[i, j].mid()) for j in range(n)] for i in range(n)])


def upper(x: Any) -> arb:
    """Exact upper end of a real ball."""
    return arb(x.upper())


def _exact(x: complex) -> acb:
    return acb(arb(float(np.real(x))), arb(float(np.imag(x))))
