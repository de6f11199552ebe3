"""Section 4, text on Figures 2 to 5: the published loop on the two-body motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.claims.values import Approx, Result, Statement

RELATIVE = 1e-6  # the three routes agree to 1e-8 m; sampling and interpolation add less than this


def approx(value: float) -> Approx:
    """A simulated value with its error bound."""
    return Approx(float(value), RELATIVE * max(abs(float(value)), 1e-6))


def _case(simulation: Any, case: str) -> Any:
    return simulation["main"]["values"][case]


def _start(data: Any) -> tuple[float, float]:
    x0 = data.float("x0")[:, 0]
    return float(np.linalg.norm(x0[:3])), float(np.linalg.norm(x0[3:]))


def error_is_short(simulation: Any, case: str) -> Result:
    """Last time with norm(e_v) > 0.05 m/s against a twentieth of the last time with distance > 50 m."""
    found = _case(simulation, case)
    times = {
        "velocity error above 0.05 m/s until [s]": found["velocity_error_time"],
        "distance above 50 m until [s]": found["time_50m"],
    }
    return Result(
        Statement({"time_50m / 20 - error time [s]": approx(found["time_50m"] / 20 - found["velocity_error_time"])}),
        times,
    )


def states_converge(data: Any, simulation: Any, case: str) -> Statement:
    """Distance and speed at 3000 s below 1 % of their start, distance at 6000 s below 1e-4 of the start."""
    distance, speed = _start(data)
    found = _case(simulation, case)
    return Statement(
        {
            "1 % of the start minus distance at 3000 s [m]": approx(distance / 100 - found["distance_3000s"]),
            "1 % of the start minus speed at 3000 s [m/s]": approx(speed / 100 - found["speed_3000s"]),
            "1e-4 of the start minus distance at 6000 s [m]": approx(distance * 1e-4 - found["distance_6000s"]),
        }
    )


def seen_in_3000s(data: Any, simulation: Any, case: str) -> Result:
    """1 % of the start less the distance at 3000 s, the length of the paper's figure [m]."""
    distance, _ = _start(data)
    found = _case(simulation, case)
    return Result(
        Statement({"1 % of the start minus distance at 3000 s [m]": approx(distance / 100 - found["distance_3000s"])}),
        {"what remains [m]": float(found["distance_3000s"])},
    )


def thrust_below_bounds(data: Any, simulation: Any, case: str) -> Result:
    """u_max minus the largest unclipped thrust, per axis."""
    found, bound = _case(simulation, case), data.float("u_max")[0]
    margins = {f"{axis} [N]": approx(bound[i] - found["peak_thrust"][i]) for i, axis in enumerate("xyz")}
    return Result(Statement(margins), {"largest thrust [N]": found["peak_thrust"], "at [s]": found["peak_time"]})


def initial_fluctuation(simulation: Any, case: str) -> Statement:
    """Against the run without observer error: above 5 % of its peak within 10 s, below 5 % from 20 s on."""
    found = _case(simulation, case)
    return Statement(
        {
            "largest in 0-10 s minus 5 %": approx(found["fluctuation_10s"] - 0.05),
            "5 % minus largest from 20 s on": approx(0.05 - found["fluctuation_later"]),
        }
    )
