"""Loops with a control that is computed at sampling instants and held in between.

The linear plant advances by one matrix exponential per subinterval (exact up to rounding), the nonlinear one by an
integrator that is restarted at every sampling instant, since the right-hand side jumps there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class SampledSimulationError(RuntimeError):
    """The integrator gave up between two sampling instants."""


@dataclass(frozen=True)
class HeldRun:
    """One run of a sampled loop.

    time (n_t,), state (n_t, n_x): samples times intervals + 1 points, the instants among them;
    instants (n_k,), control (n_k, n_u): the sampling instants and what is held from each of them on.
    """

    time: Array
    state: Array
    instants: Array
    control: Array
    samples: int


def periodic(h: float, duration: float) -> Array:
    """Equal intervals of length `h` that fill `duration`; raises ValueError if they do not fit."""
    count = round(duration / h)
    if count < 1 or abs(count * h - duration) > 1e-9 * duration:
        raise ValueError(f"duration {duration} is not a multiple of the period {h}")
    return np.full(count, float(h))


def with_exosystem(A: Array, E: Array, S: Array) -> Array:
    """Generator [[A, E], [0, S]] of a plant driven by d = E-weighted states of w' = S w (constants, sines)."""
    n, m = E.shape
    return np.vstack([np.hstack([A, E]), np.hstack([np.zeros((m, n)), S])])


def oscillator(frequency: float) -> Array:
    """Generator (2, 2) of (sin, cos) at `frequency` [rad/time]; start it at (0, 1)."""
    return np.array([[0.0, frequency], [-frequency, 0.0]])


def held_linear(A: Array, B: Array, K: Array, x0: ArrayLike, intervals: Sequence[float], samples: int = 20) -> HeldRun:
    """x' = A x + B u, u = K x(t_k) held; each interval is cut into `samples` equal steps.

    A (n, n), B (n, m), K (m, n), x0 (n,). Matrix exponentials are kept per interval length.
    """
    from recontrol.systems.sampled import zero_order_hold

    steps: dict[float, tuple[Array, Array]] = {}
    x = np.asarray(x0, dtype=float)
    state, control = [x], []
    for h in map(float, intervals):
        if h not in steps:
            steps[h] = zero_order_hold(A, B, h / samples)
        free, forced = steps[h]
        u = K @ x
        control.append(u)
        push = forced @ u
        for _ in range(samples):
            x = free @ x + push
            state.append(x)
    return _run(state, control, intervals, samples)


def held_nonlinear(
    rate: Callable[[float, Array, Array], ArrayLike],
    law: Callable[[float, Array], ArrayLike],
    x0: ArrayLike,
    intervals: Sequence[float],
    samples: int = 20,
    *,
    method: str = "DOP853",
    rtol: float = 1e-12,
    atol: float = 1e-13,
) -> HeldRun:
    """x' = rate(t, x, u) with u = law(t_k, x(t_k)) held; scipy's integrator restarts at every instant.

    Raises SampledSimulationError with time and reason if a restart does not reach the next instant.
    """
    from scipy.integrate import solve_ivp

    x, start = np.asarray(x0, dtype=float), 0.0
    state, control = [x], []
    for h in map(float, intervals):
        u = np.asarray(law(start, x), dtype=float)
        times = start + h * np.arange(1, samples + 1) / samples
        out = solve_ivp(
            lambda t, y, u=u: np.asarray(rate(t, y, u), dtype=float),
            (start, times[-1]), x, method=method, t_eval=times, rtol=rtol, atol=atol,
        )  # fmt: skip
        if not out.success:
            raise SampledSimulationError(f"{method} stopped after t = {start}: {out.message}")
        control.append(u)
        state.extend(out.y.T)
        x, start = out.y[:, -1], times[-1]
    return _run(state, control, intervals, samples)


def _run(state: list[Array], control: list[Array], intervals: Sequence[float], samples: int) -> HeldRun:
    lengths = np.asarray(intervals, dtype=float)
    instants = np.concatenate([[0.0], np.cumsum(lengths)])
    inner = np.arange(samples) / samples
    time = np.append((instants[:-1, None] + lengths[:, None] * inner).ravel(), instants[-1])
    return HeldRun(time, np.array(state), instants[:-1], np.array(control), samples)


def last_outside(time: Array, error: Array, band: float) -> float | None:
    """First sampled time after which abs(error) stays within `band` to the end; None if it never does.

    `recontrol.simulate.settling.last_exit` measures the band by each response's own peak and gives the sample before.
    """
    outside = np.flatnonzero(np.abs(error) > band)
    if outside.size == 0:
        return float(time[0])
    return None if outside[-1] + 1 == len(time) else float(time[outside[-1] + 1])
