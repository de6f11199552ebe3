"""What is proven about every member of the ensembles of `campaign`, from every start."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.campaign.ellipsoid import ellipsoid, energy
from recontrol.campaign.growth import least_growth
from recontrol.campaign.least import least_peak
from recontrol.campaign.modes import Modes, modes
from recontrol.campaign.proven import Bound, bounded, unproven
from recontrol.campaign.tube import TOO_WIDE, outcome_bounds
from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION
from recontrol.exact.rational import diagonal, from_float, identity, rational, to_float, zeros
from recontrol.lmi.scaling import power_of_two

from . import problems, recipe
from .campaign import COEFFICIENT_HALF_UNIT
from .certificates import BOX_UNITS
from .loops import printed_reduced, reduced_loop
from .model import plants
from .simulation.regulator import BAND

GRID = 0.01  # s
PEAK_TIMES = [0.1 * k for k in range(200)]  # s, among the samples of the outcomes
REDUCED_RATE = fmpq(1, 10)  # 1/s
GROWTHS = [fmpq(k, 100) for k in range(1, 30)]  # 1/s
LYAPUNOV = "one Lyapunov function and diagonal multipliers for the whole box"


def along(found: Modes, row: Any, starts: Any) -> dict[str, Bound]:
    """Settling, peak, integral of the square and abscissa of loops from every start of length one."""
    least = least_peak(found, row, starts, PEAK_TIMES)
    peaks, level = f"every trajectory peaks above {least:.3g}", float(BAND) * least
    return outcome_bounds([found], row, [starts], step=GRID, level=level, peaks=peaks, integral="ise")


def full_order(data: Any) -> dict[str, Bound]:
    """K and L over the boxes of (52) and (54)."""
    M = problems.problem_data(data, problems.FULL_BOX)["M"]
    row, both = np.hstack([data["C_yaw"], zeros(1, 4)]), np.vstack([identity(4), identity(4)])
    return along(modes(M), row, both)


def reduced_x1(data: Any) -> dict[str, Bound]:
    """(66)-(69) over their boxes, fed with the first state."""
    loop, row, starts = scaled_box(data)
    decreasing, energetic = ellipsoid(loop, [row], starts, fmpq(0)), energy(loop, row, starts)
    decaying = ellipsoid(loop, [row], starts, REDUCED_RATE)
    return {
        "settling": unproven("it is measured against a trajectory's own peak, of which no lower bound is proven here"),
        "peak": bounded(decreasing and decreasing.size, LYAPUNOV, "exact"),
        "ise": bounded(energetic, LYAPUNOV, "exact"),
        "abscissa": bounded(decaying and -decaying.rate, LYAPUNOV, "exact"),
    }


def scaled_box(data: Any) -> tuple[dict[str, Any], Any, Any]:
    """The box of (66)-(69) as channels in balanced units, the row of y and the starts of the satellite, exact."""
    found = problems.problem_data(data, problems.REDUCED_BOX)
    units = [rational(x) for x in BOX_UNITS]
    out, into = diagonal(units), diagonal([1 / x for x in units])
    E, F = into @ found["E"], found["F"] @ out
    sizes = np.linalg.norm(to_float(E), axis=0) / np.linalg.norm(to_float(F), axis=1)
    balance = [power_of_two(float(np.sqrt(x))) for x in sizes]
    loop = {
        "A": into @ found["M"] @ out,
        "Bp": E @ diagonal([1 / x for x in balance]),
        "Cq": diagonal(balance) @ F,
        "Dq": zeros(len(balance)),
    }
    row = np.hstack([data["C_yaw"], zeros(1, 3)])
    return loop, row @ out, into @ np.vstack([identity(4), zeros(3, 4)])


def reduced_y(data: Any) -> dict[str, Bound]:
    """(66)-(69) over their boxes, fed with y: no member grows more slowly."""
    plant = recipe.Plant(**plants(data)["yaw"])
    rate = least_growth(reduced_loop(plant, plant.C, **printed_reduced(data.ball)), GROWTHS)
    if rate is None:
        return dict.fromkeys(("abscissa", "doubling"), unproven(TOO_WIDE))
    by = "the middle grows faster, and no member has an eigenvalue with this real part"
    with precision(PRECISION):
        doubling = float((arb(2).log() / arb(rate)).upper())
    return {
        "abscissa": Bound(float(np.nextafter(to_float(rate), 0)), by, "ball"),
        "doubling": Bound(float(np.nextafter(doubling, np.inf)), by, "ball"),
    }


def rounded_plant(model: Any, synthesis: Any, axis: str) -> dict[str, Bound]:
    """Coefficients over their rounding: every one a parameter of its own, in all entries where it stands."""
    plant, gains = model[axis], synthesis["gains"][axis]
    A, B, C = (from_float(np.atleast_2d(plant[name])) for name in "ABC")
    n, found = len(A), {}
    for name, design in (("full", gains["full"]["exact"]), ("reduced", gains["corrected"])):
        A_c, B_c, C_c, D_c, L = (from_float(np.atleast_2d(design[key])) for key in ("A", "B", "C", "D", "L"))
        order = len(A_c)
        M = np.block([[A + B @ D_c @ C, B @ C_c], [B_c @ C, A_c]])
        dynamic, measured = (np.flatnonzero(to_float(M)) for M in (A[:1], C[:1]))
        first = np.vstack([identity(n)[:, :1], zeros(order, 1)])
        E = np.hstack([first] * len(dynamic) + [np.vstack([B @ D_c, B_c])] * len(measured)) * COEFFICIENT_HALF_UNIT
        F = np.hstack([identity(n)[[*dynamic, *measured]], zeros(len(dynamic) + len(measured), order)])
        start = zeros(order, n) if name == "full" else -(L @ C)
        here = along(modes(M, (E, F)), np.hstack([C[:1], zeros(1, order)]), np.vstack([identity(n), start]))
        found |= {f"{name}-{key}": here[key] for key in ("settling", "ise", "abscissa")}
    return found


def plant_yaw(model: Any, synthesis: Any) -> dict[str, Bound]:
    """The loops of yaw."""
    return rounded_plant(model, synthesis, "yaw")


def plant_roll(model: Any, synthesis: Any) -> dict[str, Bound]:
    """The loops of roll."""
    return rounded_plant(model, synthesis, "roll")
