"""Robustness ensembles: a constant change of the gain of the printed size, and the rounding of gain and inertia.

The gain is K + F M N with F uniform in -1..1, K uniform over its rounding box (half a unit of the fourth decimal where
the print is not zero). Initial states: a uniform direction, of the length of the printed state. No disturbance.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.campaign.draws import boxed, directions
from recontrol.campaign.linear import abscissa, integral_square, settling_and_peak
from recontrol.exact.rational import to_float

from . import plant

STEPS = {"ext": (0.1, 1201), "trad": (2.0, 1601)}
"""Sampling step [s] and number of samples: the second gain is some fifty times slower."""
BAND = 0.05
INERTIA_HALF_UNIT = fmpq(1, 2)  # kg m^2; the moments are printed as integers


def starts(rng: Any, count: int, data: Any) -> np.ndarray:
    """Initial states (count, 6): each of angles and rates [rad, rad/s] turned at random, its length kept."""
    printed = data.float("x0")[0]
    lengths = np.linalg.norm(printed.reshape(2, 3), axis=1)
    return (directions(rng, (count, 2, 3)) * lengths[:, None]).reshape(count, 6)


def outcomes(A: np.ndarray, x0: np.ndarray, gain: str) -> dict[str, np.ndarray]:
    """Settling time [s], largest angle [rad], integral of the squared angles [rad^2 s], spectral abscissa [1/s].

    The first three are infinite for an unstable loop.
    """
    step, samples = STEPS[gain]
    angles = np.eye(3, 6)
    settling, peak = settling_and_peak(A, x0, angles, step=step, samples=samples, band=BAND)
    rate = abscissa(A)
    settling, peak = (np.where(rate < 0, value, np.inf) for value in (settling, peak))
    return {"settling": settling, "peak": peak, "energy": integral_square(A, x0, angles), "abscissa": rate}


def changed_gain(rng: Any, count: int, data: Any, gain: str) -> dict[str, np.ndarray]:
    """Loops whose gain is off by F M N, F constant."""
    found = plant.float_plant(data)
    factor = rng.uniform(-1, 1, (count, 1, 1))
    K = boxed(rng, count, data, plant.GAINS[gain], zeros_exact=True) + factor * (data.float("M") @ data.float("N"))
    return outcomes(found["A"] + found["B1"] @ K, starts(rng, count, data), gain)


def gain_ext(rng: Any, count: int, data: Any) -> dict[str, np.ndarray]:
    """The extended gain, changed."""
    return changed_gain(rng, count, data, "ext")


def gain_trad(rng: Any, count: int, data: Any) -> dict[str, np.ndarray]:
    """The traditional gain, changed."""
    return changed_gain(rng, count, data, "trad")


def inertia_ext(rng: Any, count: int, data: Any) -> dict[str, np.ndarray]:
    """The extended gain over its box, moments of inertia over half a unit of their last digit."""
    rate = float(plant.orbital_rate(data))
    nominal = data.float("inertia")[0]
    inertia = nominal + to_float(INERTIA_HALF_UNIT) * rng.uniform(-1, 1, (count, 3))
    low = np.zeros((count, 3, 6))
    for i, row in enumerate(plant.torque_rows(inertia.T, rate)):
        for j, entry in enumerate(row):
            low[:, i, j] = entry
    A = np.zeros((count, 6, 6))
    A[:, :3, 3:] = np.eye(3)
    K = boxed(rng, count, data, plant.GAINS["ext"], zeros_exact=True)
    A[:, 3:] = (low + K) / inertia[:, :, None]
    return outcomes(A, starts(rng, count, data), "ext")
