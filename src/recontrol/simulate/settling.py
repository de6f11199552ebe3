"""Settling time, overshoot and undershoot of a sampled response, refined between its samples.

In: a :class:`~recontrol.simulate.linear.StepResponse` and its final value. Out: numbers. A settling time jumps when a
later swing touches the band, so every result here belongs to its band and its horizon.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from recontrol.simulate.linear import StepResponse

TIME_TOLERANCE = 1e-10  # s; an order below the 1e-9 that the results claim


def settling_time(response: StepResponse, final: float, band: float) -> float:
    """Last time at which ``abs(y - final)`` leaves ``band * abs(final)`` [s]; inf if it has not settled at the end.

    The last sample outside is found first. Swings that peak between later samples are looked up through the roots of
    the slope, so that a narrow last exit is not missed; the exit itself is found by root finding.
    """
    limit = band * abs(final)

    def excess(time: float) -> float:
        return abs(response.at(time) - final) - limit

    error = np.abs(response.outputs - final)
    outside = np.flatnonzero(error > limit)
    last = int(outside[-1]) if outside.size else -1
    if last == error.size - 1:
        return math.inf
    start = 0.0 if last < 0 else float(response.times[last])
    hidden = [time for time in _late_peaks(response, error, last, limit) if excess(time) > 0]
    if hidden:
        start = hidden[-1]
    elif last < 0:
        return 0.0
    stop = float(response.times[np.searchsorted(response.times, start, side="right")])
    return float(brentq(excess, start, stop, xtol=TIME_TOLERANCE)) if excess(stop) < 0 else stop


def _late_peaks(response: StepResponse, error: np.ndarray, last: int, limit: float) -> list[float]:
    """Peak times of the error after sample `last` whose neighbouring sample comes within a tenth of the limit."""
    k = np.arange(max(last + 1, 1), error.size - 1)
    near = k[(error[k] >= error[k - 1]) & (error[k] >= error[k + 1]) & (error[k] > 0.9 * limit)]
    peaks = (stationary(response.slope, response.times[i - 1], response.times[i + 1]) for i in near)
    return [time for time in peaks if time is not None]


def stationary(slope: Callable[[float], float], low: float, high: float) -> float | None:
    """A zero of `slope` in [low, high] [s], or None if its sign does not change."""
    if slope(low) * slope(high) > 0:
        return None
    return float(brentq(slope, low, high, xtol=TIME_TOLERANCE))


def extreme(response: StepResponse, sign: float = 1.0) -> float:
    """Largest value of ``sign * y`` over the horizon, refined around its best sample."""
    values = sign * response.outputs
    k = int(np.argmax(values))
    best = float(values[k])
    if 0 < k < values.size - 1:
        time = stationary(response.slope, float(response.times[k - 1]), float(response.times[k + 1]))
        if time is not None:
            best = max(best, sign * response.at(time))
    return best


def overshoot(response: StepResponse, final: float) -> float:
    """``(max of sign(final) y - abs(final)) / abs(final)``, not below 0; inf if the final value is zero."""
    if final == 0:
        return math.inf
    return max(0.0, (extreme(response, math.copysign(1.0, final)) - abs(final)) / abs(final))


def undershoot(response: StepResponse, final: float) -> float:
    """``max(0, -min of sign(final) y) / abs(final)``; inf if the final value is zero."""
    if final == 0:
        return math.inf
    return max(0.0, extreme(response, -math.copysign(1.0, final))) / abs(final)


def last_exit(times: ArrayLike, values: ArrayLike, band: float) -> np.ndarray:
    """Last sample time with ``abs(y) > band * max abs(y)``, for many responses at once.

    Parameters
    ----------
    times : (N,) [s]
    values : (N, batch)
    band : fraction of each response's own largest magnitude

    Returns
    -------
    ndarray (batch,) [s]
        inf where the last sample is still outside, 0 where the response is zero.
    """
    t, y = np.asarray(times, dtype=float), np.abs(np.asarray(values, dtype=float))
    outside = y > band * y.max(axis=0)
    last = y.shape[0] - 1 - np.argmax(outside[::-1], axis=0)
    settled = np.where(outside.any(axis=0), t[last], 0.0)
    return np.where(outside[-1], np.inf, settled)
