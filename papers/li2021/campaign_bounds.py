"""What is proven about every member of the ensembles of `campaign`, from the printed start.

One Lyapunov function and one diagonal multiplier, so that the bounds also hold for parameters that vary in time; the
disk of the poles is about frozen ones.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.campaign.ellipsoid import ellipsoid, in_disk
from recontrol.campaign.proven import Bound, bounded, certified
from recontrol.exact.rational import identity, to_float

from .campaign import BAND
from .problems import problem_data

RADIUS = fmpq(105, 100)  # 1/s
LYAPUNOV = "one Lyapunov function and diagonal multipliers for all parameters"


def drifting(data: Any, case: str, rate: fmpq) -> dict[str, Bound]:
    """Bounds of all outcomes but the radius for a case of `problems`; rate [1/s]: the decay that is tried."""
    loop = problem_data(data, case)
    start, angles = loop["xi0"], [identity(12)[[i]] for i in range(3)]
    largest = float(np.abs(to_float(data["q0"])).max())
    resting, decaying = ellipsoid(loop, angles, start, fmpq(0)), ellipsoid(loop, angles, start, rate)
    torque = ellipsoid(loop, [loop["K"]], start, fmpq(0))
    # The rows of C_f drift too: their change is not in the rows of the nominal torque.
    drift = 1 + float(data.float("drift_bound"))
    return {
        "settling": bounded(decaying and decaying.settled(BAND * largest), f"{LYAPUNOV}; the start is a peak", "exact"),
        "peak": bounded(resting and resting.size, LYAPUNOV, "exact"),
        "torque": bounded(torque and float(np.nextafter(torque.size * drift, np.inf)), LYAPUNOV, "exact"),
        "abscissa": bounded(decaying and -decaying.rate, LYAPUNOV, "exact"),
    }


def radius(data: Any, case: str) -> Bound:
    """Radius of the disk of the poles for the channels of a case."""
    holds = in_disk(problem_data(data, case), data["disk_a"], RADIUS)
    return bounded(float(to_float(RADIUS)) if holds else None, LYAPUNOV, "exact")


def gain_drift(data: Any, certificates: Any) -> dict[str, Bound]:
    """Every drift of the gains, nominal inertia."""
    return drifting(data, "gains-proposed", fmpq(15, 100)) | {
        "radius": certified(certificates, "disk-drift", data.float("disk_b"))
    }


def drift_inertia(data: Any) -> dict[str, Bound]:
    """Every drift and every inertia of the envelope."""
    return drifting(data, "all-proposed", fmpq(12, 100)) | {"radius": radius(data, "all-proposed")}
