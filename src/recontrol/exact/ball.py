"""Ball matrices: numpy object arrays of ``flint.arb``, for rounding boxes and transcendental data.

Balls mix freely with rationals. They also accept floats without complaint, so `assert_rigorous` guards the places where
a proof starts. The working precision belongs to a proof, not to the process: use ``with precision(128): ...``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from flint import arb, ctx, fmpq, fmpz

from recontrol.exact.rational import NotExactError, rational


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Working precision of ball arithmetic in bits (53 outside), restored at the end whatever happens."""
    before = ctx.prec
    ctx.prec = bits
    try:
        yield
    finally:
        ctx.prec = before


def ball(mid: Any, radius: Any = 0) -> arb:
    """Ball that contains every real within ``radius`` of ``mid``; both int, fmpq or decimal text.

    Raises NotExactError for floats: a rounding box is made from text.
    """
    centre = arb(rational(mid))
    half = rational(radius)
    if half == 0:
        return centre
    if half < 0:
        raise ValueError(f"expected a radius >= 0, found {half}")
    return arb(centre, arb(half).upper())


def box(mid: np.ndarray, half: np.ndarray) -> np.ndarray:
    """Ball matrix of the box ``abs(M - mid) <= half`` (exact arrays of one shape)."""
    if mid.shape != half.shape:
        raise ValueError(f"expected half widths of shape {mid.shape}, found {half.shape}")
    out = np.empty(mid.shape, dtype=object)
    for index in np.ndindex(mid.shape):
        out[index] = ball(mid[index], half[index])
    return out


def to_ball(A: Any) -> Any:
    """Rationals as balls at the present precision; balls pass unchanged. Works on scalars and arrays."""
    if isinstance(A, np.ndarray):
        out = np.empty(A.shape, dtype=object)
        for index in np.ndindex(A.shape):
            out[index] = to_ball(A[index])
        return out
    return A if isinstance(A, arb) else arb(rational(A))


def is_rigorous(A: Any) -> bool:
    """Whether ``A`` is a rational or ball, or an object array of these only."""
    if isinstance(A, np.ndarray):
        return A.dtype == object and all(type(x) in (fmpq, arb, int, fmpz) for x in A.flat)
    return type(A) in (fmpq, arb, int, fmpz)


def has_balls(A: Any) -> bool:
    """Whether any entry is a ball."""
    return isinstance(A, arb) or (isinstance(A, np.ndarray) and any(type(x) is arb for x in A.flat))


def assert_rigorous(A: Any, name: str = "matrix") -> None:
    """Raise NotExactError unless every entry is a rational or a ball."""
    if not is_rigorous(A):
        kinds = sorted({type(x).__name__ for x in np.ravel(A)}) if isinstance(A, np.ndarray) else [type(A).__name__]
        raise NotExactError(f"{name}: expected rationals or balls, found entries of type {', '.join(kinds)}")


def is_finite(A: Any) -> bool:
    """Whether no ball is infinite or NaN."""
    entries = A.flat if isinstance(A, np.ndarray) else [A]
    return all(not isinstance(x, arb) or x.is_finite() for x in entries)


def midpoint(A: Any) -> Any:
    """Float midpoint of a ball (nearest double of a rational), or float64 array of the midpoints."""
    if isinstance(A, np.ndarray):
        return np.array([_float(x) for x in A.flat], dtype=float).reshape(A.shape)
    return _float(A)


def _float(x: Any) -> float:
    if type(x) is fmpq:
        return int(x.p) / int(x.q) if x != 0 else 0.0
    return float(x.mid()) if isinstance(x, arb) else int(x)


def radius(A: Any) -> Any:
    """Float upper bound of the radius of a ball, or float64 array of these."""
    if isinstance(A, np.ndarray):
        return np.array([radius(x) for x in A.flat], dtype=float).reshape(A.shape)
    return float(np.nextafter(float(to_ball(A).rad()), np.inf)) if isinstance(A, arb) else 0.0


def exact_midpoint(A: Any) -> Any:
    """Rational (dyadic) midpoint of a ball, or exact array of the midpoints; rationals pass unchanged."""
    if isinstance(A, np.ndarray):
        out = np.empty(A.shape, dtype=object)
        for index in np.ndindex(A.shape):
            out[index] = exact_midpoint(A[index])
        return out
    return A.mid().fmpq() if isinstance(A, arb) else rational(A)


def exact_radius(A: Any) -> Any:
    """Rational (dyadic) radius of a ball, or exact array of the radii; zero for rationals."""
    if isinstance(A, np.ndarray):
        out = np.empty(A.shape, dtype=object)
        for index in np.ndindex(A.shape):
            out[index] = exact_radius(A[index])
        return out
    return A.rad().fmpq() if isinstance(A, arb) else fmpq(0)


def from_mid_rad(mid: fmpq, rad: fmpq) -> arb:
    """Ball with exactly this dyadic midpoint and at least this radius, whatever the present precision."""
    if rad < 0:
        raise ValueError(f"expected a radius >= 0, found {rad}")
    return arb(_dyadic(mid), _dyadic(rad))


def _dyadic(q: fmpq) -> arb:
    denominator = int(q.q)
    exponent = denominator.bit_length() - 1
    if denominator != 1 << exponent:
        raise ValueError(f"expected a dyadic number, found denominator {denominator}")
    return arb((int(q.p), -exponent))
