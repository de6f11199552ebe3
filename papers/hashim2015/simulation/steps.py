"""Experiment 1: the step response under every reading of where the reference enters.

Values: per axis and reading the metrics of :func:`metrics`; all 45 pairs of a full-order with a reduced-order reading
and what each axis says; cross-checks. Series: the responses of the readings S, B, C for the figures.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate import linear, ode, settling
from recontrol.systems.statespace import StateSpace, frequency_response, spectral_abscissa

from . import designs

SAMPLES = 8001
HORIZON_IN_TIME_CONSTANTS = 16
SHOWN = {"yaw": 60.0, "pitch-tf": 20.0, "roll": 80.0}  # s, the time axes of the redrawn figures
CURVES = ("full-S", "corrected-S", "full-B", "corrected-B", "x1-B", "full-C", "corrected-C", "x1-C")


def metrics(system: StateSpace) -> dict[str, Any]:
    """Final value, settling times [s] by band, overshoot, undershoot of a unit step; unstable: settling infinite."""
    abscissa = spectral_abscissa(system.A)
    found: dict[str, Any] = {"spectral_abscissa": abscissa, "stable": abscissa < 0}
    if abscissa >= 0:
        unsettled = {percent(band): "infinite" for band in designs.BANDS}
        return {**found, "final": None, "settling": unsettled, "overshoot": None, "undershoot": None, "horizon": None}
    horizon = HORIZON_IN_TIME_CONSTANTS / -abscissa
    final = linear.final_value(system)
    response = linear.step_response(system, horizon, SAMPLES)
    return {
        **found,
        "final": final,
        "settling": {
            percent(band): designs.number(settling.settling_time(response, final, band)) for band in designs.BANDS
        },
        "overshoot": designs.number(settling.overshoot(response, final)),
        "undershoot": designs.number(settling.undershoot(response, final)),
        "horizon": horizon,
    }


def percent(band: float) -> str:
    """Key of a settling band: 0.02 -> "2"."""
    return f"{100 * band:g}"


def outcome(full: dict[str, Any], reduced: dict[str, Any], band: str) -> str:
    """Is the reduced order faster, slower or equal, by settling time?"""
    t_full, t_reduced = (float(str(m["settling"][band]).replace("infinite", "inf")) for m in (full, reduced))
    if t_reduced < t_full - designs.TIE:
        return "faster"
    return "slower" if t_reduced > t_full + designs.TIE else "equal"


def compare_pairs(table: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """Outcome of each of the 45 pairs on each axis and band, the pairs that show the paper's pattern, and counts."""
    outcomes: dict[str, Any] = {}
    for band in map(percent, designs.BANDS):
        pairs = {}
        for full in designs.FULL:
            for reduced in designs.REDUCED:
                said = {a: outcome(table[a][f"full-{full}"], table[a][reduced], band) for a in designs.AXES}
                pairs[f"full-{full} | {reduced}"] = {**said, "pattern": said == designs.PATTERN}
        counts = {
            axis: {word: sum(p[axis] == word for p in pairs.values()) for word in ("faster", "slower", "equal")}
            for axis in designs.AXES
        }
        holding = [name for name, p in pairs.items() if p["pattern"]]
        outcomes[band] = {"pairs": pairs, "counts": counts, "pattern_count": len(holding), "pattern_pairs": holding}
    return outcomes


def robust_outcomes(pairs: dict[str, Any]) -> dict[str, Any]:
    """What the like-for-like pairs B and C say of each axis over all bands: one word, or which word how often.

    S is left out: there both orders give the same response.
    """
    found: dict[str, Any] = {}
    for axis in designs.AXES:
        said = [
            table["pairs"][f"{full} | {reduced}"][axis]
            for table in pairs.values()
            for full, reduced in designs.LIKE_FOR_LIKE.values()
            if full != "full-S"
        ]
        counts = {word: said.count(word) for word in ("faster", "slower", "equal")}
        found[axis] = {"robust": max(counts.values()) == len(said), **counts}
    return found


def same_from_reference(model: dict[str, Any], synthesis: dict[str, Any], axis: str) -> float:
    """Largest relative difference of the two S maps to C (sI - A + BK)^-1 B over 200 frequencies 10^-2..10^1.5."""
    plant = designs.plant_of(model, axis)
    K = np.reshape(synthesis["gains"][axis]["K"], (1, -1))
    omega = np.logspace(-2, 1.5, 200)
    expected = frequency_response(plant._replace(A=plant.A - plant.B @ K), omega)
    found = [
        frequency_response(designs.from_reference(designs.loop_of(model, synthesis, axis, name), "S"), omega)
        for name in ("full", "corrected")
    ]
    return float(max(np.max(np.abs(f - expected) / np.abs(expected)) for f in found))


def cross_check(system: StateSpace) -> dict[str, float]:
    """Largest difference of exact stepping to three other routes, relative to the largest output (2001 samples)."""
    from scipy import signal

    horizon = HORIZON_IN_TIME_CONSTANTS / -spectral_abscissa(system.A)
    response = linear.step_response(system, horizon, 2001)
    scale = np.max(np.abs(response.outputs))
    others = {
        "order 8 (rtol 1e-11, atol 1e-13)": ode.step_outputs(system, response.times)[:, 0],
        "order 5 (rtol 1e-6, atol 1e-9)": ode.step_outputs(system, response.times, method="RK45", rtol=1e-6, atol=1e-9)[
            :, 0
        ],
        "scipy.signal.step": signal.step(tuple(system), T=response.times)[1],
    }
    return {name: float(np.max(np.abs(y - response.outputs)) / scale) for name, y in others.items()}


def steps(model: dict[str, Any], synthesis: dict[str, Any]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    found = {axis: designs.systems(model, synthesis, axis) for axis in designs.AXES}
    table = {axis: {name: metrics(s) for name, s in systems.items()} for axis, systems in found.items()}
    pairs = compare_pairs(table)
    values = {
        "metrics": table,
        "pairs": pairs,
        "like_for_like": robust_outcomes(pairs),
        "same_map_S": {axis: same_from_reference(model, synthesis, axis) for axis in designs.AXES},
        "cross_check": {axis: cross_check(found[axis]["full-C"]) for axis in designs.AXES},
    }
    series = {}
    for axis, horizon in SHOWN.items():
        series[f"{axis}/t"] = np.linspace(0.0, horizon, 1201)
        for name in CURVES:
            series[f"{axis}/{name}"] = linear.step_response(found[axis][name], horizon, 1201).outputs
    return values, series
