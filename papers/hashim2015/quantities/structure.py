"""Section 6.8: poles and zeros of the plants, and how well y and x1 show the states."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb

from recontrol.exact.ball import precision
from recontrol.exact.linalg import determinant
from recontrol.exact.polynomial import PRECISION, real_roots, roots

from .. import recipe
from ..loops import first_state
from ..model import AXES
from ..readings.formulas import krylov


def observability(plant: recipe.Plant) -> dict[str, np.ndarray]:
    """Observability matrix for the output y and for x1."""
    return {"y": krylov(plant.A.T, plant.C.T).T, "x1": krylov(plant.A.T, first_state(plant.n).T).T}


def slow_pair_to_zeros(plant: recipe.Plant, data: Any) -> arb:
    """Distance of the slow estimator pair to the nearest zero of the plant, upper half plane."""
    with precision(PRECISION):
        slow = recipe.estimator_poles(plant, data["weight_high"])[2]
        zero = next(z for z in roots(plant.b) if z.imag > 0)
        return abs(slow - zero)


def quantities(data: Any, model: Any) -> dict[str, Any]:
    """Names of paper.yaml, section 6.8."""
    plants = {axis: recipe.plant_of(model, axis) for axis in AXES}
    matrices = {f"{axis}, {name}": matrix for axis in AXES for name, matrix in observability(plants[axis]).items()}
    singular = {name: np.linalg.svd(matrix.astype(float), compute_uv=False) for name, matrix in matrices.items()}
    return {
        "plant_poles": {axis: roots(plants[axis].a) for axis in AXES},
        "plant_zeros": {axis: roots(plants[axis].b) for axis in AXES if plants[axis].b.degree() > 0},
        "pitch_time_constant": {axis: 1 / real_roots(plants[axis].a)[-1] for axis in ("pitch-tf", "pitch-ss")},
        "slow_pair_to_zeros": slow_pair_to_zeros(plants["yaw"], data),
        "observability_determinant": {name: determinant(matrix) for name, matrix in matrices.items()},
        "observability_singular": {name: float(values[-1]) for name, values in singular.items()},
        "observability_condition": {name: float(values[0] / values[-1]) for name, values in singular.items()},
    }
