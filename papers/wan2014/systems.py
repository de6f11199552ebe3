"""Plant and published observer-based controller for `recontrol.load`, from position [m] to thrust [N], u = -K xhat."""

from __future__ import annotations

from typing import Any

import numpy as np

from .model import plant


def systems(data: Any, model: Any, synthesis: Any) -> dict[str, tuple[Any, Any, Any, Any]]:
    """Name -> (A, B, C, D) at the printed mean motion; the controller has the observer gain with L21 mended."""
    found = plant(data, data["n_printed"])
    A, B, C, K, L = found["A"], found["B"], data["C"], data["K"], data["L_corrected"]
    return {
        "plant": (A, B, C, np.zeros((3, 3))),
        "controller": (A - B @ K - L @ C, L, -K, np.zeros((3, 3))),
    }
