"""Fixed-step Runge-Kutta integration of many runs at once.

In: a right side of states shaped (n, runs), a step, a number of steps. Out: the sampled states. All runs share the time
axis, so an ensemble costs little more than one run; inputs that are held over a step see the number of the step.
"""

from collections.abc import Callable

import numpy as np

Array = np.ndarray


def rk4(
    rhs: Callable[[int, float, Array], Array],
    x0: Array,
    step: float,
    steps: int,
    *,
    every: int = 1,
    observe: Callable[[int, float, Array], Array] = lambda k, t, x: x,
) -> tuple[Array, Array]:
    """Samples of ``x' = rhs(k, t, x)`` by the classical fourth-order scheme.

    Parameters
    ----------
    rhs : function of the number of the step, the time [s] and the states (n, runs)
    x0 : (n, runs), the states at time 0
    step, steps : step [s] and how many
    every : keep each such sample; `steps` must be a multiple of it
    observe : what to keep of a sample, a function of the same arguments as `rhs`; the states if left out

    Returns
    -------
    times (samples,) [s] and samples (samples, ...)
        A run that leaves the range of doubles goes on as NaN and does not disturb the others.
    """
    if steps % every:
        raise ValueError(f"expected a number of steps divisible by every = {every}, found {steps}")
    x = np.array(x0, dtype=float)
    first = observe(0, 0.0, x)
    kept = np.empty((steps // every + 1, *first.shape))
    kept[0] = first
    with np.errstate(all="ignore"):
        for k in range(steps):
            t = k * step
            k1 = rhs(k, t, x)
            k2 = rhs(k, t + step / 2, x + (step / 2) * k1)
            k3 = rhs(k, t + step / 2, x + (step / 2) * k2)
            k4 = rhs(k, t + step, x + step * k3)
            x = x + (step / 6) * (k1 + 2 * (k2 + k3) + k4)
            if (k + 1) % every == 0:
                kept[(k + 1) // every] = observe(k + 1, t + step, x)
    return np.arange(steps // every + 1) * (every * step), kept
