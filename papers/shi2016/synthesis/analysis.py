"""What the published gains do: norms over their rounding boxes, and Floquet theory of the loop with Delta K."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import midpoint, precision, to_ball
from recontrol.exact.rational import to_float

from .. import plant


def norms(data: Any) -> dict[str, Any]:
    """Per Earth radius and gain, SI units.

    ``h2``, ``h2_box``, ``effort``, ``trace_of_root``, ``h2_dual``: balls; ``hinf``: lower and upper bound, excess over
    1e-3, frequency [rad/s]; ``h2_vertices``: least and largest over the vertices of the box (floats); ``pareto``: h2
    effort^3 over its least value; ``axes``: natural frequency [rad/s] and damping ratio of each axis; ``V``: K + low.
    """
    return {case: {gain: _norms(data, case, gain) for gain in plant.GAINS} for case in plant.RADII}


def _norms(data: Any, case: str, gain: str) -> dict[str, Any]:
    from recontrol.systems.norms import h2_norm, hinf_norm

    rate, K = plant.orbital_rate(data, case), data[plant.GAINS[gain]]
    with precision(plant.BITS):
        si = plant.matrices(data, rate)
        A, B, V = plant.closed_loop(si, K), si["B2"], to_ball(K) + si["low"]
        h2 = h2_norm(A, B, si["C2"], bits=plant.BITS)
        effort = h2_norm(A, B, K, bits=plant.BITS)
        weight = data["z_weight"]
        peak = hinf_norm(A, B, V, si["D1"] * (1 / weight), rtol=1e-14, bits=plant.BITS)
        box = h2_norm(plant.closed_loop(si, plant.gain_box(data, gain)), B, si["C2"], bits=plant.BITS)
        gramian = _gramian(A, B, si["C2"])
        return {
            "h2": h2,
            "h2_box": box,
            "h2_dual": _dual_h2(A, B, si["C2"]),
            "trace_of_root": _trace_of_root(gramian),
            "effort": effort,
            "pareto": h2 * effort**3 / plant.pareto_constant(data),
            "hinf": {
                "lower": peak.lower * weight,
                "upper": peak.upper * weight,
                "excess_lower": (peak.lower - 1) * weight,
                "excess_upper": arb(peak.upper - 1) * weight,
                "frequency": peak.frequency,
            },
            "h2_vertices": _vertices(data, case, gain),
            "V": midpoint(V),
            "coupling": {name: V[i, j] for name, i, j in COUPLING},
            "axes": _axes(data, midpoint(V)),
        }


COUPLING = (("13", 0, 2), ("31", 2, 0), ("16", 0, 5), ("34", 2, 3))


def _gramian(A: np.ndarray, B: np.ndarray, C: np.ndarray) -> np.ndarray:
    """(1/2 pi) times the integral of G G* over frequency, (3, 3)."""
    from recontrol.exact.linalg import lyapunov

    return C @ lyapunov(to_ball(A), to_ball(B @ B.T)) @ C.T


def _dual_h2(A: np.ndarray, B: np.ndarray, C: np.ndarray) -> arb:
    """H2 norm from the observability equation: the second route to the root of the trace."""
    from recontrol.exact.linalg import lyapunov

    return np.trace(B.T @ lyapunov(to_ball(A).T, to_ball(C.T @ C)) @ B).sqrt()


def _trace_of_root(gramian: np.ndarray) -> arb:
    """Trace of the matrix square root: the sum of the roots of the eigenvalues."""
    from recontrol.systems.stability import spectrum

    symmetric = (gramian + gramian.T) * fmpq(1, 2)
    return sum((value.real.sqrt() for value in spectrum(symmetric, plant.BITS)), arb(0))


def _vertices(data: Any, case: str, gain: str) -> list[float]:
    """Least and largest H2 norm over the 2^10 (2^8) vertices of the rounding box, in floats."""
    si, K = plant.float_plant(data, case), data.float(plant.GAINS[gain])
    places = np.argwhere(K != 0)
    signs = 2 * ((np.arange(2 ** len(places))[:, None] >> np.arange(len(places))) & 1) - 1
    gains = np.repeat(K[None], len(signs), axis=0)
    gains[:, places[:, 0], places[:, 1]] += signs * float(to_float(plant.half_unit(data, gain)))
    loops = si["A"] + si["B1"] @ gains
    unit = np.eye(6)
    operator = np.einsum("bij,kl->bikjl", loops, unit) + np.einsum("ij,bkl->bikjl", unit, loops)
    right = np.broadcast_to(-(si["B2"] @ si["B2"].T).reshape(36, 1), (len(signs), 36, 1))
    gramians = np.linalg.solve(operator.reshape(-1, 36, 36), right).reshape(-1, 6, 6)
    values = np.sqrt(np.einsum("bii->b", gramians[:, :3, :3]))
    return [float(values.min()), float(values.max())]


def _axes(data: Any, V: np.ndarray) -> dict[str, list[float]]:
    inertia = [float(j) for j in plant.inertias(data)]
    frequency = [float(np.sqrt(-V[i, i] / j)) for i, j in enumerate(inertia)]
    damping = [float(-V[i, 3 + i] / j / (2 * w)) for i, (j, w) in enumerate(zip(inertia, frequency, strict=True))]
    return {"natural_frequency": frequency, "damping": damping}


def floquet(data: Any) -> dict[str, Any]:
    """The loop with Delta K: per gain, Earth radius and N the enclosed multipliers; thresholds and scans in floats."""
    from . import amplitude

    enclosed = {
        gain: {case: {shape: _multipliers(data, gain, case, shape) for shape in plant.SHAPES} for case in plant.RADII}
        for gain in plant.GAINS
    }
    scans = {gain: {shape: amplitude.scan(data, gain, shape) for shape in plant.SHAPES} for gain in plant.GAINS}
    return {"enclosed": enclosed, "scans": scans, "chart": amplitude.chart(data)}


def perturbation(data: Any, rate: Any) -> dict[str, Any]:
    """Frequency [rad/s], phase [rad] and period [s] of F as balls."""
    frequency = rate * data["F_factor"]
    return {"frequency": frequency, "phase": arb.pi() * data["F_phase"], "period": 2 * arb.pi() / frequency}


def _multipliers(data: Any, gain: str, case: str, shape: str) -> dict[str, Any]:
    from recontrol.systems import periodic

    with precision(plant.BITS):
        rate = plant.orbital_rate(data, case)
        si, row = plant.matrices(data, rate), data[plant.SHAPES[shape]]
        wave = perturbation(data, rate)
        push = si["B1"] @ data["M"]
        mode = periodic.Mode(push @ row, wave["frequency"], wave["phase"])
        loop = plant.closed_loop(si, data[plant.GAINS[gain]])
        wide = plant.closed_loop(si, plant.gain_box(data, gain))
        point = periodic.monodromy(loop, [mode], wave["period"], steps=64, order=24)
        box = periodic.monodromy(wide, [mode], wave["period"], steps=64, order=24)
        size = periodic.spectral_radius(point)
        discs = periodic.multiplier_discs(point)
        return {
            "period": wave["period"],
            "multipliers": [complex(centre) for centre, _ in discs],
            "largest": size,
            "exponent": size.log() / wave["period"],
            "largest_box": periodic.spectral_radius(box),
            "doubling": periodic.period_doubling_margin(point),
            "doubling_box": periodic.period_doubling_margin(box),
            "radius": periodic.quadratic_stability_radius(loop, push, row),
        }
