"""Margins of one feedback loop: interval of stable loop gains, phase margin, peak of the sensitivity.

In: plant and compensator (loop ``u = +K y``), or the polynomials of the loop transfer ``L = -P K``, so that the loop
breaks where ``1 + L = 0``. Out: numbers with the frequency at which each is attained. Everything is computed from
polynomials, so plants with poles on the imaginary axis need no special care.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import polynomial as ascending
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from recontrol.systems.norms import hinf_norm_float
from recontrol.systems.statespace import StateSpace, input_sensitivity, transfer_function

Array = NDArray[np.floating[Any]]

ZERO_GAIN = 1e-10  # a critical gain below this is the gain 0 at which a pole sits on the axis already


class UnstableLoopError(ValueError):
    """The nominal loop is not stable: it has no margins."""


class GainInterval(NamedTuple):
    """Stable for every k with lower < k < upper; frequencies [rad/s] at which the ends are lost (nan: no crossing)."""

    lower: float
    upper: float
    lower_frequency: float
    upper_frequency: float
    argument: str


class PhaseMargin(NamedTuple):
    """Smallest distance to -180 degrees over all unit-gain crossings; all crossings are kept [rad/s], [deg]."""

    degrees: float
    frequency: float
    crossings: tuple[tuple[float, float], ...]


class Peak(NamedTuple):
    """Largest value over all frequencies, where it is attained [rad/s], and the same by a Hamiltonian norm."""

    value: float
    frequency: float
    hamiltonian: float


def loop_transfer(plant: StateSpace, compensator: StateSpace) -> tuple[Array, Array]:
    """Numerator and denominator of ``L = -P K`` (coefficients, highest power first), nothing cancelled."""
    plant_num, plant_den = transfer_function(plant)
    num, den = transfer_function(compensator)
    return -np.polymul(plant_num, num), np.polymul(plant_den, den)


def on_axis(polynomial: NDArray[Any]) -> tuple[Array, Array]:
    """Real and imaginary part of p(j w) as polynomials in w, lowest power first."""
    rising = np.asarray(polynomial, dtype=float)[::-1]
    turned = rising * np.array([1j**k for k in range(rising.size)])
    return turned.real, turned.imag


def squared_magnitude(polynomial: Array) -> Array:
    """``abs(p(j w))^2`` as a polynomial in ``w^2``, lowest power first."""
    real, imag = on_axis(polynomial)
    return ascending.polyadd(ascending.polymul(real, real), ascending.polymul(imag, imag))[::2]


def positive_roots(rising: NDArray[Any], tolerance: float = 1e-7) -> list[float]:
    """Real positive roots of a polynomial (lowest power first), sorted.

    A root counts as real if its imaginary part is below `tolerance` times its magnitude: a touching (double) root is
    displaced by about the square root of the rounding error.
    """
    trimmed = ascending.polytrim(rising, tol=1e-14 * float(np.max(np.abs(rising))) if np.any(rising) else 0)
    roots = ascending.polyroots(trimmed)
    return sorted(float(r.real) for r in roots if r.real > 0 and abs(r.imag) <= tolerance * abs(r))


def _hurwitz(num: Array, den: Array, gain: float) -> bool:
    return bool(np.max(np.roots(np.polyadd(den, gain * num)).real) < 0)


def critical_gains(num: Array, den: Array) -> list[tuple[float, float]]:
    """All pairs (k > 0, w >= 0) with ``den(j w) + k num(j w) = 0``, sorted by k; w = inf where the degree drops."""
    num, den = np.trim_zeros(num, "f"), np.trim_zeros(den, "f")
    (nr, ni), (dr, di) = on_axis(num), on_axis(den)
    cross = ascending.polysub(ascending.polymul(di, nr), ascending.polymul(dr, ni))  # odd in w
    frequencies = [0.0, *np.sqrt(positive_roots(cross[1::2]))]
    pairs = []
    for w in frequencies:
        n, d = np.polyval(num, 1j * w), np.polyval(den, 1j * w)
        if n != 0 and -(d / n).real > 0:
            pairs.append((float(-(d / n).real), float(w)))
    if num.size == den.size and -den[0] / num[0] > 0:
        pairs.append((float(-den[0] / num[0]), math.inf))
    return sorted(pairs)


def gain_interval(num: Array, den: Array) -> GainInterval:
    """Largest open interval of loop gains k > 0 around 1 for which ``den + k num`` is Hurwitz.

    Eigenvalues can leave the left half plane only through the imaginary axis (or infinity), and only at one of the
    finitely many :func:`critical_gains`. Between two of them stability is constant; that is the argument for an end
    at 0 or infinity, and the reason why one test per segment suffices.

    Raises
    ------
    UnstableLoopError
        If the loop with k = 1 is not stable.
    """
    if not _hurwitz(num, den, 1.0):
        raise UnstableLoopError("the loop with gain 1 is not stable: it has no gain interval")
    pairs = [(k, w) for k, w in critical_gains(num, den) if k > ZERO_GAIN]
    below = [p for p in pairs if p[0] < 1 and not _same_side(num, den, p[0])]
    above = [p for p in pairs if p[0] > 1 and not _same_side(num, den, p[0])]
    lower, lower_w = below[-1] if below else (0.0, math.nan)
    upper, upper_w = above[0] if above else (math.inf, math.nan)
    words = [] if below else ["no root meets the imaginary axis for 0 < k < 1"]
    words += [] if above else ["no root meets the imaginary axis for k > 1"]
    return GainInterval(lower, upper, lower_w, upper_w, "; ".join(words) or "both ends are crossings")


def _same_side(num: Array, den: Array, gain: float) -> bool:
    """True if the loop is stable on both sides of a critical gain (a root touches the axis and goes back)."""
    return _hurwitz(num, den, gain * (1 - 1e-6)) and _hurwitz(num, den, gain * (1 + 1e-6))


def phase_margin(num: Array, den: Array) -> PhaseMargin:
    """Smallest ``abs(arg L(j w) + 180 deg)`` over all w with ``abs(L(j w)) = 1``; inf without a crossing."""
    balance = ascending.polysub(squared_magnitude(num), squared_magnitude(den))
    crossings = []
    for w in np.sqrt(positive_roots(balance)):
        angle = np.angle(-np.polyval(num, 1j * w) / np.polyval(den, 1j * w), deg=True)
        crossings.append((float(w), float(abs(angle))))
    if not crossings:
        return PhaseMargin(math.inf, math.nan, ())
    frequency, degrees = min(crossings, key=lambda pair: pair[1])
    return PhaseMargin(degrees, frequency, tuple(crossings))


def minimise_over_frequency(value: Callable[[Array], Array], scales: Array, samples: int = 4001) -> tuple[float, float]:
    """Smallest value of `value(w)` over 0 <= w < inf and where it is: a log grid with both ends, then refinement.

    Parameters
    ----------
    value : function of an array of frequencies [rad/s]
    scales : (k,)
        Magnitudes of poles and zeros [rad/s]; the grid spans four decades beyond them on either side, and is refined
        at each of them, as narrow peaks sit near lightly damped roots.
    """
    scales = np.abs(scales[np.abs(scales) > 0])
    wide = np.geomspace(scales.min() * 1e-4, scales.max() * 1e4, samples)
    near = np.outer(scales, 1 + np.linspace(-0.2, 0.2, 201)).ravel()
    grid: Array = np.unique(np.concatenate([[0.0], wide, near]))
    values = value(grid)
    best = (float("inf"), 0.0)
    for k in np.argsort(values)[:5]:
        low, high = grid[max(k - 1, 0)], grid[min(k + 1, grid.size - 1)]
        found = minimize_scalar(
            lambda w: float(value(np.array([w]))[0]), bounds=(low, high), method="bounded", options={"xatol": 1e-13}
        )
        best = min(best, (float(values[k]), float(grid[k])))
        if found.fun < best[0] * (1 - 1e-13):  # at a flat end of the grid the refinement only adds rounding
            best = (float(found.fun), float(found.x))
    return best


def peak_sensitivity(plant: StateSpace, compensator: StateSpace) -> Peak:
    """Largest ``abs(1 / (1 + L))`` of a stable loop, by a sweep and, independently, by a Hamiltonian norm.

    A sweep that missed a narrow peak shows as a difference between the two. For an enclosure see
    :func:`recontrol.systems.norms.hinf_norm`.

    Raises
    ------
    UnstableLoopError
        If the loop is not stable.
    """
    num, den = loop_transfer(plant, compensator)
    closed = np.polyadd(num, den)
    poles = np.roots(closed)
    if np.max(poles.real) >= 0:
        raise UnstableLoopError("the loop is not stable: its sensitivity has no peak")

    def distance(w: Array) -> Array:
        return np.abs(np.polyval(closed, 1j * w)) / np.maximum(np.abs(np.polyval(den, 1j * w)), 1e-300)

    closest, frequency = minimise_over_frequency(distance, np.concatenate([poles, np.roots(den)]))
    at_infinity = abs(np.trim_zeros(closed, "f")[0] / np.trim_zeros(den, "f")[0])
    if at_infinity < closest:
        closest, frequency = at_infinity, math.inf
    return Peak(1 / closest, frequency, hinf_norm_float(*input_sensitivity(plant, compensator)))
