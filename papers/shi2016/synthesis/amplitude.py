"""How much Delta K the loops bear, in floats: multipliers over its amplitude and frequency, frozen F, thresholds."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import plant

STEPS = 128
FACTORS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
"""Frequencies of F over the printed one."""


def monodromies(
    A: np.ndarray, A1: np.ndarray, frequency: float, phase: float, amplitudes: np.ndarray, steps: int = STEPS
) -> np.ndarray:
    """Monodromy matrices (k, n, n) of ``x' = (A + a sin(frequency t + phase) A1) x`` for k amplitudes a at once.

    Magnus integrator of fourth order with ``steps`` steps of one period (Blanes et al., Phys. Rep. 470, 2009).
    """
    step = 2 * np.pi / frequency / steps
    node = np.sqrt(3) / 6
    product = np.repeat(np.eye(len(A))[None], len(amplitudes), axis=0)
    for j in range(steps):
        first, second = (
            A + amplitudes[:, None, None] * np.sin(frequency * (j + 0.5 + s) * step + phase) * A1 for s in (-node, node)
        )
        bracket = second @ first - first @ second
        product = _exponential(step / 2 * (first + second) + np.sqrt(3) / 12 * step**2 * bracket) @ product
    return product


def _exponential(M: np.ndarray) -> np.ndarray:
    """exp of a stack of small matrices, (k, n, n), by Taylor's series of order 14 (norms below one: error below
    1e-12)."""
    unit = np.eye(M.shape[-1])
    total = unit + M / 14
    for k in range(13, 0, -1):
        total = unit + M @ total / k
    return total


def radii(
    data: Any, gain: str, shape: str, amplitudes: np.ndarray, factor: float = 1.0, steps: int = STEPS
) -> np.ndarray:
    """Largest absolute multiplier (k,) over one period of F at each amplitude (1 is the print); more steps if
    slower."""
    A, A1, wave = _loop(data, gain, shape)
    frequency = factor * wave["frequency"]
    found = monodromies(A, A1, frequency, wave["phase"], amplitudes, int(steps * max(1.0, 1 / factor)))
    return np.abs(np.linalg.eigvals(found)).max(axis=1)


def _loop(data: Any, gain: str, shape: str) -> tuple[np.ndarray, np.ndarray, dict[str, float]]:
    si = plant.float_plant(data)
    A1 = si["B1"] @ data.float("M") @ data.float(plant.SHAPES[shape])
    wave = {"frequency": float(data["F_factor"]) * si["rate"], "phase": float(data["F_phase"]) * np.pi}
    return si["A"] + si["B1"] @ si[plant.GAINS[gain]], A1, wave


def scan(data: Any, gain: str, shape: str) -> dict[str, Any]:
    """``amplitude``, ``radius``: curve to draw; ``threshold``: least amplitude with |mu| = 1; ``factors``: |mu| at
    other frequencies; ``frozen``: intervals of constant F in [-1, 1] that destabilise, and the exact static
    threshold."""
    top = 120.0 if gain == "ext" else 1.5
    amplitudes = np.concatenate([[0.0], np.geomspace(0.02, top, 70)])
    curve = radii(data, gain, shape, amplitudes)
    return {
        "amplitude": amplitudes,
        "radius": curve,
        "threshold": _threshold(data, gain, shape, amplitudes, curve),
        "factors": {f"{f:g}": float(radii(data, gain, shape, np.array([1.0]), f)[0]) for f in FACTORS},
        "frozen": frozen(data, gain, shape),
    }


def _threshold(data: Any, gain: str, shape: str, amplitudes: np.ndarray, curve: np.ndarray) -> float | None:
    above = np.flatnonzero(curve > 1)
    if not above.size or above[0] == 0:
        return None
    low, high = amplitudes[above[0] - 1], amplitudes[above[0]]
    for _ in range(4):
        grid = np.linspace(low, high, 33)
        k = int(np.flatnonzero(radii(data, gain, shape, grid) > 1)[0])
        low, high = grid[k - 1], grid[k]
    return float((low + high) / 2)


def frozen(data: Any, gain: str, shape: str, points: int = 2001) -> dict[str, Any]:
    """Constant F: share of the grid on [-1, 1] with an unstable loop, the stable interval around zero, and where the
    static stiffness det(V_q + F M N_q) vanishes, exactly (a rank-one change, so it is linear in F)."""
    A, A1, _ = _loop(data, gain, shape)
    grid = np.linspace(-1, 1, points)
    unstable = np.linalg.eigvals(A + grid[:, None, None] * A1).real.max(axis=1) >= 0
    below, above = grid[unstable & (grid < 0)], grid[unstable & (grid > 0)]
    si = plant.float_plant(data)
    stiffness = (si[plant.GAINS[gain]] + si["low"])[:, :3]
    row = data.float(plant.SHAPES[shape])[:, :3]
    static = -1.0 / float((row @ np.linalg.solve(stiffness, data.float("M")))[0, 0])
    return {
        "unstable_share": float(unstable.mean()),
        "first_unstable_negative": float(below.max()) if below.size else None,
        "first_unstable_positive": float(above.min()) if above.size else None,
        "static_threshold": static,
    }


CHART_FACTORS = np.geomspace(0.05, 5.0, 61)
CHART_AMPLITUDES = np.linspace(0.0, 1.5, 46)


def chart(data: Any) -> dict[str, Any]:
    """Exponent ln|mu|/T [1/s] of the traditional loop over frequency factor and amplitude of F, ``N-printed``."""
    _, _, wave = _loop(data, "trad", "N-printed")
    rows = []
    for factor in CHART_FACTORS:
        period = 2 * np.pi / (factor * wave["frequency"])
        found = radii(data, "trad", "N-printed", CHART_AMPLITUDES, float(factor), steps=48)
        rows.append(np.log(found) / period)
    return {"factor": CHART_FACTORS, "amplitude": CHART_AMPLITUDES, "exponent": np.array(rows)}
