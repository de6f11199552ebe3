"""Printed gains and compensators as exact matrices or boxes, and the loops that they close."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact.ball import to_ball
from recontrol.exact.rational import zeros


def printed_gain(data: Any) -> np.ndarray:
    """K (1, 4) from the first row of (52) and that of (6), as the exact decimals."""
    return data["A_yaw"][:1] - data["A_c"][:1]


def printed_gain_box(data: Any) -> np.ndarray:
    """The same over the whole rounding box of (52), balls in the working precision."""
    return to_ball(data["A_yaw"][:1]) - data.ball("A_c")[:1]


def printed_reduced(values: Any) -> dict[str, np.ndarray]:
    """(66)-(69) as matrices of fitting shape from ``data.__getitem__`` (decimals) or ``data.ball`` (boxes)."""
    D_r = np.empty((1, 1), dtype=object)
    D_r[0, 0] = values("D_r")
    return {"A_r": values("A_r"), "B_r": values("B_r").T, "C_r": values("C_r"), "D_r": D_r}


def first_state(n: int) -> np.ndarray:
    """e1' (1, n), the measurement that the reduced design supposes."""
    row = zeros(1, n)
    row[0, 0] = fmpq(1)
    return row


def full_loop(plant: Any, K: np.ndarray, L: np.ndarray, Ah: np.ndarray) -> np.ndarray:
    """[A, -BK; LC, Ah]."""
    return np.block([[plant.A, -plant.B @ K], [L @ plant.C, Ah]])


def reduced_loop(plant: Any, c: np.ndarray, A_r: Any, B_r: Any, C_r: Any, D_r: Any, sign: int = 1) -> np.ndarray:
    """[A + s B D_r c, s B C_r; B_r c, A_r] for the measured signal c x; s = +1 as in (45)."""
    s = fmpq(sign)
    return np.block([[plant.A + plant.B @ D_r @ c * s, plant.B @ C_r * s], [B_r @ c, A_r]])
