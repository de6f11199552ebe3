"""The printed reduced compensator (66)-(69) on the yaw plant, fed with x1 as (28) assumes, and with the output y.

Values: eigenvalues of both loops, of the recomputed one, and how far the printing moved them. Series: the response to
x(0) = e2 from xc(0) = 0.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.linear import propagate
from recontrol.systems.statespace import StateSpace, loop_matrix, spectral_abscissa, state_space

from ..analysis import nearest
from . import designs

HORIZON, SAMPLES = 60.0, 2401  # s


def printed_reduced(data: Any) -> StateSpace:
    """(66)-(69) as printed, (67) as the column that it must be; u = +(C_r xc + D_r m)."""
    return state_space(data.float("A_r"), data.float("B_r").ravel(), data.float("C_r").ravel(), data.float("D_r"))


def published(
    model: dict[str, Any], synthesis: dict[str, Any], data: Any
) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    plant, printed = designs.plant_of(model, "yaw"), printed_reduced(data)
    found = synthesis["gains"]["yaw"]["x1"]["typed4"]
    recomputed = state_space(found["A"], found["B"], found["C"], found["D"])
    start = np.zeros(7)
    start[1] = 1.0
    values: dict[str, Any] = {"loops": {}}
    series = {"t": np.linspace(0.0, HORIZON, SAMPLES)}
    for name, seen in (("x1", designs.first_state(plant)), ("y", plant)):
        matrix = loop_matrix(seen, printed)
        values["loops"][name] = {
            "eigenvalues": np.linalg.eigvals(matrix).astype(complex),
            "spectral_abscissa": spectral_abscissa(matrix),
        }
        series[name] = propagate(matrix, start, HORIZON / (SAMPLES - 1), SAMPLES)[:, :4] @ plant.C[0]
    eigenvalues = np.linalg.eigvals(loop_matrix(designs.first_state(plant), recomputed)).astype(complex)
    values["recomputed"] = eigenvalues
    values["largest_shift"] = float(np.max(nearest(values["loops"]["x1"]["eigenvalues"], eigenvalues)))
    return values, series
