"""Augmented plant and published gain for `recontrol.load`: u = K xi with position, velocity and integral of position.

Units: m, m/s, m s and N. The paper holds u constant between samples that are half a second apart at most: here the
gain acts continuously.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import problems as pr


def systems(data: Any, model: Any, synthesis: Any) -> dict[str, tuple[Any, Any, Any, Any]]:
    """Name -> (A, B, C, D): the plant of (12) from thrust to xi at the printed orbital rate, the gain as static."""
    exact = pr.exact_data(data, "")
    return {
        "plant": (exact["A_print"], exact["B"], np.eye(9), np.zeros((9, 3))),
        "controller": ([], [], [], exact["K"]),
    }
