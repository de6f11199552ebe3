"""Batches of closed loops in floats: vertices, drift, inertia deviations, with and without the flexible modes."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.systems.output_feedback import Controller

from .plant import DELTA_D, DELTA_G

Array = np.ndarray


def rigid_loops(p: dict[str, Array], c: Controller) -> Array:
    """Loops (batch, 12, 12) of the nominal rigid plant and a batch of controllers."""
    A = np.zeros((len(c.A), 12, 12))
    A[:, :6, :6] = p["A"]
    A[:, :6, 6:] = p["B"] @ c.C
    A[:, 6:, :6] = c.B @ p["C"]
    A[:, 6:, 6:] = c.A
    return A


def rigid_family(p: dict[str, Array], c: Controller, delta: Array) -> tuple[Array, Array]:
    """Loops (batch, 12, 12) and input columns (batch, 12, 3) at inertia deviations delta (batch, 3).

    The term of the inertia error on the acceleration is solved for: ``x' = (I + [0; M0^-1] Delta J)^-1 (...)``.
    """
    A = rigid_loops(p, c)
    diagonal = np.hstack([delta[:, DELTA_G], delta[:, DELTA_D]])
    A[:, :6, :6] += (p["L"] * diagonal[:, None, :]) @ p["K"]
    B = np.zeros((len(A), 12, 3))
    B[:, :6] = p["B"]
    envelope = np.diagonal(p["W"][:, 3:])
    descriptor = np.eye(3) + p["B"][3:] * (delta * envelope)[:, None, :]
    A[:, 3:6] = np.linalg.solve(descriptor, A[:, 3:6])
    B[:, 3:6] = np.linalg.solve(descriptor, B[:, 3:6])
    return A, B


def flexible_loops(plants: Array, inputs: Array, c: Controller) -> Array:
    """Loops (batch, 20, 20) of flexible plants (batch or 1, 14, 14) with states [q; eta; q'; eta'; x_f]."""
    A = np.zeros((len(c.A), 20, 20))
    A[:, :14, :14] = plants
    A[:, :14, 14:] = inputs @ c.C
    A[:, 14:, :3] = c.B
    A[:, 14:, 14:] = c.A
    return A


def flexible_plants(data: Any, delta: Array) -> tuple[Array, Array]:
    """Flexible plants (batch, 14, 14) and inputs (batch, 14, 3) at inertia deviations delta (batch, 3)."""
    from recontrol.spacecraft.flexible import linear_model

    J = np.ravel(data.float("J0")) * (1 + np.ravel(data.float("inertia_envelope")) * delta)
    rest = [np.ravel(data.float(name)) for name in ("modal_frequency", "damping_ratio")]
    models = [linear_model(row, data.float("F"), *rest, data.float("orbital_rate")) for row in J]
    return np.stack([A for A, _ in models]), np.stack([B for _, B in models])


def gain(A: Array, B: Array, C: Array) -> Array:
    """Largest singular value of the static gain ``-C A^-1 B`` of each loop (batch,)."""
    return np.linalg.norm(-C @ np.linalg.solve(A, B), 2, axis=(-2, -1))
