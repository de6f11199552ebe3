"""Exact time responses of linear systems on a uniform grid.

In: a realisation, a step length, a number of samples. Out: states and outputs that carry no integration error: the
step input is a constant state of an augmented matrix, whose exponential is exact up to rounding.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import expm

from recontrol.systems.statespace import ShapeError, StateSpace

Array = NDArray[np.float64]


def propagate(A: ArrayLike, x0: ArrayLike, step: float, samples: int) -> Array:
    """States of ``x' = A x`` at 0, step, 2 step, ...

    Parameters
    ----------
    A : (n, n)
    x0 : (n,) or (n, batch)
        Initial states; a batch is propagated at once.
    step : float [s]
    samples : int

    Returns
    -------
    ndarray (samples, n) or (samples, n, batch)

    Notes
    -----
    The block of known samples is doubled by one multiplication with exp(A step 2^k), each taken from A itself: the
    error of a sample grows with the number of doublings, not with the number of samples.
    """
    a = np.asarray(A, dtype=float)
    first = np.asarray(x0, dtype=float)
    n = a.shape[0]
    if first.shape[0] != n:
        raise ShapeError(f"x0 has {first.shape[0]} rows, expected {n} as A is {a.shape}")
    states = first.reshape(1, n, -1)
    while states.shape[0] < samples:
        jump = expm(a * (step * states.shape[0]))
        states = np.concatenate([states, jump @ states[: samples - states.shape[0]]])
    return states[:samples].reshape(samples, *first.shape)


def augment(system: StateSpace) -> tuple[Array, Array]:
    """Matrices (M, N) of ``z' = M z``, ``y = N z`` with ``z = [x; u]`` for an input u that stays constant."""
    n, m = system.B.shape
    matrix = np.block([[system.A, system.B], [np.zeros((m, n + m))]])
    return matrix, np.hstack([system.C, system.D])


@dataclass(frozen=True)
class StepResponse:
    """Unit-step response of a single-input single-output system.

    ``times`` (N,) [s], ``outputs`` (N,); ``states`` (N, n + 1) of the augmented system, from which :meth:`at` and
    :meth:`slope` compute the output exactly at any time of the horizon.
    """

    times: Array
    outputs: Array
    states: Array
    matrix: Array
    row: Array

    def _state(self, time: float) -> Array:
        if not 0 <= time <= self.times[-1]:
            raise ValueError(f"time {time} lies outside the horizon 0..{self.times[-1]}")
        k = min(int(np.searchsorted(self.times, time, side="right")) - 1, self.times.size - 1)
        return expm(self.matrix * (time - self.times[k])) @ self.states[k]

    def at(self, time: float) -> float:
        """The output at `time` [s]."""
        return float(self.row @ self._state(time))

    def slope(self, time: float) -> float:
        """The derivative of the output at `time` [s]."""
        return float(self.row @ self.matrix @ self._state(time))


def step_response(system: StateSpace, horizon: float, samples: int, x0: ArrayLike | None = None) -> StepResponse:
    """Response to a unit step from `x0` (zero by default) on `samples` points of 0..`horizon` [s].

    Raises
    ------
    ShapeError
        If the system has more than one input or output.
    """
    if system.D.shape != (1, 1):
        raise ShapeError(f"D is {system.D.shape}, expected (1, 1): a step response of one input and one output")
    matrix, rows = augment(system)
    n = system.A.shape[0]
    initial = np.append(np.zeros(n) if x0 is None else np.asarray(x0, dtype=float), 1.0)
    states = propagate(matrix, initial, horizon / (samples - 1), samples)
    return StepResponse(np.linspace(0.0, horizon, samples), states @ rows[0], states, matrix, rows[0])


def final_value(system: StateSpace) -> float:
    """``D - C A^-1 B``: where the unit-step response ends if A is Hurwitz (not checked here)."""
    return float((system.D - system.C @ np.linalg.solve(system.A, system.B))[0, 0])
