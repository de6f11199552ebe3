"""Enclosures of rho*: the bounded value is cost_unit / rho, so its upper end gives the lower end of rho."""

from __future__ import annotations

from typing import Any

from recontrol.lmi.enclosure import enclose
from recontrol.lmi.proof import NotProvenError

from ..problems import rendezvous

SOLVERS = ("CLARABEL", "CVXOPT", "SDPA")
CASES = {"SF": "n_printed", "CO": "n_orbit, canonical"}


def rho_bound(data: Any, problem: str, count: int, *, low: bool) -> dict[str, Any]:
    """Certificate of one end of rho*, from the first solver whose point and multipliers survive rounding."""
    target, failures = rendezvous(data, CASES[problem], count=count), []
    for solver in SOLVERS:
        try:
            found = enclose(target, solver=solver, says=f"cost unit over rho* of {problem}, R{count}")
        except NotProvenError as error:
            failures.append(str(error))
            continue
        return found.upper_certificate if low else found.lower_certificate
    raise NotProvenError("; ".join(failures))


def rho_SF_R2_low(data: Any) -> dict[str, Any]:
    return rho_bound(data, "SF", 2, low=True)


def rho_SF_R2_high(data: Any) -> dict[str, Any]:
    return rho_bound(data, "SF", 2, low=False)


def rho_SF_R1_low(data: Any) -> dict[str, Any]:
    return rho_bound(data, "SF", 1, low=True)


def rho_SF_R1_high(data: Any) -> dict[str, Any]:
    return rho_bound(data, "SF", 1, low=False)


def rho_CO_R2_low(data: Any) -> dict[str, Any]:
    return rho_bound(data, "CO", 2, low=True)


def rho_CO_R2_high(data: Any) -> dict[str, Any]:
    return rho_bound(data, "CO", 2, low=False)


def rho_CO_R1_low(data: Any) -> dict[str, Any]:
    return rho_bound(data, "CO", 1, low=True)


def rho_CO_R1_high(data: Any) -> dict[str, Any]:
    return rho_bound(data, "CO", 1, low=False)
