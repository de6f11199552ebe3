"""Section 5: gains, poles, the corrected design as a transfer function, how sharply the print identifies the recipe."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly

from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION, charpoly, left_roots, place_estimator, reflect

from .. import recipe
from ..model import AXES


def transfer_function(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Numerator and monic denominator of C (sI - A)^-1 B + D, ascending balls; does not depend on the basis."""
    with precision(PRECISION):
        denominator = charpoly(A)
        numerator = charpoly(A - B @ C) - denominator + denominator * D[0, 0]
    return (np.array(p.coeffs(), dtype=object) for p in (numerator, denominator))  # type: ignore[return-value]


def kalman_is_dual(plant: recipe.Plant, weight: fmpq) -> bool:
    """Whether W = weight BB', V = 1 has the spectral polynomial of Q = weight C'C, R = 1: exact.

    The filter is the LQR design of (A', C') with state weight W, so its poles are the Hurwitz factor of
    a(s)a(-s) + weight c(s)c(-s), c the numerator of B'(sI - A')^-1 C'.
    """
    dual = recipe.Plant(plant.A.T, plant.C.T, plant.B.T)
    filter_spectrum = dual.a * reflect(dual.a) + dual.b * reflect(dual.b) * weight
    return bool(filter_spectrum == recipe.lqr_spectrum(plant, weight))


def typed_gain(plant: recipe.Plant, weight: fmpq) -> np.ndarray:
    """L.typed4, exact."""
    typed: fmpq_poly = recipe.typed_poly(recipe.typed(recipe.estimator_poles(plant, weight)))
    return place_estimator(plant.A, plant.C, typed)


def rejected_table(synthesis: Any) -> dict[str, list[float]]:
    """Largest deviation, matching entries and number of entries of each rejected recipe."""
    return {
        f"{gain}: {row['reading']}": [row["deviation"], float(row["matching"]), float(row["of"])]
        for gain, rows in synthesis["rejected"].items()
        for row in rows
    }


def quantities(data: Any, model: Any, synthesis: Any) -> dict[str, Any]:
    """Names of paper.yaml, section 5."""
    plants = {axis: recipe.plant_of(model, axis) for axis in AXES}
    balls = {axis: synthesis["gains"][axis]["balls"] for axis in AXES}
    weight = data["weight_high"]
    corrected = {axis: tuple(transfer_function(*(balls[axis]["corrected"][name] for name in "ABCD"))) for axis in AXES}
    found = synthesis["identifiability"]
    return {
        "gain_K": {axis: balls[axis]["K"] for axis in AXES},
        "gain_L_exact": {axis: balls[axis]["L"]["exact"] for axis in AXES},
        "gain_L_typed4": {axis: typed_gain(plants[axis], weight) for axis in AXES},
        "gain_Lr_exact": {axis: balls[axis]["x1"]["exact"]["L"] for axis in AXES},
        "gain_Lr_typed4": {axis: balls[axis]["x1"]["typed4"]["L"] for axis in AXES},
        "gain_Lr_corrected": {axis: balls[axis]["corrected"]["L"] for axis in AXES},
        "controller_poles": {
            axis: left_roots(recipe.lqr_spectrum(plants[axis], recipe.CONTROL_WEIGHT)) for axis in AXES
        },
        "estimator_poles": {axis: recipe.estimator_poles(plants[axis], weight) for axis in AXES},
        "kalman_is_dual": {axis: kalman_is_dual(plants[axis], weight) for axis in AXES},
        "riccati_trace": {axis: [synthesis["lqr"][axis]["trace"][end] for end in ("lower", "upper")] for axis in AXES},
        "gain_K_spread": {
            f"{axis}: {route}": spread
            for axis in AXES
            for route, spread in synthesis["lqr"][axis]["spread"].items()
            if route != "spectral factor"
        },
        "corrected_numerator": {axis: corrected[axis][0] for axis in AXES},
        "corrected_denominator": {axis: corrected[axis][1] for axis in AXES},
        "rejected_readings": rejected_table(synthesis),
        "q_interval_K": {end: found["K"][end] for end in ("lower", "upper")},
        "q_interval_poles": {end: found["poles"][end] for end in ("lower", "upper")},
        "L_last_move": found["L_last"]["move"],
    }
