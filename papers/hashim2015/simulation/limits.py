"""Beyond the paper, the cheap part: LQG cost, what the roll zeros forbid, and designs made for the coprime radius.

Values: E[y^2 + u^2] of the full-order compensators; step-tracking ISE of cheap control against its limit; Poisson
bounds on the peak sensitivity of roll; coprime radius of unit-weight LQG and of loop shaping. No series.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.linalg import solve_continuous_are

from recontrol.systems.coprime import best_coprime_radius, coprime_radius
from recontrol.systems.lyapunov import integral_square, noise_cost
from recontrol.systems.statespace import StateSpace, loop_matrix, state_space

from . import designs

PROCESS_NOISE, SENSOR_NOISE = (
    10.0,
    1.0,
)  # intensities of W = 10 B B' and V = 1, the noise that makes the estimator optimal
INPUT_WEIGHTS = (1e-4, 1e-8, 1e-12)
REJECTION = (0.5, 0.1)  # abs(S) <= this up to the frequency below
BANDWIDTHS = (0.3, 0.6, 0.8, 0.9, 1.0, 1.5)  # rad/s
SHAPING = 1.1  # loop shaping at 1.1 times the smallest attainable gamma


def lqg_cost(plant: StateSpace, compensator: StateSpace) -> float:
    """E[y^2 + u^2] of the loop under process noise at the input and sensor noise.

    Infinite for a compensator with a direct term: white sensor noise then reaches u.
    """
    m = compensator.A.shape[0]
    noise = np.block(
        [
            [math.sqrt(PROCESS_NOISE) * plant.B, math.sqrt(SENSOR_NOISE) * plant.B @ compensator.D],
            [np.zeros((m, 1)), math.sqrt(SENSOR_NOISE) * compensator.B],
        ]
    )
    outputs = np.block([[plant.C, np.zeros((1, m))], [compensator.D @ plant.C, compensator.C]])
    direct = np.array([[0.0, 0.0], [0.0, math.sqrt(SENSOR_NOISE) * compensator.D[0, 0]]])
    return noise_cost(StateSpace(loop_matrix(plant, compensator), noise, outputs, direct))


def lqg_optimum(plant: StateSpace) -> float:
    """The least E[y^2 + u^2]: tr(X W) + tr(Y K'K) from the two Riccati solutions."""
    A, B, C, _ = plant
    W = PROCESS_NOISE * B @ B.T
    X = solve_continuous_are(A, B, C.T @ C, np.eye(1))
    Y = solve_continuous_are(A.T, C.T, W, SENSOR_NOISE * np.eye(1))
    K = B.T @ X
    return float(np.trace(X @ W) + (K @ Y @ K.T)[0, 0])


def published_full(plant: StateSpace, data: Any) -> StateSpace:
    """Full-order compensator of yaw with the printed gains (64), (65), (54)."""
    K = np.hstack([np.atleast_2d(data.float("K1")), np.atleast_2d(data.float("K2"))])
    L = np.reshape(data.float("L"), (4, 1))
    return state_space(plant.A - plant.B @ K - L @ plant.C, L, -K)


def tracking_ise(plant: StateSpace, input_weight: float) -> float:
    """Integral of (y - 1)^2 for a unit set-point under LQR with Q = C'C and R = `input_weight`, from rest."""
    A, B, C, _ = plant
    n = A.shape[0]
    P = solve_continuous_are(A, B, C.T @ C, np.array([[input_weight]]))
    K = B.T @ P / input_weight
    rest = np.linalg.solve(np.block([[A, B], [C, np.zeros((1, 1))]]), np.append(np.zeros(n), 1.0))[:n]
    return float(integral_square(A - B @ K, C, -rest))


def right_zeros(plant: StateSpace) -> np.ndarray:
    """Zeros with positive real part, of a plant in controller form (its C is the numerator)."""
    zeros = np.roots(plant.C[0])
    return zeros[zeros.real > 0]


def poisson_bound(zero: complex, rejection: float, bandwidth: float) -> float:
    """Least peak sensitivity of any stable loop with abs(S) <= `rejection` up to `bandwidth`, given the zero x + j y.

    Source: Seron, Braslavsky, Goodwin, Fundamental Limitations in Filtering and Control (1997), ch. 3.
    """
    x, y = zero.real, abs(zero.imag)
    angle = math.atan((bandwidth - y) / x) + math.atan((bandwidth + y) / x)
    return (1 / rejection) ** (angle / (math.pi - angle))


def unit_lqg(plant: StateSpace) -> StateSpace:
    """LQG compensator with all weights one."""
    A, B, C, _ = plant
    K = B.T @ solve_continuous_are(A, B, C.T @ C, np.eye(1))
    L = solve_continuous_are(A.T, C.T, B @ B.T, np.eye(1)) @ C.T
    return state_space(A - B @ K - L @ C, L, -K)


def loop_shaping(plant: StateSpace) -> StateSpace:
    """Central compensator whose coprime radius is at least b_opt / 1.1 (McFarlane and Glover 1990), u = +K y."""
    A, B, C, _ = plant
    gamma = SHAPING / best_coprime_radius(plant)
    X = solve_continuous_are(A, B, C.T @ C, np.eye(1))
    Z = solve_continuous_are(A.T, C.T, B @ B.T, np.eye(1))
    F = -B.T @ X
    L = (1 - gamma**2) * np.eye(A.shape[0]) + X @ Z
    H = gamma**2 * np.linalg.solve(L.T, Z @ C.T)
    return state_space(A + B @ F + H @ C, H, B.T @ X)


def limits(model: dict[str, Any], synthesis: dict[str, Any], data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Artifact described at the head of this module."""
    values: dict[str, Any] = {}
    for axis in designs.AXES:
        plant = designs.plant_of(model, axis)
        zeros = right_zeros(plant)
        entry: dict[str, Any] = {
            "lqg_optimum": lqg_optimum(plant),
            "lqg_cost": {
                name: designs.number(lqg_cost(plant, designs.loop_of(model, synthesis, axis, name).compensator))
                for name in ("full", "corrected")
            },
            "tracking_ise": {f"{weight:g}": tracking_ise(plant, weight) for weight in INPUT_WEIGHTS},
            "tracking_ise_limit": float(sum(2 / z for z in zeros).real) if zeros.size else 0.0,
            "coprime_best": best_coprime_radius(plant),
            "coprime_unit_lqg": coprime_radius(plant, unit_lqg(plant)).value,
            "coprime_loop_shaping": coprime_radius(plant, loop_shaping(plant)).value,
        }
        if zeros.size:
            entry["poisson"] = {
                f"{rejection:g}": {f"{w:g}": poisson_bound(complex(zeros[0]), rejection, w) for w in BANDWIDTHS}
                for rejection in REJECTION
            }
        values[axis] = entry
    yaw = designs.plant_of(model, "yaw")
    values["yaw"]["lqg_cost"]["published"] = lqg_cost(yaw, published_full(yaw, data))
    return values, {}
