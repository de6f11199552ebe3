"""Numerical integration of ``x' = f(t, x)``: the cross-check of exact stepping, and the way of nonlinear models.

In: a right side, an initial state, output times. Out: states at these times, or an error that says where it stopped.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from recontrol.systems.statespace import StateSpace

Array = NDArray[np.float64]


class IntegrationError(RuntimeError):
    """The integrator did not reach the end of the horizon."""


def integrate(
    rhs: Callable[[float, Array], ArrayLike],
    x0: ArrayLike,
    times: ArrayLike,
    *,
    method: str = "DOP853",
    rtol: float = 1e-11,
    atol: float | ArrayLike = 1e-13,
    max_step: float = np.inf,
) -> Array:
    """States of ``x' = rhs(t, x)`` at `times`, shape (len(times), n).

    Parameters
    ----------
    rhs : function of time [s] and state (n,)
    x0 : (n,), the state at times[0]
    times : increasing [s]
    method, rtol, atol, max_step : as for ``scipy.integrate.solve_ivp``; DOP853 is of order 8, RK45 of order 5

    Raises
    ------
    IntegrationError
        With the integrator's message and the time reached.
    """
    from scipy.integrate import solve_ivp

    grid = np.asarray(times, dtype=float)
    found = solve_ivp(
        rhs, (grid[0], grid[-1]), np.asarray(x0, dtype=float),
        t_eval=grid, method=method, rtol=rtol, atol=atol, max_step=max_step,
    )  # fmt: skip
    if not found.success or found.y.shape[1] != grid.size:
        reached = found.t[-1] if found.t.size else grid[0]
        raise IntegrationError(f"{method} stopped at t = {reached:g} s of {grid[-1]:g} s: {found.message}")
    return found.y.T


def step_outputs(
    system: StateSpace, times: ArrayLike, *, method: str = "DOP853", rtol: float = 1e-11, atol: float = 1e-13
) -> Array:
    """Unit-step output of a single-input system at `times` by numerical integration, shape (len(times), n_y)."""
    A, B, C, D = system
    b = B[:, 0]
    states = integrate(lambda _t, x: A @ x + b, np.zeros(A.shape[0]), times, method=method, rtol=rtol, atol=atol)
    return states @ C.T + D[:, 0]
