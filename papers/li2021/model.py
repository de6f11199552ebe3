"""The plant in exact and float matrices, the flexible model, and the scalars that Table 1 fixes.

Artifact: ``exact`` and ``float`` hold the matrices of `plant.plant`; ``flexible`` the 14-state model with its modes
(A, B, states [q; eta; q'; eta']) in floats; ``controllers`` the printed gains in floats.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact.rational import to_float
from recontrol.spacecraft.flexible import linear_model

from .plant import PRINTED, controller, float_controller, floats, plant


def model(data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    exact = plant(data)
    A, B = linear_model(
        np.ravel(data["J0"]),
        data["F"],
        np.ravel(data["modal_frequency"]),
        np.ravel(data["damping_ratio"]),
        data["orbital_rate"],
    )
    return {
        "exact": exact,
        "float": floats(exact),
        "flexible": {"A": to_float(A), "B": to_float(B)},
        "controllers": {name: float_controller(controller(data, name))._asdict() for name in PRINTED},
    }
