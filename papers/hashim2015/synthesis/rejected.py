"""Recipes for K, L and L_r that do not give the print: largest deviation and number of matching entries of each.

Artifact: ``K``, ``L``, ``L_r``, each a list of {reading, deviation, matching, of}, floats against the half units of the
print. Entries compared: first row of (52); (54); the nine of (66), three of (67) and (69).
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly
from numpy.polynomial import polynomial as ascending

from recontrol.exact.ball import midpoint, precision
from recontrol.exact.polynomial import PRECISION
from recontrol.exact.rational import from_float, to_float

from .. import recipe

IDENTITY_WEIGHTS = np.geomspace(0.01, 10.0, 13)
DIAGONAL_LEVELS = (0.0, 0.1, 1.0, 10.0)
POLE_FACTORS = (2, 3, 5)


def compare(reading: str, found: np.ndarray, printed: np.ndarray, half: np.ndarray) -> dict[str, Any]:
    """One row of the table."""
    deviation = np.abs(np.ravel(found) - np.ravel(printed))
    matching = int(np.sum(deviation <= np.ravel(half)))
    return {"reading": reading, "deviation": float(deviation.max()), "matching": matching, "of": int(deviation.size)}


def care_gain(A: np.ndarray, B: np.ndarray, Q: np.ndarray) -> np.ndarray | None:
    """LQR gain (1, n) for R = 1; None where no stabilising solution is found."""
    from scipy.linalg import LinAlgError, solve_continuous_are

    try:
        P = solve_continuous_are(A, B, Q, np.eye(1))
    except (LinAlgError, ValueError):
        return None
    K = B.T @ P
    return K if np.linalg.eigvals(A - B @ K).real.max() < 0 else None


def controller_rows(plant: recipe.Plant, data: Any) -> list[dict[str, Any]]:
    """Q = q I, and the best of all diagonal Q over DIAGONAL_LEVELS, against the first row of (52)."""
    A, B = to_float(plant.A), to_float(plant.B)
    printed, half = to_float(data["A_c"])[0], to_float(data.half("A_c"))[0]
    rows = []
    for q in IDENTITY_WEIGHTS:
        K = care_gain(A, B, q * np.eye(plant.n))
        if K is not None:
            rows.append(compare(f"Q = {q:.4g} I", (A - B @ K)[0], printed, half))
    diagonal = []
    for levels in itertools.product(DIAGONAL_LEVELS, repeat=plant.n):
        K = care_gain(A, B, np.diag(levels)) if any(levels) else None
        if K is not None:
            name = "Q = diag(" + ", ".join(f"{x:g}" for x in levels) + ")"
            diagonal.append(compare(name, (A - B @ K)[0], printed, half))
    nearest = min(diagonal, key=lambda row: row["deviation"])
    most = max(diagonal, key=lambda row: (row["matching"], -row["deviation"]))
    summary = {"reading": f"diagonal Q over {DIAGONAL_LEVELS}, nearest of {len(diagonal)}", **_rest(nearest)}
    return [*rows, summary, nearest, *([most] if most is not nearest else [])]


def _rest(row: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in row.items() if key != "reading"}


def place_float(A: np.ndarray, C: np.ndarray, poles: np.ndarray) -> np.ndarray:
    """L (n, 1) for a self-conjugate pole list, placed exactly on the float poles' real polynomial."""
    coefficients = ascending.polyfromroots(poles).real
    exact = [from_float(float(c)) for c in coefficients[:-1]] + [fmpq(1)]
    return to_float(recipe.place_estimator(A, C, fmpq_poly(exact)))


def estimator_rows(plant: recipe.Plant, entry: dict[str, Any], data: Any) -> list[dict[str, Any]]:
    """Kalman gains with other process noises, multiples of the controller poles, other roundings of the poles."""
    A, B, C = (to_float(M) for M in (plant.A, plant.B, plant.C))
    printed, half = to_float(data["L"]), to_float(data.half("L"))
    noises = {
        "BB'": B @ B.T,
        "I": np.eye(plant.n),
        "10 I": 10 * np.eye(plant.n),
        "C'C": C.T @ C,
        "10 C'C": 10 * C.T @ C,
    }
    rows = []
    for name, W in noises.items():
        gain = care_gain(A.T, C.T, W)
        if gain is not None:
            rows.append(compare(f"Kalman filter, W = {name}", gain.T, printed, half))
    for factor in POLE_FACTORS:
        L = place_float(plant.A, plant.C, factor * entry["controller_poles"])
        rows.append(compare(f"controller poles times {factor}", L, printed, half))
    poles = recipe.estimator_poles(plant, data["weight_high"])
    for places in (3, 5):
        L = recipe.place_estimator(plant.A, plant.C, recipe.typed_poly(recipe.typed(poles, places)))
        rows.append(compare(f"poles of q = 10 to {places} decimals", to_float(L), printed, half))
    rows.append(compare("poles of q = 10 unrounded", entry["L"]["exact"], printed, half))
    return rows


def reduced_rows(plant: recipe.Plant, data: Any) -> list[dict[str, Any]]:
    """Other choices of the three poles, a Kalman gain of the unmeasured part, and the printed K."""
    K = recipe.controller_gain(plant)
    poles = recipe.estimator_poles(plant, data["weight_high"])
    fast, slow = recipe.typed(poles)[0], recipe.typed(poles)[2]
    modulus = recipe.decimal_round(abs(poles[2]), 4)
    pairs = {"fast": [fast, (fast[0], -fast[1])], "slow": [slow, (slow[0], -slow[1])]}
    zero = fmpq(0)
    choices = {
        "unrounded poles": recipe.exact_poly(poles[:3]),
        "slow pair and real part of the fast": recipe.typed_poly([*pairs["slow"], (fast[0], zero)]),
        "fast pair and modulus of the slow": recipe.typed_poly([*pairs["fast"], (-modulus, zero)]),
    }
    rows = [_reduced_row(name, recipe.reduced_design(plant, K, p), data) for name, p in choices.items()]
    _, A12, _, A22, *_ = recipe.partition(plant, K)
    gain = care_gain(to_float(A22).T, to_float(A12).T, 10 * np.eye(plant.n - 1))
    if gain is not None:
        with precision(PRECISION):
            design = recipe.reduced_matrices(plant, K, from_float(gain.T))
        rows.append(_reduced_row("Kalman gain of (A22, A12), W = 10 I", design, data))
    printed_K = data["A_yaw"][:1] - data["A_c"][:1]
    design = recipe.reduced_design(plant, printed_K, recipe.typed_poly(recipe.typed(poles)[:3]))
    rows.append(_reduced_row("first three typed poles, K of (52) instead of the unrounded one", design, data))
    return rows


def _reduced_row(name: str, design: recipe.Reduced, data: Any) -> dict[str, Any]:
    found = np.concatenate([midpoint(M).ravel() for M in (design.A, design.B, design.D)])
    printed, half = (
        np.concatenate([to_float(read("A_r")).ravel(), to_float(read("B_r")).ravel(), [to_float(read("D_r"))]])
        for read in (data.__getitem__, data.half)
    )
    return compare(name, found, printed, half)


def rejected(model: dict[str, Any], data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    plant = recipe.plant_of(model, "yaw")
    entry = {
        "controller_poles": np.array([complex(z) for z in recipe.left_roots(recipe.lqr_spectrum(plant, fmpq(1)))]),
        "L": {"exact": midpoint(recipe.place_estimator(plant.A, plant.C, recipe.exact_poly(_poles(plant, data))))},
    }
    return {
        "K": controller_rows(plant, data),
        "L": estimator_rows(plant, entry, data),
        "L_r": reduced_rows(plant, data),
    }


def _poles(plant: recipe.Plant, data: Any) -> list[Any]:
    return recipe.estimator_poles(plant, data["weight_high"])
