"""Optima, what the digits say, and the bounds of the repaired analysis."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.lmi import verify

from ..problems import Scale


def _solved(synthesis: Any) -> dict[str, Any]:
    """Every solved problem under its name."""
    found = {f"SF_{count}": synthesis["SF"][count] for count in ("R2", "R1")}
    found |= {f"CO_{name}": entry for name, entry in synthesis["CO"].items() if name != "X33"}
    return found | {f"SF_{name}": entry for name, entry in synthesis["variants"].items() if name != "baseline"}


def _enclosures(certificates: Any) -> dict[str, fmpq]:
    """Ends of rho*, exact."""
    cost = Scale.cost
    return {
        f"{name}_{end}": cost / verify.number(certificates[f"rho_{name}_{end}"]["bound"]["value"])
        for name in ("SF_R2", "SF_R1", "CO_R2", "CO_R1")
        for end in ("low", "high")
    }


def _certified(data: Any, certificates: Any) -> dict[str, dict[str, Any]]:
    """Costs (exact, SI) and thrusts (float from the exact square) of the certificates."""
    cost = {
        case: Scale.cost * verify.number(certificates[f"cost_{case}"]["bound"]["value"])
        for case in ("e0_zero", "e0_velocity", "e0_full")
    }
    thrust = {}
    for case in ("e0_zero", "e0_velocity"):
        for axis, limit in zip("xyz", data.float("u_max")[0], strict=True):
            square = verify.number(certificates[f"thrust_{case}_{axis}"]["bound"]["value"])
            thrust[f"{case}_{axis}"] = float(limit) * float(float(square.p) / float(square.q)) ** 0.5
    return {"cost_bound_certified": cost, "thrust_bound_certified": thrust}


def _spread(solvers: dict[str, Any]) -> float | None:
    """Relative difference of the two solvers of one bound; None if only one gave a value."""
    values = [float(found["value"]) for found in solvers.values() if found["value"]]
    return max(values) / min(values) - 1 if len(values) > 1 else None


def _intervals(synthesis: Any) -> dict[str, float]:
    found, rows = synthesis["intervals"], {}
    for problem in ("SF", "CO"):
        for side in ("low", "high"):
            for where in ("outside", "inside"):
                rows[f"{problem}, {side}, {'refuted' if where == 'outside' else 'member'}"] = float(
                    found[f"{problem}_{side}"][where]["n"]
                )
            for count in ("R2", "R1"):
                rows[f"{problem}, {side}, zero of the relaxed margin, {count}"] = float(
                    found[f"{problem}_{side}_{count}"]
                )
    return rows


def _ends(synthesis: Any) -> dict[str, float]:
    rows = {}
    for problem in ("SF", "CO"):
        for side in ("low", "high"):
            entry = synthesis[problem]["X33"][side]
            K = np.asarray(entry["K"])
            rows |= {
                f"{problem}, {side}, X33": float(entry["X33"]),
                f"{problem}, {side}, K33": float(K[2, 2]),
                f"{problem}, {side}, K36": float(K[2, 5]),
            }
    return rows


def _solutions(synthesis: Any, certificates: Any) -> dict[str, Any]:
    """What was solved: optimal values and gains, their spread, what was varied."""
    solved = {name: entry for name, entry in _solved(synthesis).items() if "X" in entry}
    spread = {f"SF_{c}": synthesis["SF"][c]["solvers"]["spread"] for c in ("R2", "R1")}
    spread |= {f"CO_{n}": e["solvers"]["spread"] for n, e in synthesis["CO"].items() if n != "X33"}
    units = synthesis["units_matter"]
    return {
        "rho": {name: float(entry["rho"]) for name, entry in solved.items()},
        "eps": {name: float(entry["eps"]) for name, entry in solved.items() if entry["eps"] is not None},
        "rho_enclosure": _enclosures(certificates),
        "rho_spread": {name: None if v is None else float(v) for name, v in spread.items()},
        "K_found": {name: np.asarray(entry["K"]) for name, entry in solved.items()},
        **{
            f"{M}_units_from_print": {n: np.asarray(e["units_from_print"][M]) for n, e in solved.items()} for M in "XYK"
        },
        "gain_change": {n: float(e["gain_change"]) for n, e in synthesis["variants"].items() if "gain_change" in e},
        "z_freedom": _ends(synthesis),
        "w_minimum": synthesis["SF"]["min_w"]["w"],
        "rho_fixed_gain": {name: entry["rho"] for name, entry in synthesis["fixed"].items()},
        "si_answers": {name: entry["rho"] for name, entry in units.items()},
        "si_words": {name: f"{entry['words'][:60]}; {entry['outcome']}" for name, entry in units.items()},
    }


def _digits(synthesis: Any) -> dict[str, Any]:
    """What the printed digits admit."""
    digits, joint = synthesis["digits"], synthesis["joint"]
    return {
        "rho_of_digits": {k: float(digits[k]) for k in ("rho_low", "rho_high", "rho_high_limits_only")},
        "margin_of_digits": float(digits["mu"]),
        "smallest_V0": {case: float(digits[case]["smallest_V0"]) for case in ("e0_zero", "e0_velocity", "e0_full")},
        "gain_multiple": float(joint["gain"]["multiple"]),
        "joint_margin": {n: float(e["margin"]) for n, e in joint.items() if e is not None and "margin" in e},
        "n_interval": _intervals(synthesis),
        "observers_compatible": ", ".join(synthesis["arrangements"]["survivors"]),
    }


def _bounds(data: Any, synthesis: Any, certificates: Any) -> dict[str, Any]:
    """What the repaired theorem bounds, for the printed and for other gains."""
    repaired = synthesis["repaired"]
    spread = {name: _spread(entry["solvers"]) for name, entry in repaired["cost"].items()}
    return {
        "cost_bound": {name: float(entry["bound"]) for name, entry in repaired["cost"].items()},
        "cost_bound_spread": {name: value for name, value in spread.items() if value is not None},
        "thrust_bound": {name: float(v) for name, v in repaired["thrust"].items()},
        **_certified(data, certificates),
        "bounds_other_gains": {
            f"{gain}, {case}, {what}": None if v is None else float(v)
            for gain, cases in synthesis["other_gains"].items()
            for case, entry in cases.items()
            for what, v in entry.items()
        },
        "same_P": str(repaired["same"]["words"]),
    }


def quantities(data: Any, synthesis: Any, certificates: Any) -> dict[str, Any]:
    """Quantities of this topic."""
    return _solutions(synthesis, certificates) | _digits(synthesis) | _bounds(data, synthesis, certificates)
