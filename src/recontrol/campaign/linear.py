"""Outcomes of many linear loops at once.

In: a stack of loop matrices and initial states, one pair a trajectory. Out: one number a trajectory. Trajectories are
worked through in blocks, so that memory does not grow with the ensemble.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from recontrol.campaign.steppers import batched_expm

Array = Any
BLOCK_BYTES = 32 * 2**20
"""Memory of one block of states; larger blocks leave the processor's cache and are no faster."""


def blocks(A: Array, samples: int) -> Iterator[slice]:
    """Slices of the trajectories whose states fit into a block. A: (runs, n, n)."""
    size = max(1, BLOCK_BYTES // (8 * samples * A.shape[1]))
    for start in range(0, A.shape[0], size):
        yield slice(start, start + size)


def trajectories(A: Array, x0: Array, step: float, samples: int) -> Array:
    """States (runs, samples, n) of ``x' = A x`` at 0, step, 2 step, ...; exact up to rounding.

    The known samples are doubled by one product with exp(A step 2^k), so that the work is that of dense products.
    A: (runs, n, n) or (n, n) shared by all runs; x0: (runs, n); step [s].
    """
    A, x0 = np.asarray(A, dtype=float), np.asarray(x0, dtype=float)
    A = A if A.ndim == 3 else A[None]
    states = np.empty((x0.shape[0], samples, x0.shape[1]))
    states[:, 0] = x0
    jump, known = batched_expm(A * step), 1
    while known < samples:
        new = min(known, samples - known)
        np.matmul(states[:, :new], np.swapaxes(jump, 1, 2), out=states[:, known : known + new])
        jump, known = jump @ jump, known + new
    return states


def abscissa(A: Array) -> Array:
    """Largest real part of the eigenvalues of each matrix (runs,) [1/s]."""
    return np.linalg.eigvals(A).real.max(axis=1)


def integral_square(A: Array, x0: Array, rows: Array) -> Array:
    """Integral of ``|rows x|^2`` over 0..inf (runs,), from one Lyapunov equation a run; inf for an unstable matrix.

    A: (runs, n, n); x0: (runs, n); rows: (n,) or (k, n).
    """
    n = A.shape[1]
    eye, out = np.eye(n), np.full(A.shape[0], np.inf)
    rows = np.atleast_2d(rows)
    constant = -(rows.T @ rows).ravel()
    stable = abscissa(A) < 0
    for part in blocks(A, n**3):
        keep = np.flatnonzero(stable[part]) + part.start
        if not keep.size:
            continue
        transposed = np.swapaxes(A[keep], 1, 2)
        operator = np.einsum("rij,kl->rikjl", transposed, eye) + np.einsum("ij,rkl->rikjl", eye, transposed)
        gramian = np.linalg.solve(operator.reshape(-1, n * n, n * n), constant[:, None]).reshape(-1, n, n)
        out[keep] = np.einsum("ri,rij,rj->r", x0[keep], gramian, x0[keep])
    return out


def settling_and_peak(
    A: Array, x0: Array, rows: Array, *, step: float, samples: int, band: float
) -> tuple[Array, Array]:
    """Last time [s] at which the largest ``abs(rows x)`` exceeds `band` times its own peak, and the peak; each (runs,).

    A: (runs, n, n); x0: (runs, n); rows: (n,) or (k, n). The settling time is inf if the last sample is still outside.
    """
    settling, peak, rows = np.empty(x0.shape[0]), np.empty(x0.shape[0]), np.atleast_2d(rows)
    for part in blocks(A, samples):
        with np.errstate(over="ignore", invalid="ignore"):
            size = np.abs(trajectories(A[part], x0[part], step, samples) @ rows.T).max(axis=2)
        peak[part] = size.max(axis=1)
        outside = size > band * peak[part, None]
        last = samples - 1 - np.argmax(outside[:, ::-1], axis=1)
        late = np.where(last == samples - 1, np.inf, last * step)
        settling[part] = np.where(outside.any(axis=1), late, 0.0)
    return settling, peak
