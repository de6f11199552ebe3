"""Beyond the paper: margins of every loop at the plant input, its coprime radius, and the plant's best one.

Values: per axis and design the interval of stable loop gains, phase margin, peak sensitivity, radius b; per axis b_opt.
The x1 design is measured at the plant with output x1, and so is its b_opt. The peak sensitivity is also enclosed, for
every gain inside the balls of the synthesis, by a bounded-real proof.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb

from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION
from recontrol.exact.rational import identity, zeros
from recontrol.systems import coprime, margins
from recontrol.systems.norms import hinf_norm
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
        "peak_hamiltonian_difference": abs(peak.hamiltonian / peak.value - 1),
        "coprime_radius": radius.value,
        "coprime_frequency": designs.number(radius.frequency),
        "coprime_best": best,
        "coprime_fraction": radius.value / best,
        "compensator_abscissa": spectral_abscissa(loop.compensator.A),
    }


def enclosed_peak(model: dict[str, Any], synthesis: dict[str, Any], axis: str, design: str) -> arb:
    """Ball around the peak sensitivity, the plant exact and the gains in the balls of the synthesis."""
    plant, balls = model[axis]["exact"], synthesis["gains"][axis]["balls"]
    A, B, C = plant["A"], plant["B"], plant["C"]
    seen = identity(A.shape[0])[:1] if design == "x1" else C
    with precision(PRECISION):
        if design == "full":
            K, L = balls["K"], balls["L"]["exact"]
            Ak, Bk, Ck, Dk = A - B @ K - L @ C, L, -K, zeros(1, 1)
        else:
            found = balls["x1"]["exact"] if design == "x1" else balls["corrected"]
            Ak, Bk, Ck, Dk = (found[name] for name in "ABCD")
        loop = np.block([[A + B @ Dk @ seen, B @ Ck], [Bk @ seen, Ak]])
        outputs = np.hstack([Dk @ seen, Ck])
    inputs = np.vstack([B, zeros(Ak.shape[0], 1)])
    return hinf_norm(loop, inputs, outputs, identity(1)).value


def robustness(model: dict[str, Any], synthesis: dict[str, Any]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module; no series."""
    table = {
        axis: {
            design: {
                **measure(designs.loop_of(model, synthesis, axis, design)),
                "peak_enclosure": enclosed_peak(model, synthesis, axis, design),
            }
            for design in DESIGNS
        }
        for axis in designs.AXES
    }
    return {"axes": table}, {}
