"""Second routes that several tests hold the library against."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp


def integrated_monodromy(system: Callable[[float], np.ndarray], period: float) -> np.ndarray:
    """Monodromy matrix (n, n) of ``x' = system(t) x`` over one period, integrated in doubles at 1e-12 with DOP853."""
    n = len(system(0.0))

    def rhs(t: float, x: np.ndarray) -> np.ndarray:
        return (system(t) @ x.reshape(n, n)).ravel()

    run = solve_ivp(rhs, (0.0, period), np.eye(n).ravel(), method="DOP853", rtol=1e-12, atol=1e-15)
    assert run.success, run.message
    return run.y[:, -1].reshape(n, n)
