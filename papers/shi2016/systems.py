"""Plant and published gains for `recontrol.load`: u = K x with angles [rad], rates [rad/s] and torques [N m]."""

from __future__ import annotations

from typing import Any

import numpy as np

from .plant import DEFAULT


def systems(data: Any, model: Any, synthesis: Any) -> dict[str, tuple[Any, Any, Any, Any]]:
    """Name -> (A, B, C, D): the plant from torque to state, both gains as static systems."""
    entry = model[DEFAULT]
    A, B = entry["A"], entry["B1"]
    return {
        "plant": (A, B, np.eye(6), np.zeros((6, 3))),
        "controller": ([], [], [], data["K_ext"]),
        "traditional": ([], [], [], data["K_trad"]),
    }
