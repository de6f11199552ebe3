"""Plant and published compensators of yaw for `recontrol.load`; a compensator goes from y (or x1) to u = +(...)."""

from __future__ import annotations

from typing import Any

import numpy as np

from .model import plants


def systems(data: Any, model: Any, synthesis: Any) -> dict[str, tuple[Any, Any, Any, Any]]:
    """Name -> (A, B, C, D) from the printed matrices alone.

    ``controller`` is the full-order compensator A - BK - LC of (64), (65), (54), never (55); ``reduced`` is (66)-(69),
    which is stable only if it is fed with the first state.
    """
    yaw = plants(data)["yaw"]
    A, B, C = yaw["A"], yaw["B"], yaw["C"]
    K = np.hstack([np.atleast_2d(data["K1"]), data["K2"]])
    L = np.reshape(data["L"], (-1, 1))
    return {
        "plant": (A, B, C, [[0]]),
        "controller": (A - B @ K - L @ C, L, -K, [[0]]),
        "reduced": (data["A_r"], data["B_r"].T, data["C_r"], [[data["D_r"]]]),
    }
