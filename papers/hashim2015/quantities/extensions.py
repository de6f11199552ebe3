"""Section 11: margins, loop transfer recovery and limits, which the paper does not treat."""

from __future__ import annotations

from typing import Any

from .experiments import flat


def robustness(values: Any) -> dict[str, Any]:
    """Margins of every loop at the plant input."""
    axes = values["axes"]
    lower, upper = flat(axes, "gain_lower"), flat(axes, "gain_upper")
    return {
        "loop_gain_lower": lower,
        "loop_gain_upper": upper,
        "phase_margin": flat(axes, "phase_margin"),
        "peak_sensitivity": flat(axes, "peak_sensitivity"),
        "peak_sensitivity_frequency": flat(axes, "peak_frequency"),
        "coprime_radius": flat(axes, "coprime_radius"),
        "coprime_best": flat(axes, "coprime_best"),
    }


def recovery(values: Any) -> dict[str, Any]:
    """Loop transfer recovery."""
    tables = {
        axis: {f"q_e = {q}": row for q, row in entry["weights"].items()} | {"state feedback": entry["state_feedback"]}
        for axis, entry in values["axes"].items()
    }
    return {
        "recovery_peak_sensitivity": flat(tables, "peak_sensitivity"),
        "recovery_phase_margin": flat(tables, "phase_margin"),
    }


def limits(values: Any) -> dict[str, Any]:
    """LQG cost, tracking limits of the zeros, designs made for the coprime radius."""
    axes = dict(values)
    return {
        "lqg_cost": {f"{axis}, {name}": cost for axis, e in axes.items() for name, cost in e["lqg_cost"].items()}
        | {f"{axis}, optimum": e["lqg_optimum"] for axis, e in axes.items()},
        "tracking_ise": {
            f"{axis}, input weight {w}": ise for axis, e in axes.items() for w, ise in e["tracking_ise"].items()
        }
        | {f"{axis}, limit": e["tracking_ise_limit"] for axis, e in axes.items()},
        "poisson_bound": {
            f"{axis}, {rejection} up to {w} rad/s": bound
            for axis, e in axes.items()
            for rejection, row in e.get("poisson", {}).items()
            for w, bound in row.items()
        },
        "coprime_other_designs": {
            f"{axis}, {name}": e[key]
            for axis, e in axes.items()
            for name, key in (("unit LQG", "coprime_unit_lqg"), ("loop shaping", "coprime_loop_shaping"))
        },
    }


def quantities(simulation: Any) -> dict[str, Any]:
    """Names of paper.yaml, section 11."""
    return {
        **robustness(simulation["robustness"]["values"]),
        **recovery(simulation["recovery"]["values"]),
        **limits(simulation["limits"]["values"]),
    }
