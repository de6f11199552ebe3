"""Polynomials of control theory in exact and in ball arithmetic.

Matrices are object arrays of ``fmpq`` (exact) or ``arb`` (balls); polynomials are ``fmpq_poly``,
``arb_poly`` or ``acb_poly``, coefficients in ascending order as python-flint has them.
Everything returned encloses the true answer; a question that balls cannot decide is answered ``None``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from flint import acb, acb_poly, arb, arb_mat, arb_poly, fmpq, fmpq_poly

from recontrol.exact.ball import has_balls, precision, to_ball
from recontrol.exact.linalg import inverse
from recontrol.exact.rational import to_fmpq_mat

RationalOrBall = Any  # fmpq_poly or arb_poly
PRECISION = 256


class RootError(ValueError):
    """A polynomial has a root on the axis that was to separate its roots."""


def charpoly(M: np.ndarray) -> Any:
    """Characteristic polynomial det(sI - M), monic, exact for rational and enclosing for ball entries."""
    return _flint(M).charpoly()


def _flint(M: np.ndarray) -> Any:
    return arb_mat(to_ball(M).tolist()) if has_balls(M) else to_fmpq_mat(M)


def monic(p: Any) -> Any:
    """``p`` divided by its leading coefficient."""
    lead = p.coeffs()[-1]
    return type(p)([c / lead for c in p.coeffs()])


def reflect(p: Any) -> Any:
    """p(-s)."""
    return type(p)([-c if k % 2 else c for k, c in enumerate(p.coeffs())])


def ball_poly(p: Any) -> arb_poly:
    """``p`` with ball coefficients at the current precision."""
    return arb_poly([arb(c) for c in p.coeffs()])


def degree_sorted(roots: Sequence[acb]) -> list[acb]:
    """Roots by ascending real part; of a conjugate pair the member above the axis comes first."""

    def order(z: acb) -> tuple[float, float]:
        return (round(float(z.real.mid()), 12), -float(z.imag.mid()))

    return sorted(roots, key=order)


def roots(p: fmpq_poly, bits: int = PRECISION) -> list[acb]:
    """Isolated roots of the rational polynomial ``p`` with multiplicity, sorted by `degree_sorted`."""
    with precision(bits):
        return degree_sorted([z for z, multiplicity in p.complex_roots() for _ in range(multiplicity)])


def left_roots(p: fmpq_poly, bits: int = PRECISION) -> list[acb]:
    """Roots of ``p`` with negative real part.

    Raises RootError if a root cannot be separated from the imaginary axis.
    """
    found = []
    for z in roots(p, bits):
        if z.real < 0:
            found.append(z)
        elif not z.real > 0:
            raise RootError(f"root {z} is not separated from the imaginary axis at {bits} bits")
    return found


def from_roots(poles: Sequence[acb]) -> acb_poly:
    """Monic polynomial prod(s - p_i) with complex ball coefficients."""
    product = acb_poly([1])
    for pole in poles:
        product = product * acb_poly([-acb(pole), 1])
    return product


def real_part(p: acb_poly) -> arb_poly:
    """Coefficientwise real part."""
    return arb_poly([c.real for c in p.coeffs()])


def spectral_factor(p: fmpq_poly, bits: int = PRECISION) -> arb_poly:
    """Monic Hurwitz factor h of an even polynomial: p(s) = p_0 h(s) h(-s).

    The left roots of ``p`` are closed under conjugation, so the product is real and the real part of each
    ball encloses the coefficient. Raises RootError if ``p`` has roots on the imaginary axis, ValueError if
    it is not even.
    """
    if any(c != 0 for c in p.coeffs()[1::2]):
        raise ValueError("a spectral factor needs an even polynomial, found an odd power")
    with precision(bits):
        return real_part(from_roots(left_roots(p, bits)))


def routh_column(p: RationalOrBall) -> list[Any]:
    """First column of Routh's array of ``p``, leading coefficient first.

    Raises ZeroDivisionError if a pivot is (or, in balls, may be) zero.
    """
    coefficients = list(reversed(p.coeffs()))
    upper, lower = coefficients[0::2], coefficients[1::2]
    column = [upper[0]]
    while lower:
        pivot = lower[0]
        if _maybe_zero(pivot):
            raise ZeroDivisionError("a pivot of Routh's array may be zero")
        column.append(pivot)
        width = len(upper) - 1
        padded = lower + [type(pivot)(0)] * (len(upper) - len(lower))
        upper, lower = lower, [upper[k + 1] - upper[0] / pivot * padded[k + 1] for k in range(width)]
    return column


def _maybe_zero(x: Any) -> bool:
    return not (x > 0 or x < 0)


def is_hurwitz(p: RationalOrBall) -> bool | None:
    """Whether every root of ``p`` (every member of the ball polynomial) has a negative real part.

    A coefficient of the wrong sign refutes at once; else Routh's array decides. None: the balls are too wide.
    """
    column = list(reversed(monic(p).coeffs()))
    if any(c < 0 for c in column) or any(isinstance(c, fmpq) and c == 0 for c in column):
        return False
    try:
        first = routh_column(monic(p))
    except ZeroDivisionError:
        return None
    if all(c > 0 for c in first):
        return True
    return False if any(c < 0 for c in first) else None


def kharitonov_corners(ends: Sequence[tuple[fmpq, fmpq]]) -> list[fmpq_poly]:
    """The four monic polynomials that decide a box: all of its monic polynomials are Hurwitz if these are.

    ``ends`` holds lower and upper end of each coefficient, ascending, without the leading 1. Source: Kharitonov 1978,
    Differential Equations 14, 1483-1485.
    """
    patterns = ((0, 0, 1, 1), (1, 1, 0, 0), (0, 1, 1, 0), (1, 0, 0, 1))
    return [fmpq_poly([ends[k][p[k % 4]] for k in range(len(ends))] + [fmpq(1)]) for p in patterns]


def real_roots(p: fmpq_poly, bits: int = PRECISION) -> list[arb]:
    """Distinct real roots of ``p``, ascending, as disjoint balls."""
    with precision(bits):
        found = [z.real for z, _ in p.complex_roots() if z.imag == 0]
    return sorted(found, key=lambda x: float(x.mid()))


def decide_end(holds: Callable[[fmpq], bool | None], inside: fmpq, outside: fmpq, steps: int = 60) -> tuple[fmpq, fmpq]:
    """Bisect for the end of an interval: rationals (last inside, first outside), both decided.

    ``holds`` answers True, False or None at a rational point. The bracket stops shrinking where it says
    None; so the two returned points are certified whatever their distance.
    """
    if holds(inside) is not True or holds(outside) is not False:
        raise ValueError("the end of an interval needs one point inside and one outside")
    for _ in range(steps):
        middle = (inside + outside) / 2
        answer = holds(middle)
        if answer is None:
            break
        inside, outside = (middle, outside) if answer else (inside, middle)
    return inside, outside


def ackermann(A: np.ndarray, B: np.ndarray, p: Any) -> np.ndarray:
    """Gain K (1, n) with det(sI - A + BK) = p(s), single input, by Ackermann's formula.

    A (n, n) and B (n, 1) rational, ``p`` monic of degree n with rational or ball coefficients. Raises SingularError
    if (A, B) is not controllable. Source: Ackermann 1972; Franklin, Powell, Emami-Naeini, sec. 7.5.
    """
    n = A.shape[0]
    columns = [B]
    for _ in range(n - 1):
        columns.append(A @ columns[-1])
    row: np.ndarray = inverse(np.hstack(columns))[n - 1 :, :]
    gain: Any = 0
    for c in p.coeffs():
        gain = gain + row * c
        row = row @ A
    return gain


def place_estimator(A: np.ndarray, C: np.ndarray, p: Any) -> np.ndarray:
    """Gain L (n, 1) with det(sI - A + LC) = p(s): `ackermann` on (A', C')."""
    return ackermann(A.T, C.T, p).T
