"""Names and marks that the figures of this paper share."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

Curves = dict[str, tuple[np.ndarray, np.ndarray]]

AXES = {"yaw": "yaw", "pitch-tf": "pitch", "roll": "roll"}
FULL, CORRECTED, X1 = plotting.SERIES[:3]
DESIGNS = {
    "full": ("full order", FULL),
    "corrected": ("reduced order, $y$ measured", CORRECTED),
    "x1": ("reduced order, $x_1$ measured", X1),
}
AXIS_SERIES = dict(zip(AXES, plotting.SERIES[:3], strict=True))


def finite(value: Any) -> float | None:
    """The number of an artifact, or None for the word that stands for infinity."""
    return None if isinstance(value, str) or value is None else float(value)


def as_curve(x: Any, y: Any) -> tuple[np.ndarray, np.ndarray]:
    """Two equally long arrays."""
    return np.atleast_1d(np.asarray(x, dtype=float)), np.atleast_1d(np.asarray(y, dtype=float))
