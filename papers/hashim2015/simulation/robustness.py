"""Beyond the paper: margins of every loop at the plant input, its coprime radius, and the plant's best one.

Values: per axis and design the interval of stable loop gains, phase margin, peak sensitivity, radius b; per axis b_opt.
The x1 design is measured at the plant with output x1, and so is its b_opt.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.systems import coprime, margins
from recontrol.systems.statespace import spectral_abscissa

from . import designs

DESIGNS = ("full", "corrected", "x1")


def measure(loop: designs.Loop) -> dict[str, Any]:
    """All margins of one stable loop; frequencies [rad/s], angles [deg]."""
    num, den = margins.loop_transfer(loop.plant, loop.compensator)
    gain = margins.gain_interval(num, den)
    phase = margins.phase_margin(num, den)
    peak = margins.peak_sensitivity(loop.plant, loop.compensator)
    radius = coprime.coprime_radius(loop.plant, loop.compensator)
    best = coprime.best_coprime_radius(loop.plant)
    return {
        "gain_lower": gain.lower,
        "gain_upper": designs.number(gain.upper),
        "gain_lower_frequency": None if np.isnan(gain.lower_frequency) else designs.number(gain.lower_frequency),
        "gain_upper_frequency": None if np.isnan(gain.upper_frequency) else designs.number(gain.upper_frequency),
        "gain_argument": gain.argument,
        "phase_margin": designs.number(phase.degrees),
        "phase_crossings": [list(pair) for pair in phase.crossings],
        "peak_sensitivity": peak.value,
        "peak_frequency": designs.number(peak.frequency),
        "peak_confirmed": bool(peak.lower > 0 and np.isfinite(peak.upper)),
        "coprime_radius": radius.value,
        "coprime_frequency": designs.number(radius.frequency),
        "coprime_best": best,
        "coprime_fraction": radius.value / best,
        "compensator_abscissa": spectral_abscissa(loop.compensator.A),
    }


def robustness(model: dict[str, Any], synthesis: dict[str, Any]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module; no series."""
    table = {
        axis: {design: measure(designs.loop_of(model, synthesis, axis, design)) for design in DESIGNS}
        for axis in designs.AXES
    }
    return {"axes": table}, {}
