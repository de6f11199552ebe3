"""Random gains: S4 (Figs 8, 9, uniform draws held for Ts) and S5 (constant draws, rigid loop).

How long a draw is held, its amplitude and the order of its columns are parameters of the experiment; the paper
gives none.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.rk4 import rk4
from recontrol.systems.output_feedback import drifted
from recontrol.systems.regions import disk_radius

from ..loops import rigid_loops
from ..plant import PRINTED, controller, float_controller, floats, plant
from .loops import Ensemble, Run

Array = np.ndarray
STEP, HORIZON, WINDOW = 0.02, 150.0, 100.0
HOLDS = {"0.02": 0.02, "0.1": 0.1, "0.5": 0.5, "1": 1.0, "10": 10.0, "constant": 1e9}
AMPLITUDES = (1.0, 0.05)
DIVERGED = 0.1  # rad
SHOWN = ("0.1", "10")


def table(seeds: int) -> Array:
    """Draws of every step, (steps, 12, holds * seeds): F1 (6), F2 (3), F3 (3), hold times outermost."""
    steps = round(HORIZON / STEP)
    columns = []
    for hold in HOLDS.values():
        index = np.floor(np.arange(steps) * STEP / hold + 1e-9).astype(int)
        for seed in range(seeds):
            draws = np.random.default_rng(seed).uniform(0, 1, (int(HORIZON / hold) + 2, 12))
            columns.append(draws[index])
    return np.stack(columns, axis=-1)


class Held:
    """Drift of a step (12, runs), looked up once per step; column j of the table serves every run that names it."""

    def __init__(self, uniform: Array, columns: Array, scale: Array) -> None:
        self.uniform, self.columns, self.scale = uniform, columns, scale
        self.step, self.value = -1, np.zeros(())

    def __call__(self, k: int, t: float) -> Array:
        if k != self.step:
            last = min(k, len(self.uniform) - 1)
            self.step, self.value = k, self.uniform[last][:, self.columns] * self.scale
        return self.value


def number_of_seeds(config: Any) -> int:
    """Seeds of a cell: ten, unless the configuration says otherwise."""
    return int(config.get("li2021", {}).get("seeds", 10))


def draws(data: Any, config: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """S4 for both controllers, amplitudes 1 and 0.05, six hold times: the same draws for both controllers."""
    seeds = number_of_seeds(config)
    uniform = table(seeds)
    count = uniform.shape[2]
    groups = [(name, amplitude) for name in PRINTED for amplitude in AMPLITUDES]
    gains = {name: float_controller(controller(data, name)) for name in PRINTED}
    ensemble = Ensemble([Run(gains[name]) for name, _ in groups for _ in range(count)], data)
    scale = np.repeat([amplitude for _, amplitude in groups], count)
    drift = Held(uniform, np.tile(np.arange(count), len(groups)), scale)

    def observe(k: int, t: float, x: Array) -> Array:
        torque = np.linalg.norm(ensemble.control(x, drift(k, t)), axis=0)
        return np.vstack([x[:3], torque])

    t, kept = rk4(ensemble.rhs(drift), ensemble.initial(), STEP, round(HORIZON / STEP), observe=observe)
    shaped = kept.reshape(len(t), 4, len(PRINTED), len(AMPLITUDES), len(HOLDS), seeds)
    return _summary(t, shaped), _shown(t, shaped)


def _summary(t: Array, kept: Array) -> dict[str, Any]:
    """Per amplitude and hold time: diverged counts, medians and torque of both, seeds where the proposed is smaller."""
    residual = np.abs(kept[t >= WINDOW, :3]).max(axis=(0, 1))
    diverged = ~(residual < DIVERGED)
    torque = kept[:, 3].max(axis=0)
    out: dict[str, Any] = {}
    for i, amplitude in enumerate(AMPLITUDES):
        for j, hold in enumerate(HOLDS):
            cell: dict[str, Any] = {}
            for c, name in enumerate(PRINTED):
                good = ~diverged[c, i, j]
                cell[name] = {
                    "diverged": int((~good).sum()),
                    "median": float(np.median(residual[c, i, j][good])) if good.any() else None,
                    "torque": float(torque[c, i, j][good].max()) if good.any() else None,
                }
            both = np.where(diverged[:, i, j], np.inf, residual[:, i, j])
            cell["proposed-smaller"] = int((both[0] < both[1]).sum())
            out[f"{amplitude:g}/{hold}"] = cell
    return out


def _shown(t: Array, kept: Array) -> dict[str, Array]:
    """Angles of seed 0 at full amplitude for the hold times of the figures; cut at 1 rad, where a run has diverged."""
    holds = list(HOLDS)
    series = {}
    for c, name in enumerate(PRINTED):
        for hold in SHOWN:
            angles = kept[::5, :3, c, 0, holds.index(hold), 0]
            series[f"{name}/{hold}"] = np.clip(np.nan_to_num(angles, nan=1.0), -1.0, 1.0)
    return series | {"time": t[::5]}


def constant_gains(data: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """S5: rigid loops at 20000 constant uniform(0, 1) gain deviations; fractions and their binomial standard errors."""
    count = 20000
    points = np.random.default_rng(7).uniform(0, 1, (count, 12))
    p = floats(plant(data))
    a, b = data.float("disk_a"), data.float("disk_b")
    values: dict[str, Any] = {}
    for name in PRINTED:
        poles = np.linalg.eigvals(rigid_loops(p, drifted(float_controller(controller(data, name)), points)))
        for what, hits in (("unstable", poles.real.max(axis=1) >= 0), ("outside", disk_radius(poles, a) >= b)):
            share = float(hits.mean())
            error = float(np.sqrt(share * (1 - share) / count))
            values.setdefault(name, {})[what] = {"share": share, "standard-error": error}
    return values, {}
