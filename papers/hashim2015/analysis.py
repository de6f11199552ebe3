"""Loops of the published and of the recomputed compensators as exact or ball matrices, with their spectra.

Conventions: full ``[A, -BK; LC, Ah]``; reduced ``[A + s B D_r c, s B C_r; B_r c, A_r]`` with c = C (real output) or
c = e1' (the paper's premise), s = +1 as in (45). Rational matrices give exact characteristic polynomials and isolated
roots; ball matrices give enclosures that hold for every matrix of the box.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import acb, fmpq

from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION

from . import recipe
from .loops import first_state, full_loop, printed_reduced, reduced_loop

SIGNS = (1, -1)


def word(answer: bool | None) -> str:
    """stable, unstable or undecided."""
    return {True: "stable", False: "unstable", None: "undecided"}[answer]


def as_row(found: list[acb]) -> np.ndarray:
    """Float eigenvalues for tables; the digits shown are inside the enclosures."""
    return np.array([complex(float(z.real.mid()), float(z.imag.mid())) for z in found])


def printed_gains(data: Any) -> tuple[np.ndarray, np.ndarray]:
    """K (1, 4) of (64), (65) and L (4, 1) of (54), decimals taken as exact."""
    K1 = np.array([[data["K1"]]], dtype=object)
    return np.hstack([K1, data["K2"]]), data["L"]


def lower_right(data: Any, case: str) -> np.ndarray:
    """Lower right block of (55): case ``ace-print`` or ``ace-one``."""
    return data["A_ce" if case == "ace-print" else "A_ce_one"][4:, 4:]


def full_loops(model: Any, data: Any, synthesis: Any) -> dict[str, np.ndarray]:
    """Yaw loops of section 6.3 with different estimator matrices Ah."""
    plant = recipe.plant_of(model, "yaw")
    K, L = printed_gains(data)
    balls = synthesis["gains"]["yaw"]["balls"]
    K_ball, L_ball = balls["K"], balls["L"]["exact"]
    with precision(PRECISION):
        recomputed = full_loop(plant, K_ball, L_ball, plant.A - plant.B @ K_ball - L_ball @ plant.C)
    return {
        "A-BK-LC, unrounded gains": recomputed,
        "A-BK-LC, printed gains": full_loop(plant, K, L, plant.A - plant.B @ K - L @ plant.C),
        "lower right block of (55), ace-print": full_loop(plant, K, L, lower_right(data, "ace-print")),
        "lower right block of (55), ace-one": full_loop(plant, K, L, lower_right(data, "ace-one")),
        "A-2BK-LC, printed gains": full_loop(plant, K, L, plant.A - plant.B @ K * fmpq(2) - L @ plant.C),
    }


def reduced_loops(model: Any, data: Any) -> dict[str, np.ndarray]:
    """Printed (66)-(69) on yaw, both measurements and both signs."""
    plant = recipe.plant_of(model, "yaw")
    printed = printed_reduced(lambda name: data[name])
    measurements = {"x1": first_state(plant.n), "y": plant.C}
    return {
        f"{name} measured, s = {sign:+d}": reduced_loop(plant, c, **printed, sign=sign)
        for name, c in measurements.items()
        for sign in SIGNS
    }


def sign_loops(model: Any, synthesis: Any, axis: str) -> dict[str, np.ndarray]:
    """The x1 design of one axis, both measurements and both signs, unrounded gains."""
    plant = recipe.plant_of(model, axis)
    design = synthesis["gains"][axis]["balls"]["x1"]["exact"]
    matrices = {f"{name}_r": design[name] for name in "ABCD"}
    with precision(PRECISION):
        return {
            f"{name} measured, s = {sign:+d}": reduced_loop(plant, c, **matrices, sign=sign)
            for name, c in {"x1": first_state(plant.n), "y": plant.C}.items()
            for sign in SIGNS
        }


def printed_sign_loops(model: Any, data: Any) -> dict[str, np.ndarray]:
    """(46) with its printed sign and the typed gains: B_r consistent with it, or as (67)."""
    plant = recipe.plant_of(model, "yaw")
    K = recipe.controller_gain(plant)
    poles = recipe.typed(recipe.estimator_poles(plant, data["weight_high"]))
    design = recipe.reduced_design(plant, K, recipe.typed_poly(poles[: plant.n - 1]))
    with precision(PRECISION):
        A_r = design.A - design.B_u @ design.C - design.B_u @ design.C
        inputs = {"B_r consistent": design.B + (A_r - design.A) @ design.L, "B_r of (67)": data["B_r"].T}
        return {
            f"{how}, {name} measured, s = {sign:+d}": reduced_loop(plant, c, A_r, B_r, design.C, design.D, sign)
            for how, B_r in inputs.items()
            for name, c in {"x1": first_state(plant.n), "y": plant.C}.items()
            for sign in SIGNS
        }


def corrected_loop(model: Any, synthesis: Any, axis: str) -> np.ndarray:
    """Loop of the corrected reduced design, y measured, unrounded gains."""
    plant, design = recipe.plant_of(model, axis), synthesis["gains"][axis]["balls"]["corrected"]
    with precision(PRECISION):
        return reduced_loop(plant, plant.C, *(design[name] for name in "ABCD"))


def axis_full_loop(model: Any, synthesis: Any, axis: str) -> np.ndarray:
    """Loop of the full-order design of one axis, unrounded gains."""
    plant, balls = recipe.plant_of(model, axis), synthesis["gains"][axis]["balls"]
    K, L = balls["K"], balls["L"]["exact"]
    with precision(PRECISION):
        return full_loop(plant, K, L, plant.A - plant.B @ K - L @ plant.C)


def deciding_members(model: Any, data: Any) -> dict[str, np.ndarray]:
    """Loops of opposite verdict from two members of the rounding box of (55), lower right block, ace-print, zeros kept.

    Every nonzero entry moves by half a unit along or against the sensitivity of the real eigenvalue next to zero.
    """
    plant = recipe.plant_of(model, "yaw")
    K, L = printed_gains(data)
    block, half = lower_right(data, "ace-print"), data.half("A_ce")[4:, 4:]
    M = full_loop(plant, K, L, block).astype(float)
    values, right = np.linalg.eig(M)
    k = int(np.argmin(np.abs(values)))
    slope = np.outer(np.linalg.inv(right)[k], right[:, k]).real[4:, 4:]
    members = {}
    for name, direction in (("stable member", -1), ("unstable member", 1)):
        step = np.array(
            [
                [fmpq(int(direction * np.sign(slope[i, j]))) if block[i, j] != 0 else fmpq(0) for j in range(4)]
                for i in range(4)
            ],
            dtype=object,
        )
        members[name] = full_loop(plant, K, L, block + step * half)
    return members


def nearest(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Distances between two equally long sets of points, matched so that their sum is least."""
    from scipy.optimize import linear_sum_assignment

    distance = np.abs(first[:, None] - second[None, :])
    return distance[linear_sum_assignment(distance)]
