"""What is proven about every member of the ensembles of `campaign`, from every start.

The one factor F of the gain's change is cut into pieces; in each the change is small beside the loop.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.campaign.modes import Modes, growth_bound, modes
from recontrol.campaign.proven import Bound, bounded, unproven
from recontrol.campaign.tube import COMPARED, outcome_bounds
from recontrol.exact.ball import ball
from recontrol.exact.rational import from_float, identity, zeros

from . import plant
from .campaign import BAND, INERTIA_HALF_UNIT

PIECES = {"ext": 16, "trad": 256}
GRID = 0.02  # s


def starts(data: Any) -> tuple[list[Any], float]:
    """Blocks (6, 3) of starts, a ball of angles and one of rates; and the least largest angle at the start [rad]."""
    angles, rates = (_length(part) for part in data["x0"][0].reshape(2, 3))
    blocks = [np.vstack([identity(3) * angles, zeros(3)]), np.vstack([zeros(3), identity(3) * rates])]
    return blocks, float(np.nextafter(float(angles.p) / float(angles.q) / math.sqrt(3), 0)) * (1 - 1e-12)


def _length(vector: Any) -> fmpq:
    """A rational a little above the length of an exact vector."""
    return from_float(float(np.linalg.norm([float(x.p) / float(x.q) for x in vector])) * (1 + 1e-12))


def changed(data: Any, gain: str) -> list[Modes]:
    """Modes of A + B1 (K + F M N) for each piece of F in -1..1, K in its box."""
    found = plant.matrices(data, plant.orbital_rate(data))
    change, count = found["B1"] @ data["M"], PIECES[gain]
    middle = found["A"] + found["B1"] @ plant.gain_box(data, gain)
    centres = [fmpq(2 * k + 1, count) - 1 for k in range(count)]
    tied = (change * fmpq(1, count), data["N"])
    return [modes(middle + (change @ data["N"]) * centre, tied) for centre in centres]


def of_inertia(data: Any) -> Modes:
    """Modes of the loop of K_ext over the boxes of gain, moments and orbital rate."""
    inertia = [ball(j, INERTIA_HALF_UNIT) for j in plant.inertias(data)]
    low = np.array(plant.torque_rows(inertia, plant.rate_interval(data)), dtype=object)
    lower = (low + plant.gain_box(data, "ext")) * np.array([[1 / j] for j in inertia], dtype=object)
    return modes(np.vstack([np.hstack([zeros(3), identity(3)]), lower]))


def along(pieces: list[Modes], data: Any) -> dict[str, Bound]:
    """Settling, peak, energy and abscissa over all pieces."""
    blocks, least = starts(data)
    why, level = "the start itself is a peak", BAND * least
    return outcome_bounds(pieces, identity(6)[:3], blocks, step=GRID, level=level, peaks=why, integral="energy")


def gain_ext(data: Any) -> dict[str, Bound]:
    """The extended gain, changed."""
    return along(changed(data, "ext"), data)


def gain_trad(data: Any) -> dict[str, Bound]:
    """The traditional gain, changed: some members are unstable."""
    never = unproven("some changes of the printed size make the loop unstable, and its outcomes grow without limit")
    return dict.fromkeys(("settling", "peak", "energy"), never) | {
        "abscissa": bounded(max(growth_bound(found) for found in changed(data, "trad")), COMPARED)
    }


def inertia_ext(data: Any) -> dict[str, Bound]:
    """The extended gain over its box, moments of inertia over half a unit of their last digit."""
    return along([of_inertia(data)], data)
