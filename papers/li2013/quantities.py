"""Every number beyond the claims. Names, units and meaning: paper.yaml, ``quantities``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from recontrol.exact import rational
from recontrol.lmi.certificate import decode

from .sweeps import floats


def flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested mappings as one, keys joined by a space."""
    out: dict[str, Any] = {}
    for key, value in table.items():
        name = f"{prefix} {key}".strip()
        out |= flat(value, name) if isinstance(value, Mapping) else {name: value}
    return out


def _loop(model: Any, simulation: Any) -> dict[str, Any]:
    metrics = simulation["loops"]["values"]["metrics"]
    names = (
        "u_peak", "u_peak_after_first", "settle_0.1", "settle_0.01", "settle_2pct", "overshoot", "overshoot_relative",
        "speed_peak", "residual", "e_end",
    )  # fmt: skip
    out: dict[str, Any] = {
        name.replace(".", ""): {
            f"{case} {axis}": value if value is not None else "infinite"
            for case, found in metrics.items()
            for axis, value in found[name].items()
        }
        for name in names
    }
    for time in (20, 50, 100):
        out[f"state_at_{time}"] = {case: found[f"x_at_{time}"] for case, found in metrics.items()}
    orbits = model["orbits"]
    return {
        **out,
        "equilibrium": {orbit: found["equilibrium"] for orbit, found in orbits.items()},
        "thrust_at_rest": {orbit: found["thrust_at_rest"] for orbit, found in orbits.items()},
        "first_thrust": model["u0"],
        "poles": {orbit: found["poles"] for orbit, found in orbits.items()},
        "pair_split": flat(model["pair_split"]),
        "rates": dict(model["rates"]),
        "simulation_check": dict(simulation["loops"]["values"]["checks"]),
        "nonlinear_difference": dict(simulation["nonlinear"]["values"]["difference"]),
        "inconsistent_orbit": dict(simulation["nonlinear"]["values"]["inconsistent"]),
    }


def _conditions(data: Any, synthesis: Any, certificates: Any) -> dict[str, Any]:
    margins, gamma, initial, periods = (synthesis[name] for name in ("margins", "gamma", "initial", "periods"))
    rho, u_max = (float(rational.to_float(data[name])) for name in ("rho", "thrust_max"))
    v = floats(data, "")
    first = float(abs(v["K"] @ v["xi0"]).max())
    h = {name: float(rational.to_float(decode(certificates[name]["data"]["h"]))) for name in _LIMITS}
    return {
        "margin": flat(margins["table"]),
        "margin_single_fault": flat(margins["faults"]),
        "margin_printed_far": flat(margins["elsewhere"]),
        "margin_of_points": {name: found["margin"] for name, found in synthesis["points"].items() if "margin" in found},
        "gamma_derived": flat(gamma["derived"]),
        "gamma_printed": flat(gamma["printed"]),
        "gamma_law": flat(gamma["law"]),
        "gamma_full": gamma["full"]["gamma"],
        "gamma_spread": {
            f"{alpha} {block}": found["solvers"]["spread"]
            for alpha, blocks in gamma["second"].items()
            for block, found in blocks.items()
        },
        "gamma_upper": {
            f"{alpha} {block}": found["upper"]
            for alpha, blocks in gamma["second"].items()
            for block, found in blocks.items()
        },
        "V0_infimum": flat(initial["infimum"]),
        "V0_infimum_shifted": dict(initial["shifted"]),
        "V0_closed_form": rho * (first / u_max) ** 2,
        "V0_range": flat(initial["range"]),
        "thrust_bound": dict(initial["thrust_bound"]),
        "rho_least": dict(initial["least_rho"]),
        "h_max": flat(periods["h_max"]),
        "h_exact": flat(periods["exact"]),
        "h_share": {
            f"{name} {block}": found[block]["low"] / periods["exact"]["w-print"][block][_rate(name)]["low"]
            for name, found in periods["h_max"].items()
            for block in found
        },
        "h_proven": h,
        "alpha_max": flat(periods["alpha_max"]),
    }


_LIMITS = ("h-a0-below", "h-a0-above", "h-a02-below", "h-a02-above")


def _rate(name: str) -> str:
    return "a02" if name.endswith("a02") else "a0"


def _beyond(synthesis: Any, simulation: Any) -> dict[str, Any]:
    designs, inputs = synthesis["resynthesis"]["designs"], synthesis["inputs"]
    published = synthesis["resynthesis"]["published"]
    gains, functional = simulation["gains"]["values"], simulation["functional"]["values"]
    return {
        "design_thrust": {alpha: found["u"] for alpha, found in designs.items()},
        "design_gain": {alpha: found["rounded"] for alpha, found in designs.items()},
        "design_decay": {
            **{alpha: found["decay"] for alpha, found in designs.items()},
            "published": published["decay"],
        },
        "design_peak": {**{a: found["u_peak"] for a, found in designs.items()}, "published": published["u_peak"]},
        "design_settling": {
            f"{alpha} {axis}": found["settle_0.1"][k] if found["settle_0.1"][k] is not None else "infinite"
            for alpha, found in {**designs, "published": published}.items()
            for k, axis in enumerate("xyz")
        },
        "design_largest_alpha": dict(synthesis["resynthesis"]["largest"]),
        "integral_least": {
            f"{case} {side}": inputs[case][side] for case in ("w-print", "w=0") for side in ("value", "bound")
        },
        "integral_loop": flat(functional["integral"]),
        "norm_continuous": flat(gains["continuous"]),
        "gain_sampled": flat(gains["sampled"]),
        "gain_pulse": flat(gains["pulse"]),
        "functional_along": flat({name: functional[name] for name in functional if name != "integral"}),
    }


def quantities(data: Any, model: Any, synthesis: Any, certificates: Any, simulation: Any) -> dict[str, Any]:
    """All quantities; a value that depends on a case is a mapping case -> value."""
    return {
        **_loop(model, simulation),
        **_conditions(data, synthesis, certificates),
        **_beyond(synthesis, simulation),
    }
