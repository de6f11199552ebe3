"""Section 4, (38), (43), (44): what the printed X, Y, K satisfy, and what the paper leaves unprinted."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.claims.proofs import accepted, located, verified
from recontrol.claims.values import Approx, Result
from recontrol.exact import rational
from recontrol.lmi import verify

from ..problems import Scale

SOLVER_TOLERANCE = 1e-8
"""Relative duality gap at which the solver stops."""


def K_product(certificates: Any, synthesis: Any) -> Result:
    """Whether some X, Y, K in the boxes of (43), (44) satisfy K X = Y (certificate)."""
    evidence = {"smallest common multiple of all half units (float)": float(synthesis["joint"]["gain"]["multiple"])}
    return located(certificates, "K_member", evidence)


def solves_CO_orbit(certificates: Any, synthesis: Any) -> Result:
    """Whether the boxes hold a solution of (38) with all of x measured, at the mean motion of the orbit."""
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
    """The same at the printed mean motion."""
    return located(certificates, "CO_n_printed_R2", {"R once as well": verified(certificates, "CO_n_printed_R1").holds})


def solves_SF_printed(certificates: Any) -> Result:
    """Whether the boxes hold a solution of (38) without its observer block, at the printed mean motion."""
    return located(certificates, "SF_n_printed_R2", {"R once as well": verified(certificates, "SF_n_printed_R1").holds})


def starts_with_velocity(certificates: Any) -> Result:
    """Whether (30), (31) admit X, Y in the boxes if e(0) is the velocity."""
    return located(certificates, "e0_velocity_excluded")


def starts_with_full(certificates: Any) -> Result:
    """The same if e(0) is x(0)."""
    return located(certificates, "e0_full_excluded")


def optimum(synthesis: Any) -> Result:
    """Interval of rho that the digits of X and Y allow in SF at n_printed, R twice (float)."""
    found = synthesis["digits"]
    low, high = float(found["rho_low"]), float(found["rho_high"])
    return Result(Approx((low + high) / 2, (high - low) / 2), {"rho low": low, "rho high": high})


def which_start(synthesis: Any) -> Result:
    """Smallest V(0) over the boxes for each e(0) against the largest rho that (31) allows.

    If (30) does not bind at the largest rho, leaving it out gives the same optimum: what two solves of it differ by is
    then the solver's error, here taken a hundredfold, and no less than its relative tolerance. ValueError if they
    differ by more, since (30) then binds.
    """
    found = synthesis["digits"]
    largest, again = float(found["rho_high_limits_only"]), float(found["rho_high"])
    if abs(largest - again) > 100 * SOLVER_TOLERANCE * largest:
        raise ValueError(f"(30) binds at the largest rho: {again:.10g} with it, {largest:.10g} without")
    error = max(100 * abs(largest - again), SOLVER_TOLERANCE * largest)
    rows = {case: dict(found[case]) for case in ("e0_zero", "e0_velocity", "e0_full")}
    return Result(Approx(largest, error), rows)


def cost_bounds(synthesis: Any, simulation: Any, certificates: Any) -> Result:
    """Certified and float bounds of J against the simulated worst J of the linear model, per e(0)."""
    cost_unit, rows = float(rational.to_float(Scale.cost)), {}
    accepted(certificates, "cost_e0_zero", "cost_e0_velocity", "cost_e0_full")
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
