"""Figs 4 to 9 and the conclusion, by simulation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from recontrol.claims.values import Approx, Result, Statement

from ..simulation.random_gains import number_of_seeds

# The integrators of part `integrators` agree to 1e-9 of the states; torques are states times gains of about 20.
STATE_ERROR, TORQUE_ERROR = 1e-8, 1e-6
LISTED = ("offset",)


def _cases(simulation: Any) -> Mapping[str, Any]:
    values = simulation["attitude"]["values"]
    return {name: value for name, value in values.items() if name not in LISTED}


def umax(simulation: Any) -> Result:
    """Largest torque norm on [0, 200] s: nonlinear plant, modes at rest, nominal inertia; the other cases beside it."""
    cases = _cases(simulation)
    others = {name: Approx(float(v["peak_torque"]), TORQUE_ERROR) for name, v in cases.items()}
    base = cases["base"]
    return Result(
        Approx(float(base["peak_torque"]), TORQUE_ERROR),
        evidence={"time [s]": Approx(float(base["peak_torque_time"]), 0.01), "all cases [N m]": others},
    )


def angles(simulation: Any, data: Any) -> Result:
    """On [100, 200] s every angle stays below 5 % of its initial value."""
    base = _cases(simulation)["base"]
    start = np.abs(np.ravel(data.float("q0")))
    late = np.asarray(base["late_angles"])
    margins = {
        f"angle {k + 1}": Approx(float(0.05 * s - v), STATE_ERROR)
        for k, (s, v) in enumerate(zip(start, late, strict=True))
    }
    return Result(
        Statement(margins),
        evidence={
            "largest angles on [100, 200] s [rad]": Approx(late, STATE_ERROR),
            "angles at 200 s: a bias, there is no integral action [rad]": Approx(
                np.asarray(base["final_angles"]), STATE_ERROR
            ),
        },
    )


def rates(simulation: Any) -> Result:
    """On [100, 200] s every angle rate stays below 5 % of its own peak."""
    base = _cases(simulation)["base"]
    late, peak = np.asarray(base["late_rates"]), np.asarray(base["peak_rates"])
    margins = {
        f"rate {k + 1}": Approx(float(0.05 * p - v), STATE_ERROR)
        for k, (p, v) in enumerate(zip(peak, late, strict=True))
    }
    return Result(Statement(margins), evidence={"largest rates on [100, 200] s [rad/s]": Approx(late, STATE_ERROR)})


def modes(simulation: Any, synthesis: Any) -> Result:
    """The slowest mode is better damped than without control, and every amplitude falls below half its peak."""
    cases = _cases(simulation)
    base, off = cases["base"], cases["control-off"]
    late, peak = np.asarray(base["late_modes"]), np.asarray(base["peak_modes"])
    closed = -complex(synthesis["analysis"]["loops"]["proposed"]["mode"]).real
    opened = -complex(synthesis["analysis"]["open"]["mode"]).real
    margins = {"damping gained [1/s]": Approx(closed - opened, 1e-9)}
    margins |= {
        f"mode {k + 1}": Approx(float(p / 2 - v), STATE_ERROR) for k, (p, v) in enumerate(zip(peak, late, strict=True))
    }
    return Result(
        Statement(margins),
        evidence={
            "decay rate closed, open [1/s]": Approx(np.array([closed, opened]), 1e-9),
            "peaks with control": Approx(peak, STATE_ERROR),
            "peaks without control": Approx(np.asarray(off["peak_modes"]), STATE_ERROR),
        },
    )


def smaller_region(simulation: Any, config: Any) -> Result:
    """Figs 8, 9: seeds where the proposed gains end closer, by amplitude and hold time."""
    table = simulation["draws"]["values"]
    rows = {
        case: {
            "seeds where the proposed is smaller": cell["proposed-smaller"],
            "diverged, proposed and [39]": [cell["proposed"]["diverged"], cell["ref39"]["diverged"]],
        }
        for case, cell in table.items()
    }
    seeds = number_of_seeds(config)
    share = sum(cell["proposed-smaller"] for cell in table.values()) / (seeds * len(table))
    return Result(Approx(share, 1e-12), evidence={"amplitude/hold time [s]": rows})


def robustness(data: Any, synthesis: Any, simulation: Any) -> Result:
    """Within 5 %: vertices against the disk, drift limits of disk and stability; gain and bias go the other way."""
    b = data.float("disk_b")
    v = {name: synthesis["vertices"][name] for name in ("proposed", "ref39")}
    bias = {
        name: Approx(np.abs(np.asarray(o)).max(), 1e-9)
        for name, o in simulation["attitude"]["values"]["offset"].items()
    }
    margins = {
        "disk radius left at the worst vertex": Approx(b - v["proposed"]["radius"], 1e-9),
        "[39]: worst vertex beyond the disk": Approx(v["ref39"]["radius"] - b, 1e-9),
        "drift limit of the disk": Approx(v["proposed"]["limits"]["disk"][0] - v["ref39"]["limits"]["disk"][1], 1e-4),
        "drift limit of stability": Approx(
            v["proposed"]["limits"]["stability"][0] - v["ref39"]["limits"]["stability"][1], 1e-4
        ),
    }
    gains = {name: Approx(v[name]["static-gain"], 1e-9) for name in v}
    return Result(Statement(margins), evidence={"worst static gain (smaller is better)": gains, "bias [rad]": bias})
