"""Experiment 4 and the pitch axis: what the small plant coefficient does to a design that measures the rate x1.

Values: stability of the x1 design for 7.1138e-3 on plants with another coefficient, and of the corrected design beside
it; how little K and L and how much the x1-based gain move between the two printed coefficients. Series: Nyquist curves.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.systems.margins import loop_transfer
from recontrol.systems.statespace import StateSpace, loop_matrix, spectral_abscissa

from . import designs

AXIS = "pitch-tf"
COEFFICIENTS = ("0", "0.0070", "0.0071", "0.00711", "7.1138e-3", "0.0072")
FREQUENCIES = np.concatenate([[0.0], np.geomspace(1e-3, 1e4, 1400)])


def with_coefficient(loop: designs.Loop, coefficient: float) -> StateSpace:
    """The plant of the loop with another entry (1,2)."""
    A = loop.plant.A.copy()
    A[0, 1] = coefficient
    return loop.plant._replace(A=A)


def on_other_plants(loop: designs.Loop) -> dict[str, Any]:
    """Eigenvalues and spectral abscissa of the loop for each coefficient of the plant."""
    found = {}
    for text in COEFFICIENTS:
        matrix = loop_matrix(with_coefficient(loop, float(text)), loop.compensator)
        eigenvalues = np.linalg.eigvals(matrix)
        found[text] = {
            "eigenvalues": eigenvalues[np.lexsort((eigenvalues.imag, eigenvalues.real))].astype(complex),
            "spectral_abscissa": spectral_abscissa(matrix),
        }
    return found


def singular_coefficient(loop: designs.Loop) -> float:
    """Plant coefficient at which the loop matrix is singular: its determinant is affine in the coefficient."""
    at = {x: np.linalg.det(loop_matrix(with_coefficient(loop, x), loop.compensator)) for x in (0.0, 1.0)}
    return float(at[0.0] / (at[0.0] - at[1.0])) + 0.0


def relative_change(new: np.ndarray, old: np.ndarray) -> float:
    """Largest entry of abs(new - old) over the largest entry of abs(old)."""
    return float(np.max(np.abs(new - old)) / np.max(np.abs(old)))


def between_roundings(synthesis: dict[str, Any]) -> dict[str, float]:
    """Change of each gain when the coefficient is 0.0071 in place of 7.1138e-3."""
    tf, ss = synthesis["gains"]["pitch-tf"], synthesis["gains"]["pitch-ss"]
    return {
        "K": relative_change(ss["K"], tf["K"]),
        "L": relative_change(ss["L"]["exact"], tf["L"]["exact"]),
        "Lr_x1": relative_change(np.atleast_1d(ss["Lr"]["exact"]), np.atleast_1d(tf["Lr"]["exact"])),
        "Lr_corrected": relative_change(np.atleast_1d(ss["corrected"]["L"]), np.atleast_1d(tf["corrected"]["L"])),
    }


def pitch(model: dict[str, Any], synthesis: dict[str, Any]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    values: dict[str, Any] = {"plants": {}, "between_roundings": between_roundings(synthesis), "compensator_poles": {}}
    series: dict[str, np.ndarray] = {"omega": FREQUENCIES}
    for design in ("x1", "corrected", "full"):
        loop = designs.loop_of(model, synthesis, AXIS, design)
        values["plants"][design] = {
            "coefficients": on_other_plants(loop),
            "singular_at": singular_coefficient(loop),
        }
        values["compensator_poles"][design] = np.linalg.eigvals(loop.compensator.A).astype(complex)
        num, den = loop_transfer(loop.plant, loop.compensator)
        curve = np.polyval(num, 1j * FREQUENCIES) / np.polyval(den, 1j * FREQUENCIES)
        series[f"{design}/real"], series[f"{design}/imag"] = curve.real, curve.imag
    values["estimator_gain"] = {
        "x1": np.atleast_1d(synthesis["gains"][AXIS]["Lr"]["exact"]).ravel(),
        "corrected": np.atleast_1d(synthesis["gains"][AXIS]["corrected"]["L"]).ravel(),
    }
    return values, series
