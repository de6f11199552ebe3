"""What is proven about every member of the ensemble of `campaign`: the two-body motion itself, not its linear model.

The relative acceleration is ``A(t, x) x`` with a matrix whose entries depend on orbit, anomaly and distance. As long
as the distance stays below `FAR`, they lie in intervals, and the loop with plant and observer is a member, varying in
time, of the box that they span; the bound of the distance then confirms `FAR`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.campaign.modes import BITS, modes
from recontrol.campaign.proven import Bound, bounded, unproven
from recontrol.campaign.tube import tube
from recontrol.exact.ball import precision
from recontrol.exact.rational import from_float, identity, zeros
from recontrol.spacecraft import orbit

from .campaign import ECCENTRICITY, HORIZON, NEAR
from .simulation.sweeps import VELOCITY_BALL

KM = 1000
FAR = fmpq(8000)  # m
PIECES = 16
GRID = 0.02  # s
END = 1.0  # m, N: where the tubes end
TUBE = "the two-body motion as a box of loops that vary in time, compared with its middle"


def start(data: Any, model: Any) -> dict[str, Bound]:
    """Cost, thrust, distance at the end and last time far away, for every orbit, anomaly and velocity error."""
    M, starts = loop(data, model), initial(data)
    found = modes(M)
    place = np.hstack([identity(6)[:3], zeros(3, 6)])
    thrust = np.hstack([-data["K"], data["K"]])
    everything = np.vstack([np.hstack([identity(6), zeros(6)]), thrust])
    tubes = [tube(found, rows, starts, step=GRID, until=END) for rows in (place, thrust, everything)]
    names = ("cost", "thrust", "distance", "near")
    if any(t is None for t in tubes) or not max(tubes[0].length) < float(FAR.p) / float(FAR.q):
        return dict.fromkeys(names, unproven("the orbit and the distance vary too much for one box around the loop"))
    way, pushed, whole = tubes
    values = (whole.energy, pushed.peak, way.length_at(HORIZON), way.near(NEAR))
    return {name: bounded(value, TUBE) for name, value in zip(names, values, strict=True)}


def initial(data: Any) -> list[Any]:
    """Starts (12, 1) of the printed state and (12, 3) of the velocity errors, for (x, x - xhat)."""
    ball = from_float(VELOCITY_BALL)
    return [np.vstack([data["x0"], zeros(6, 1)]), np.vstack([zeros(9, 3), identity(3) * ball])]


def loop(data: Any, model: Any) -> Any:
    """Box (12, 12) of the loop of x and x - xhat: printed K, corrected L, observer on the printed mean motion."""
    with precision(BITS):
        free = np.vstack([np.hstack([zeros(3), identity(3)]), accelerations(data)])
        known, B = model["A"]["n_printed"], orbit.thrust_input(data["m"])
        C = identity(6)[:3]
        upper = np.hstack([free - B @ data["K"], B @ data["K"]])
        return np.vstack([upper, np.hstack([free - known, known - data["L_corrected"] @ C])])


def accelerations(data: Any) -> Any:
    """Balls (3, 6) that hold the matrix of the relative acceleration for every orbit, anomaly and place within `FAR`.

    With c = e cos(anomaly), p the semi-latus rectum and m = gm/r^3 = gm (1 + c)^3/p^3: angular rate
    ``sqrt(gm/p^3) (1 + c)^2``, slew ``-2 m e sin(anomaly)``. What remains of gm/r^2 - gm (r + x)/d^3 is written with
    d^2 = r^2 (1 + s) and the mean value of ``(1 + s)^(-3/2)``.
    """
    gm, perigee = data["gm"] * KM**3, data["r_p"] * KM
    largest = data["e"] * from_float(ECCENTRICITY)
    out = None
    for k in range(PIECES):
        e = _between(largest * fmpq(k, PIECES), largest * fmpq(k + 1, PIECES))
        p = arb(perigee) * (1 + e)
        for j in range(-PIECES, PIECES):
            top = largest * fmpq(k + 1, PIECES)
            c = _between(top * fmpq(j, PIECES), top * fmpq(j + 1, PIECES))
            here = _acceleration(arb(gm), p, c, arb(0, arb(top).upper()), perigee)
            out = here if out is None else _hull(out, here)
    return out


def _acceleration(gm: arb, p: arb, c: arb, sine: arb, perigee: fmpq) -> Any:
    """Rows (3, 6) for one piece; sine: e sin(anomaly)."""
    m = gm * (1 + c) ** 3 / p**3
    rate, slew = (gm / p**3).sqrt() * (1 + c) ** 2, -2 * m * sine
    near = arb(0, arb(FAR / perigee).upper())  # x/r, y/r, z/r, for the target is nowhere closer than its perigee
    s = 2 * near + near * near
    cube, fifth = (1 + s) ** (-1) / (1 + s).sqrt(), (1 + s) ** (-2) / (1 + s).sqrt()
    bend = arb(3) / 2 * m * fifth * near
    turn = m * (c + 1 - cube)
    zero = arb(0)
    return np.array(
        [
            [turn + 3 * m * fifth + bend, slew + bend, bend, zero, 2 * rate, zero],
            [-slew, turn, zero, -2 * rate, zero, zero],
            [zero, zero, -m * cube, zero, zero, zero],
        ],
        dtype=object,
    )


def _between(low: fmpq, high: fmpq) -> arb:
    return arb((low + high) / 2, arb((high - low) / 2).upper())


def _hull(A: Any, B: Any) -> Any:
    return np.array([[x.union(y) for x, y in zip(*rows, strict=True)] for rows in zip(A, B, strict=True)], dtype=object)
