"""Section 7: the experiments, as tables by axis and reading. Unsettled responses have the word ``infinite``."""

from __future__ import annotations

from typing import Any


def flat(table: Any, *path: str) -> dict[str, Any]:
    """``axis, name`` -> value found under ``path`` in table[axis][name], left out where there is none."""
    out = {}
    for axis, rows in table.items():
        for name, row in rows.items():
            value: Any = row
            for key in path:
                value = value.get(key) if isinstance(value, dict) else None
            if value is not None:
                out[f"{axis}, {name}"] = value
    return out


def steps(values: Any) -> dict[str, Any]:
    """Experiment 1."""
    metrics, pairs = values["metrics"], values["pairs"]
    bands = sorted(pairs, key=float)
    return {
        "step_final": flat(metrics, "final"),
        "step_overshoot": flat(metrics, "overshoot"),
        "step_undershoot": flat(metrics, "undershoot"),
        "step_abscissa": flat(metrics, "spectral_abscissa"),
        **{f"step_settling_{band}": flat(metrics, "settling", band) for band in bands},
        "step_pattern_pairs": {f"{band} %": pairs[band]["pattern_count"] for band in bands},
        "step_outcomes": {
            f"{band} %, {axis}, {word}": count
            for band in bands
            for axis, counts in pairs[band]["counts"].items()
            for word, count in counts.items()
        },
        "step_same_map": values["same_map_S"],
        "step_cross_check": {
            f"{axis}, {route}": error for axis, rows in values["cross_check"].items() for route, error in rows.items()
        },
    }


def regulator(values: Any) -> dict[str, Any]:
    """Experiment 2."""
    axes = values["axes"]
    return {
        "regulator_settling": flat(axes, "median_settling"),
        "regulator_ise": flat(axes, "median_ise"),
        "regulator_settles_first": flat(axes, "fraction_settles_first"),
        "regulator_smaller_ise": flat(axes, "fraction_smaller_ise"),
    }


def sweep(values: Any) -> dict[str, Any]:
    """Experiment 3."""
    axes = values["axes"]
    named = {
        axis: {f"q = {q}": row for q, row in entry["named"].items()}
        | {f"Q = {q} I": row for q, row in entry["identity"].items()}
        for axis, entry in axes.items()
    }
    return {
        "sweep_settling": flat(named, "settling"),
        "sweep_overshoot": flat(named, "overshoot"),
        "sweep_best_weight": {f"{axis}, {name}": b["q"] for axis, e in axes.items() for name, b in e["best"].items()},
        "sweep_best_value": {f"{axis}, {name}": b["value"] for axis, e in axes.items() for name, b in e["best"].items()},
        "sweep_front": {
            axis: [[point[key] for key in ("q", "p", "settling", "overshoot")] for point in entry["front"]]
            for axis, entry in axes.items()
        },
        "sweep_prefilter": {axis: entry["prefilter"] for axis, entry in axes.items()},
    }


def pitch(values: Any) -> dict[str, Any]:
    """Experiment 4."""
    return {
        "pitch_sensitivity": {
            f"{design}, plant {text}": row["spectral_abscissa"]
            for design, entry in values["plants"].items()
            for text, row in entry["coefficients"].items()
        },
        "pitch_singular_coefficient": {design: entry["singular_at"] for design, entry in values["plants"].items()},
    }


def quantities(simulation: Any) -> dict[str, Any]:
    """Names of paper.yaml, section 7."""
    parts = {"steps": steps, "regulator": regulator, "sweep": sweep, "pitch": pitch}
    out: dict[str, Any] = {}
    for name, function in parts.items():
        out |= function(simulation[name]["values"])
    return out
