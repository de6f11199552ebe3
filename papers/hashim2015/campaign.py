"""Robustness ensembles: what the rounding of the print and the start of the satellite make of the loops of yaw.

Gains and matrices are drawn uniformly over the rounding boxes of the print, plant coefficients over half a unit of
their last place; initial states as in the regulator experiment: uniform directions of length one, estimates at zero.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.campaign.draws import boxed, directions
from recontrol.campaign.linear import abscissa, integral_square, settling_and_peak
from recontrol.exact.rational import to_float

from .simulation.regulator import BAND

STEP, SAMPLES = 0.1, 1601  # s
COEFFICIENT_HALF_UNIT = fmpq(1, 20000)
"""(1), (3), (6), (8) and (12), (14) print four decimals."""

Outcomes = dict[str, np.ndarray]


def assembled(blocks: list[list[np.ndarray]]) -> np.ndarray:
    """Stack (count, n, n) of block matrices; a block without a first axis is shared by all."""
    count = max(block.shape[0] for row in blocks for block in row if block.ndim == 3)
    rows = [[np.broadcast_to(b, (count, *b.shape[-2:])) for b in row] for row in blocks]
    return np.concatenate([np.concatenate(row, axis=2) for row in rows], axis=1)


def outcomes(A: np.ndarray, x0: np.ndarray, row: np.ndarray) -> Outcomes:
    """Settling time [s], peak and integral of the square of ``row x``, spectral abscissa [1/s]."""
    settling, peak = settling_and_peak(A, x0, row, step=STEP, samples=SAMPLES, band=BAND)
    return {"settling": settling, "peak": peak, "ise": integral_square(A, x0, row), "abscissa": abscissa(A)}


def full_order(rng: Any, count: int, data: Any) -> Outcomes:
    """K and L over the boxes of (52) and (54), random starts; the error starts at the state itself."""
    A, B, C = (data.float(name) for name in ("A_yaw", "B_yaw", "C_yaw"))
    K = A[:1] - boxed(rng, count, data, "A_c")[:, :1]
    L = boxed(rng, count, data, "L")
    x0 = directions(rng, (count, 4))
    loop = assembled([[A - B @ K, B @ K], [np.zeros((4, 4)), A - L @ C]])
    return outcomes(loop, np.hstack([x0, x0]), np.append(C[0], np.zeros(4)))


def reduced_members(rng: Any, count: int, data: Any, measured: np.ndarray) -> np.ndarray:
    """Loops (count, 7, 7) of members of the box of (66)-(69), fed with the signal ``measured @ x``."""
    A, B = data.float("A_yaw"), data.float("B_yaw")
    A_r, C_r, D_r = (boxed(rng, count, data, name) for name in ("A_r", "C_r", "D_r"))
    B_r = np.swapaxes(boxed(rng, count, data, "B_r"), 1, 2)
    return assembled([[A + B @ D_r @ measured, B @ C_r], [B_r @ measured, A_r]])


def reduced_x1(rng: Any, count: int, data: Any) -> Outcomes:
    """(66)-(69) over their boxes, fed with the first state; random starts, the compensator at zero."""
    loop = reduced_members(rng, count, data, np.eye(1, 4))
    x0 = np.hstack([directions(rng, (count, 4)), np.zeros((count, 3))])
    return outcomes(loop, x0, np.append(data.float("C_yaw")[0], np.zeros(3)))


def reduced_y(rng: Any, count: int, data: Any) -> Outcomes:
    """(66)-(69) over their boxes, fed with the output that the satellite measures."""
    rate = abscissa(reduced_members(rng, count, data, data.float("C_yaw")))
    with np.errstate(divide="ignore"):
        return {"abscissa": rate, "doubling": np.where(rate > 0, np.log(2) / rate, np.inf)}


def rounded_plant(rng: Any, count: int, model: Any, synthesis: Any, axis: str) -> Outcomes:
    """Plant coefficients over half a unit of the last place; recomputed full-order and corrected compensators."""
    found: Outcomes = {}
    plant, gains = model[axis], synthesis["gains"][axis]
    n = plant["A"].shape[0]
    spread = float(to_float(COEFFICIENT_HALF_UNIT)) * rng.uniform(-1, 1, (2, count, n))
    A = np.broadcast_to(plant["A"], (count, n, n)).copy()
    A[:, 0] += spread[0] * (plant["A"][0] != 0)
    C = plant["C"] + spread[1][:, None] * (plant["C"] != 0)
    x0 = directions(rng, (count, n))
    for name, design in (("full", gains["full"]["exact"]), ("reduced", gains["corrected"])):
        A_c, B_c, C_c, D_c, L = (np.atleast_2d(design[key]) for key in ("A", "B", "C", "D", "L"))
        loop = assembled([[A + plant["B"] @ D_c @ C, plant["B"] @ C_c], [B_c @ C, A_c]])
        # A zero estimate: the reduced compensator's own state then starts at -L y.
        first = np.zeros((count, n)) if name == "full" else -(L @ (C @ x0[:, :, None]))[:, :, 0]
        row = np.append(plant["C"][0], np.zeros(A_c.shape[0]))
        here = outcomes(loop, np.hstack([x0, first]), row)
        found |= {f"{name}-{key}": here[key] for key in ("settling", "ise", "abscissa")}
    return found


def plant_yaw(rng: Any, count: int, model: Any, synthesis: Any) -> Outcomes:
    """The rounded plant of yaw."""
    return rounded_plant(rng, count, model, synthesis, "yaw")


def plant_roll(rng: Any, count: int, model: Any, synthesis: Any) -> Outcomes:
    """The rounded plant of roll, whose zeros lie in the right half plane."""
    return rounded_plant(rng, count, model, synthesis, "roll")
