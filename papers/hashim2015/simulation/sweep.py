"""Experiment 3: is q = 1 the best weight in the printed range? Step response of the LQR loop (reading S).

The weights are Q = q C'C and q I, with R = 1.

Values: metrics at named weights, minimisers, what q = 1 loses, the front of (settling, overshoot) over mixed weights,
the reference gain that gives q = 1 a unit final value. Series: settling time and overshoot over the sweep.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import solve_continuous_are

from recontrol.simulate import linear, settling
from recontrol.systems.statespace import StateSpace, spectral_abscissa

from . import designs

SAMPLES = 3001
HORIZON_IN_TIME_CONSTANTS = 16
BAND = 0.02
GRID_SIZE, MIXED_SIZE = 41, 5
NAMED = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1e4)
IDENTITY = (0.1, 1.0, 10.0)


def lqr_loop(plant: StateSpace, Q: np.ndarray) -> StateSpace:
    """r to y with u = r - K x, K from the weights Q and R = 1."""
    P = solve_continuous_are(plant.A, plant.B, Q, np.eye(1))
    return plant._replace(A=plant.A - plant.B @ plant.B.T @ P)


def measure(loop: StateSpace) -> dict[str, float]:
    """Settling time [s] in the 2 % band and overshoot (fraction of the final value)."""
    response = linear.step_response(loop, HORIZON_IN_TIME_CONSTANTS / -spectral_abscissa(loop.A), SAMPLES)
    final = linear.final_value(loop)
    return {
        "settling": settling.settling_time(response, final, BAND),
        "overshoot": settling.overshoot(response, final),
        "final": final,
    }


def minimiser(weights: np.ndarray, values: np.ndarray, at_one: float) -> dict[str, Any]:
    """The best weight of the sweep, and how much better it is than q = 1."""
    k = int(np.argmin(values))
    return {"q": float(weights[k]), "value": float(values[k]), "at_q1": at_one, "gain": at_one - float(values[k])}


def front(plant: StateSpace, weights: np.ndarray) -> list[dict[str, float]]:
    """The weights q C'C + p I that no other one beats in both settling time and overshoot, by settling.

    q takes every one of the weights, p too, and zero besides.
    """
    output, identity = plant.C.T @ plant.C, np.eye(plant.A.shape[0])
    tried = [
        {"q": float(q), "p": float(p), **measure(lqr_loop(plant, q * output + p * identity))}
        for q in weights
        for p in (0.0, *weights)
    ]
    kept: list[dict[str, float]] = []
    for point in sorted(tried, key=lambda m: (m["settling"], m["overshoot"])):
        if not kept or point["overshoot"] < kept[-1]["overshoot"]:
            kept.append(point)
    return kept


def sweep(model: dict[str, Any], data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    values: dict[str, Any] = {"axes": {}}
    ends = data.float("weight_low"), data.float("weight_high")
    weights, few = np.geomspace(*ends, GRID_SIZE), np.geomspace(*ends, MIXED_SIZE)
    series: dict[str, np.ndarray] = {"q": weights}
    for axis in designs.AXES:
        plant = designs.plant_of(model, axis)
        output, identity = plant.C.T @ plant.C, np.eye(plant.A.shape[0])
        grid = [measure(lqr_loop(plant, q * output)) for q in weights]
        named = {f"{q:g}": measure(lqr_loop(plant, q * output)) for q in NAMED}
        best = {}
        for name in ("settling", "overshoot"):
            curve = np.array([m[name] for m in grid])
            series[f"{axis}/{name}"] = curve
            best[name] = minimiser(weights, curve, named["1"][name])
        values["axes"][axis] = {
            "named": named,
            "identity": {f"{q:g}": measure(lqr_loop(plant, q * identity)) for q in IDENTITY},
            "best": best,
            "front": front(plant, few),
            "prefilter": 1 / named["1"]["final"],
        }
    return values, series
