"""Every number beyond the claims. Names, units and meaning: paper.yaml, ``quantities``; cases are named in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from . import plant

Table = dict[str, dict[str, Any]]


def quantities(data: Any, synthesis: Any, simulation: Any) -> dict[str, Any]:
    """All quantities; each is a mapping case -> value."""
    return {
        "orbital_rate": {case: plant.orbital_rate(data, case) for case in plant.RADII},
        **_norms(synthesis["norms"]),
        **_floquet(synthesis["floquet"]),
        **_fixed(synthesis["fixed-gain"], synthesis["vanishing"]),
        **_designs(synthesis),
        **_runs(simulation),
    }


def _per(found: Any, value: Callable[[Any], Any], prefix: str = "") -> dict[str, Any]:
    """case -> value over the leaves of a mapping of mappings that `value` accepts."""
    out: dict[str, Any] = {}
    for name, item in found.items():
        words = f"{prefix}, {name}" if prefix else str(name)
        try:
            out[words] = value(item)
        except (KeyError, TypeError, IndexError):
            out |= _per(item, value, words) if isinstance(item, dict) else {}
    return {case: item for case, item in out.items() if item is not None}


def _norms(norms: Any) -> Table:
    keys = {"h2_norm": "h2", "h2_norm_box": "h2_box", "effort": "effort", "trace_of_root": "trace_of_root"}
    table: Table = {name: _per(norms, lambda f, k=key: f[k]) for name, key in keys.items()}
    table["h2_norm_vertices"] = _per(norms, lambda f: f["h2_vertices"])
    table["over_least_norm"] = _per(norms, lambda f: f["pareto"])
    for name, key in (("hinf_norm_lower", "lower"), ("hinf_norm_upper", "upper"), ("hinf_excess", "excess_lower")):
        table[name] = _per(norms, lambda f, k=key: f["hinf"][k])
    table["hinf_frequency"] = _per(norms, lambda f: f["hinf"]["frequency"])
    for name in ("natural_frequency", "damping"):
        table[name] = _per(norms, lambda f, k=name: f["axes"][k])
    table["coupling"] = {
        f"{case}, {gain}, V{place}": value
        for case, gains in norms.items()
        for gain, found in gains.items()
        for place, value in found["coupling"].items()
    }
    return table


def _floquet(floquet: Any) -> Table:
    enclosed, scans = floquet["enclosed"], floquet["scans"]
    table: Table = {
        f"floquet_{name}": _per(enclosed, lambda f, k=name: f[k])
        for name in ("largest", "largest_box", "exponent", "doubling_box", "period")
    }
    table["stability_radius"] = _per(enclosed, lambda f: f["radius"])
    table["amplitude_threshold"] = _per(
        scans, lambda f: f["threshold"] or "none below 120" if "threshold" in f else f[0]
    )
    table["largest_at_frequency"] = _per(scans, lambda f: f["factors"])
    table["largest_at_frequency"] = {
        f"{case}, {factor} times the frequency": value
        for case, row in table["largest_at_frequency"].items()
        for factor, value in row.items()
    }
    for name in ("unstable_share", "first_unstable_negative", "first_unstable_positive", "static_threshold"):
        table[f"frozen_{name}"] = _per(scans, lambda f, k=name: "none" if f["frozen"][k] is None else f["frozen"][k])
    return table


def _levels(fixed: Any, kind: str) -> Iterator[tuple[str, Any]]:
    for gain, found in fixed.items():
        for g, rho in zip(found["levels"], found[kind]["rho"], strict=True):
            yield f"{gain}, g = {g:g}", rho


def _fixed(fixed: Any, vanishing: Any) -> Table:
    table: Table = {f"rho_{kind}": dict(_levels(fixed, kind)) for kind in ("trad", "std", "prt")}
    table["h2_squared"] = {gain: found["h2_squared"] for gain, found in fixed.items()}
    table["riccati_against_solver"] = {
        f"{gain}, {kind}, g = {g}": abs(answer["value"] / float(rho) - 1)
        for gain, found in fixed.items()
        for kind in ("trad", "std", "prt")
        for g, rho in ((f"{x:g}", r) for x, r in zip(found["levels"], found[kind]["rho"], strict=True))
        if (answer := found[kind]["solved"].get(g)) and answer["value"] is not None
    }
    for name in ("rho_prt", "rho_trad", "h2"):
        table[f"vanishing_{name}"] = {f"k = {k}": member[name] for k, member in vanishing["members"].items()}
    table["vanishing_solver_value"] = {
        f"{name}, {solver}": "none" if record["value"] is None else record["value"]
        for name, rows in vanishing["solvers"].items()
        for solver, record in rows.items()
    }
    table["vanishing_solver_words"] = {
        f"{name}, {solver}": f"{record['outcome']}: {record['words']}"
        for name, rows in vanishing["solvers"].items()
        for solver, record in rows.items()
    }
    return table


def _designs(synthesis: Any) -> Table:
    optimum = synthesis["h2-effort"]
    groups = {
        "one X": synthesis["single"]["std"],
        "(8) as printed": {g: d for g, d in synthesis["single"]["print"].items() if "certified" in d},
        "dilated": synthesis["dilated"]["levels"],
        "non-fragile, effort": synthesis["nonfragile"]["designs"],
    }
    flat = {f"{group} {name}": design for group, designs in groups.items() for name, design in designs.items()}
    feasible = {name: design for name, design in flat.items() if design["certified"] is not None}
    table: Table = {
        "design_certified_h2": {name: "none" if d["certified"] is None else d["certified"] for name, d in flat.items()},
        "optimal_h2_lower": {gain: found["h2_lower"] for gain, found in optimum.items()},
        "optimal_h2_closed": {gain: found["h2_closed"] for gain, found in optimum.items()},
        "optimal_coupling": {
            f"{gain}, K{place}": float(found["K"][i, j])
            for gain, found in optimum.items()
            for place, i, j in (("13", 0, 2), ("31", 2, 0), ("16", 0, 5), ("34", 2, 3))
        },
        "published_over_optimum": {gain: found["published_over_optimum"] for gain, found in optimum.items()},
        "dilated_scalars": {g: f"e1 = {d['e1']}, e2 = {d['e2']}" for g, d in synthesis["dilated"]["levels"].items()},
        "nonfragile_radius": {n: d["radius"] for n, d in synthesis["nonfragile"]["designs"].items() if "radius" in d},
        "nonfragile_least_effort": {
            name: "none" if found["effort"] is None else found["effort"]
            for name, found in synthesis["nonfragile"]["least_effort"].items()
        },
        "printed_design_words": {
            f"g = {g}, {solver}": words
            for g, found in synthesis["single"]["print"].items()
            if "least_effort" in found
            for solver, words in found.items()
            if solver != "least_effort"
        },
        "printed_least_effort": {
            g: found["least_effort"] for g, found in synthesis["single"]["print"].items() if "least_effort" in found
        },
    }
    for key in ("h2", "effort", "hinf"):
        table[f"design_{key}"] = {name: design[key] for name, design in feasible.items()}
        table[f"design_{key}"] |= {f"optimum at the effort of K_{g}": d[key] for g, d in optimum.items()}
    return table | _solvers(synthesis["solvers"])


def _solvers(solvers: Any) -> Table:
    spread, values, words = {}, {}, {}
    for name, by_units in solvers.items():
        for units, found in by_units.items():
            spread[f"{name}, {units}"] = "fewer than two" if found["agrees"] is None else found["spread"]
            for solver, record in found["solvers"].items():
                case = f"{name}, {units}, {solver}"
                values[case] = "none" if record["value"] is None else record["value"]
                words[case] = f"{record['outcome']}: {record['words']}"
    return {"solver_spread": spread, "solver_value": values, "solver_words": words}


def _runs(simulation: Any) -> Table:
    linear, nonlinear = simulation["linear"]["values"], simulation["nonlinear"]["values"]
    runs = dict(linear["runs"])
    runs |= {f"{gain}, {case}": f for gain, cases in linear["disturbance"].items() for case, f in cases.items()}
    runs |= {f"nonlinear, {name}": found for name, found in nonlinear.items()}
    table: Table = {
        "settling_time": {
            f"{name}, {100 * float(fraction):g} % {words}": value
            for name, found in runs.items()
            for key, words in (("of_x0", "of 0.1 rad"), ("of_peak", "of the peak"))
            for fraction, value in found[key].items()
        },
        "angle_at": {f"{n}, {t} s": value for n, f in runs.items() for t, value in f["angle_at"].items()},
        "energy": _per(linear["disturbance"], lambda f: f["energy"]),
        "steady_amplitude": _per(linear["disturbance"], lambda f: np.asarray(f["steady_amplitude"])),
        "growth_per_period": {n: f["growth_per_period"] for n, f in runs.items() if "growth_per_period" in f},
        "end_of_run": {name: f"{found['end']} at {found['end_time']:.2f} s" for name, found in nonlinear.items()},
        "integration_difference": {
            f"{gain}, {method}": value for gain, row in linear["crosscheck"].items() for method, value in row.items()
        }
        | {f"{n}, Radau": f["crosscheck"] for n, f in runs.items() if "crosscheck" in f},
    }
    for name in ("peak_angle", "peak_rate", "peak_torque", "peak_z_inf", "initial_torque"):
        table[name] = {run: found[name] for run, found in runs.items()}
    return table
