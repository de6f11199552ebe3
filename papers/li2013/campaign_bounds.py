"""What is proven about every member of the ensemble of `campaign`: one norm contracts at every interval drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.campaign.proven import Bound, bounded, unproven
from recontrol.campaign.switched import BITS, contraction, transitions
from recontrol.exact.ball import precision
from recontrol.exact.rational import from_float, identity, zeros

from .campaign import BAND, DURATION, LEVELS
from .problems import exact_data, gain_box

NORM = "one quadratic norm falls over every interval, for every gain of the box"


def jitter(data: Any) -> dict[str, Bound]:
    """Settling, thrust, distance at the end and mean rate."""
    exact = exact_data(data, "")
    A, B, K = exact["A_print"], exact["B"], gain_box(data)
    periods = [exact["h"] * fmpq(k, LEVELS) for k in range(1, LEVELS + 1)]
    found = contraction(transitions(A, B, K, periods), periods)
    if found is None:
        return dict.fromkeys(("settling", "thrust", "distance", "rate"), unproven("no norm was found that falls"))
    distance = from_float(float(np.linalg.norm(data.float("x0")[0][:3])) * (1 + 1e-12))
    starts, position = np.vstack([identity(3), zeros(len(A) - 3, 3)]), identity(len(A))[:3]
    with precision(BITS):
        near = found.size(position, starts) * distance
        fade = (-found.rate * arb(DURATION)).exp()
        values = {
            "settling": (near / arb(BAND)).log() / found.rate,
            "thrust": max(arb((found.size(K[[i]], starts) * distance).upper()) for i in range(len(K))),
            "distance": near * fade,
            "rate": found.size(identity(len(A)), starts).log() / arb(DURATION) - found.rate,
        }
        return {name: bounded(float(np.nextafter(float(x.upper()), np.inf)), NORM) for name, x in values.items()}
