"""Section 4, (38), (43), (44): what the printed X, Y, K satisfy, and what the paper leaves unprinted."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.claims.proofs import located, verified
from recontrol.claims.values import Approx, Result
from recontrol.exact import rational
from recontrol.lmi import verify

from ..problems import Scale


def K_product(certificates: Any, synthesis: Any) -> Result:
    evidence = {"smallest common multiple of all half units (float)": float(synthesis["joint"]["gain"]["multiple"])}
    return located(certificates, "K_member", evidence)


def solves_38(certificates: Any, case: str) -> Result:
    """X in its box violates (14) for this gain, so X, Y, K are no point of (38)."""
    return located(certificates, f"eq14_{case}")


def solves_CO_orbit(certificates: Any, synthesis: Any) -> Result:
    ends = synthesis["intervals"]
    evidence = {
        "R once as well": verified(certificates, "CO_n_orbit_R1").holds,
        "n admitted [rad/s], CO": [ends["CO_low"]["outside"]["n"], ends["CO_high"]["outside"]["n"]],
        "n with a witness [rad/s], CO": [ends["CO_low"]["inside"]["n"], ends["CO_high"]["inside"]["n"]],
    }
    return located(certificates, "CO_n_orbit_R2", evidence)


def solves_SF_orbit(certificates: Any) -> Result:
    """SF is a relaxation of CO: the same witness must satisfy it, and it leaves the z row and column free."""
    return located(certificates, "SF_n_orbit_R2")


def solves_CO_printed(certificates: Any) -> Result:
    return located(certificates, "CO_n_printed_R2", {"R once as well": verified(certificates, "CO_n_printed_R1").holds})


def solves_SF_printed(certificates: Any) -> Result:
    return located(certificates, "SF_n_printed_R2", {"R once as well": verified(certificates, "SF_n_printed_R1").holds})


def starts_with_velocity(certificates: Any) -> Result:
    return located(certificates, "e0_velocity_excluded")


def starts_with_full(certificates: Any) -> Result:
    return located(certificates, "e0_full_excluded")


def optimum(synthesis: Any) -> Result:
    """Interval of rho that the digits of X and Y allow in SF at n_printed, R twice (float)."""
    found = synthesis["digits"]
    low, high = float(found["rho_low"]), float(found["rho_high"])
    return Result(Approx((low + high) / 2, (high - low) / 2), {"rho low": low, "rho high": high})


def which_start(synthesis: Any) -> Result:
    """Smallest V(0) over the boxes for each e(0) against the largest rho that (31) allows."""
    found = synthesis["digits"]
    rows = {case: dict(found[case]) for case in ("e0_zero", "e0_velocity", "e0_full")}
    return Result(Approx(float(found["rho_high_limits_only"]), 1e4), rows)


def cost_bounds(synthesis: Any, simulation: Any, certificates: Any) -> Result:
    """Certified and float bounds of J against the simulated worst J of the linear model, per e(0)."""
    cost_unit, rows = float(rational.to_float(Scale.cost)), {}
    for case in ("e0_zero", "e0_velocity", "e0_full"):
        certificate = certificates[f"cost_{case}"]
        proven = float(rational.to_float(verify.number(certificate["bound"]["value"]))) * cost_unit
        worst = float(simulation["linear_cost"]["values"][case]["worst"])
        floats = {n: e["bound"] for n, e in synthesis["repaired"]["cost"].items() if n.startswith(f"{case}_")}
        rows[case] = {
            "certified, P block": proven,
            "P full (float)": float(floats[f"{case}_full_diagonal"]),
            "simulated worst": worst,
            "every bound holds": all(b is not None and b > worst for b in (proven, *floats.values())),
        }
    return Result(Approx(rows["e0_zero"]["certified, P block"], 1.0), rows, "cost_e0_zero")


def factor_two(synthesis: Any) -> Result:
    """rho* of SF with kappa = 1 over rho* with kappa = 2."""
    found = synthesis["variants"]
    ratio = float(found["kappa1"]["rho"] / found["baseline"]["rho"])
    print_units = {name: float(np.abs(v).max()) for name, v in found["kappa1"]["units_from_print"].items()}
    return Result(Approx(ratio, 1e-6), {"largest distance to the print, units of the last place": print_units})
