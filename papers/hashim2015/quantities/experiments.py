"""Named numbers of the experiments: one flat table out of the simulation artifacts.

In: the artifact ``simulation``. Out: name -> {case: value}; a case joins axis, design and setting by dots. Infinite
values are the word "infinite", values that do not exist (no final value of an unstable loop) are None.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

Table = dict[str, dict[str, Any]]


def quantities(simulation: Any) -> Table:
    """All tables of this module; the names are those of paper.yaml."""
    values = {part: simulation[part]["values"] for part in PARTS}
    found: Table = {}
    for part, table in PARTS.items():
        found |= table(values[part])
    return found


def column(rows: Iterator[tuple[str, Mapping[str, Any]]], key: str) -> dict[str, Any]:
    """One entry of every row that has it."""
    return {case: row[key] for case, row in rows if key in row}


def by_axis(tree: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Rows of a tree axis -> design -> row under the case ``axis.design``."""
    for axis, table in tree.items():
        for name, row in table.items():
            yield f"{axis}.{name}", row


def steps(values: Any) -> Table:
    """Experiment 1."""
    metrics = values["metrics"]
    found = {
        f"step_{name}": column(by_axis(metrics), key)
        for name, key in (
            ("final", "final"),
            ("overshoot", "overshoot"),
            ("undershoot", "undershoot"),
            ("abscissa", "spectral_abscissa"),
        )
    }
    for band in ("1", "2", "5"):
        found[f"step_settling_{band}"] = {case: row["settling"][band] for case, row in by_axis(metrics)}
    found["pattern_count"] = {f"band-{band}": pairs["pattern_count"] for band, pairs in values["pairs"].items()}
    found["outcome_count"] = {
        f"band-{band}.{axis}.{word}": count
        for band, pairs in values["pairs"].items()
        for axis, words in pairs["counts"].items()
        for word, count in words.items()
    }
    found["like_for_like_count"] = {
        f"{axis}.{word}": row[word] for axis, row in values["like_for_like"].items() for word in ("faster", "slower")
    }
    found["same_map_S"] = dict(values["same_map_S"])
    names = {"order 8": "order-8", "order 5": "order-5", "scipy": "library"}
    found["stepping_check"] = {
        f"{axis}.{short}": difference
        for axis, routes in values["cross_check"].items()
        for route, difference in routes.items()
        for start, short in names.items()
        if route.startswith(start)
    }
    return found


def regulator(values: Any) -> Table:
    """Experiment 2."""
    keys = ("median_settling", "median_ise", "fraction_settles_first", "fraction_ties", "fraction_smaller_ise")
    return {f"regulator_{key}": column(by_axis(values["axes"]), key) for key in keys}


def sweep(values: Any) -> Table:
    """Experiment 3."""
    found: Table = {"sweep_settling": {}, "sweep_overshoot": {}, "sweep_best_weight": {}, "sweep_loss": {}}
    found |= {"sweep_front": {}, "prefilter": {}}
    for axis, entry in values["axes"].items():
        rows = {f"q-{q}": row for q, row in entry["named"].items()}
        rows |= {f"qI-{q}": row for q, row in entry["identity"].items()}
        for case, row in rows.items():
            found["sweep_settling"][f"{axis}.{case}"] = row["settling"]
            found["sweep_overshoot"][f"{axis}.{case}"] = row["overshoot"]
        for measure, best in entry["best"].items():
            found["sweep_best_weight"][f"{axis}.{measure}"] = best["q"]
            found["sweep_loss"][f"{axis}.{measure}"] = best["gain"]
        found["sweep_front"][axis] = [[p["q"], p["p"], p["settling"], p["overshoot"]] for p in entry["front"]]
        found["prefilter"][axis] = entry["prefilter"]
    return found


def pitch(values: Any) -> Table:
    """Experiment 4."""
    plants = values["plants"]
    return {
        "pitch_abscissa": {
            f"{design}.{coefficient}": row["spectral_abscissa"]
            for design, entry in plants.items()
            for coefficient, row in entry["coefficients"].items()
        },
        "pitch_singular_at": {design: entry["singular_at"] for design, entry in plants.items()},
        "pitch_rounding_shift": dict(values["between_roundings"]),
        "pitch_compensator_poles": dict(values["compensator_poles"]),
        "pitch_estimator_gain": dict(values["estimator_gain"]),
    }


def published(values: Any) -> Table:
    """The printed reduced compensator."""
    return {
        "printed_reduced_abscissa": column(iter(values["loops"].items()), "spectral_abscissa"),
        "printed_reduced_shift": {"x1": values["largest_shift"]},
    }


def robustness(values: Any) -> Table:
    """Margins at the plant input."""
    keys = (
        "gain_lower", "gain_upper", "gain_lower_frequency", "gain_upper_frequency", "gain_argument", "phase_margin",
        "peak_frequency", "peak_hamiltonian_difference", "coprime_radius", "coprime_frequency", "coprime_best",
        "compensator_abscissa",
    )  # fmt: skip
    found = {key: column(by_axis(values["axes"]), key) for key in keys}
    return found | {"peak_sensitivity": column(by_axis(values["axes"]), "peak_enclosure")}


def recovery(values: Any) -> Table:
    """Loop transfer recovery."""
    rows = {
        axis: {**{f"q-{q}": row for q, row in entry["weights"].items()}, "state-feedback": entry["state_feedback"]}
        for axis, entry in values["axes"].items()
    }
    return {f"recovery_{key}": column(by_axis(rows), key) for key in ("peak_sensitivity", "phase_margin")}


def limits(values: Any) -> Table:
    """LQG cost, limits of roll, designs made for the coprime radius."""
    found: Table = {"lqg_cost": {}, "tracking_ise": {}, "poisson_bound": {}, "coprime_design": {}}
    for axis, entry in values.items():
        found["lqg_cost"][f"{axis}.optimum"] = entry["lqg_optimum"]
        found["lqg_cost"] |= {f"{axis}.{name}": cost for name, cost in entry["lqg_cost"].items()}
        found["tracking_ise"] |= {f"{axis}.R-{weight}": ise for weight, ise in entry["tracking_ise"].items()}
        found["tracking_ise"][f"{axis}.limit"] = entry["tracking_ise_limit"]
        found["coprime_design"][f"{axis}.unit-lqg"] = entry["coprime_unit_lqg"]
        found["coprime_design"][f"{axis}.loop-shaping"] = entry["coprime_loop_shaping"]
        for rejection, row in entry.get("poisson", {}).items():
            found["poisson_bound"] |= {f"{axis}.eps-{rejection}.w-{w}": bound for w, bound in row.items()}
    return found


PARTS = {
    "steps": steps,
    "regulator": regulator,
    "sweep": sweep,
    "pitch": pitch,
    "published": published,
    "robustness": robustness,
    "recovery": recovery,
    "limits": limits,
}
