"""Rigid plant and both printed controllers for `recontrol.load`, from angles [rad] to torque [N m], u = C_f x_f."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import plant


def systems(data: Any, model: Any, synthesis: Any) -> dict[str, tuple[Any, Any, Any, Any]]:
    """Name -> (A, B, C, D): ``plant`` with the modes eliminated, ``flexible`` with them, the controllers as printed."""
    rigid, flexible, through = plant.plant(data), model["flexible"], np.zeros((3, 3))
    return {
        "plant": (rigid["A"], rigid["B"], rigid["C"], through),
        "flexible": (flexible["A"], flexible["B"], np.eye(3, 14), through),
        "controller": (*plant.controller(data, "proposed"), through),
        "ref39": (*plant.controller(data, "ref39"), through),
    }
