"""Gains and compensators of every axis.

Artifact ``gains``, one entry per axis (``yaw``, ``pitch-tf``, ``pitch-ss``, ``roll``), floats unless said:

================== ============= ================================================================
key                shape         what
================== ============= ================================================================
K                  (1, n)        LQR gain of Q = C'C, R = 1
controller_poles   n, complex    roots of det(sI - A + BK), fast pair first, positive imaginary part first
estimator_poles    n, complex    the same for Q = 10 C'C
estimator_typed    n, complex    those rounded to four decimals before use
L.exact, L.typed4  (n, 1)        full-order estimator gain
Lr.exact .typed4   (n-1, 1)      reduced-order gain of the partition x1 | rest (premise y = x1)
full.exact .typed4 compensator   A = A-BK-LC, B = L, C = -K, D = 0, B_u = B; input y
x1.exact, .typed4  compensator   correct (46)-(49), input x1; state xc = xh2 - L x1
corrected          compensator   the same recipe in the states T x, input y; state xc = zh2 - L y
balls              {...}         K, L (exact, typed4), x1 (exact, typed4), corrected as balls
================== ============= ================================================================

A compensator is {A, B, C, D, B_u, L}: xc' = A xc + B m, u = C xc + D m for the measured signal m; if the plant
input carries an additional known reference r (u = r + C xc + D m), then xc' gains B_u r. ``corrected`` also has
T (n, n): with z = T x the first state z1 is y, and zh2 = xc + L y estimates (T x)[1:].
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact.ball import midpoint, precision
from recontrol.exact.polynomial import PRECISION, ball_poly, left_roots, place_estimator

from .. import recipe
from ..model import AXES


def complexes(poles: list[Any]) -> np.ndarray:
    """Midpoints of complex balls, or of pairs (re, im)."""
    return np.array(
        [complex(float(z.real), float(z.imag)) if hasattr(z, "real") else complex(*map(float, z)) for z in poles]
    )


def compensator(M: recipe.Reduced) -> dict[str, np.ndarray]:
    """Float matrices of a reduced compensator."""
    return {name: midpoint(getattr(M, name)) for name in ("A", "B", "C", "D", "B_u", "L")}


def full_compensator(plant: recipe.Plant, K: np.ndarray, L: np.ndarray) -> dict[str, np.ndarray]:
    """Full-order compensator A - BK - LC, L, -K, 0 of the measured output y."""
    with precision(PRECISION):
        Ah = plant.A - plant.B @ K - L @ plant.C
    return {
        "A": midpoint(Ah),
        "B": midpoint(L),
        "C": midpoint(-K),
        "D": np.zeros((1, 1)),
        "B_u": midpoint(plant.B),
        "L": midpoint(L),
    }


def gains(model: dict[str, Any], data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    return {axis: axis_gains(recipe.plant_of(model, axis), data["weight_high"]) for axis in AXES}


def axis_gains(plant: recipe.Plant, estimator_weight: Any) -> dict[str, Any]:
    """Every gain and compensator of one axis."""
    n = plant.n
    K = recipe.controller_gain(plant)
    poles = recipe.estimator_poles(plant, estimator_weight)
    rounded = recipe.typed(poles)
    with precision(PRECISION):
        L_exact = place_estimator(plant.A, plant.C, recipe.exact_poly(poles))
        L_typed = place_estimator(plant.A, plant.C, recipe.typed_poly(rounded))
    exact_error, typed_error = recipe.exact_poly(poles[: n - 1]), ball_poly(recipe.typed_poly(rounded[: n - 1]))
    x1 = recipe.reduced_design(plant, K, exact_error)
    x1_typed = recipe.reduced_design(plant, K, typed_error)
    measured, K_measured, T = recipe.in_measured_basis(plant, K)
    corrected = recipe.reduced_design(measured, K_measured, exact_error)
    return {
        "K": midpoint(K),
        "controller_poles": complexes(left_roots(recipe.lqr_spectrum(plant, recipe.CONTROL_WEIGHT))),
        "estimator_poles": complexes(poles),
        "estimator_typed": complexes(rounded),
        "L": {"exact": midpoint(L_exact), "typed4": midpoint(L_typed)},
        "Lr": {"exact": midpoint(x1.L), "typed4": midpoint(x1_typed.L)},
        "full": {"exact": full_compensator(plant, K, L_exact), "typed4": full_compensator(plant, K, L_typed)},
        "x1": {"exact": compensator(x1), "typed4": compensator(x1_typed)},
        "corrected": {**compensator(corrected), "T": midpoint(T)},
        "balls": {
            "K": K,
            "L": {"exact": L_exact, "typed4": L_typed},
            "x1": {"exact": vars(x1), "typed4": vars(x1_typed)},
            "corrected": vars(corrected),
        },
    }
