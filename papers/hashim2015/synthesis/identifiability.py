"""How sharply the printed numbers identify the two weights.

Artifact: ``K`` and ``poles``, each {"lower": [outside, inside], "upper": [inside, outside]}, rationals decided.
``K``: the weights q for which every entry of the first row of (52) rounds to the print. ``poles``: those for which the
four estimator poles round to the typed ones. ``L_last``: last entry of the estimator gain for unrounded and typed
poles, and how far it moves.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from flint import acb, arb, fmpq

from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION, decide_end

from .. import recipe

SPREAD = fmpq(1, 10)
STEPS = 40


def within(x: arb, centre: fmpq, half: fmpq) -> bool | None:
    """Whether every point of the ball is within ``half`` of ``centre``; None if some are and some are not."""
    margin = half - abs(x - centre)
    return True if margin > 0 else False if margin < 0 else None


def together(answers: list[bool | None]) -> bool | None:
    """False if one is, else None if one is, else True."""
    return False if False in answers else None if None in answers else True


def row_of_52(plant: recipe.Plant, data: Any) -> Callable[[fmpq], bool | None]:
    """Does the weight q give the first row of (52)?"""
    printed, half = data["A_c"][0], data.half("A_c")[0]

    def holds(q: fmpq) -> bool | None:
        K = recipe.controller_gain(plant, q)
        with precision(PRECISION):
            return together(
                [within(x, c, h) for x, c, h in zip((plant.A - plant.B @ K)[0], printed, half, strict=True)]
            )

    return holds


def typed_poles(plant: recipe.Plant, weight: fmpq, places: int = 4) -> Callable[[fmpq], bool | None]:
    """Does the weight q give the same poles to ``places`` decimals as ``weight``?"""
    typed = recipe.typed(recipe.estimator_poles(plant, weight), places)
    half = fmpq(1, 2) / 10**places

    def near(z: acb, pole: tuple[fmpq, fmpq]) -> list[bool | None]:
        return [within(z.real, pole[0], half), within(z.imag, pole[1], half)]

    def holds(q: fmpq) -> bool | None:
        with precision(PRECISION):
            pairs = zip(recipe.estimator_poles(plant, q), typed, strict=True)
            return together([answer for z, pole in pairs for answer in near(z, pole)])

    return holds


def interval(holds: Callable[[fmpq], bool | None], centre: fmpq) -> dict[str, np.ndarray]:
    """Both ends around ``centre``, each as the last rational decided inside and the first decided outside."""
    inside_low, outside_low = decide_end(holds, centre, centre * (1 - SPREAD), STEPS)
    inside_high, outside_high = decide_end(holds, centre, centre * (1 + SPREAD), STEPS)
    return {
        "lower": np.array([outside_low, inside_low], dtype=object),
        "upper": np.array([inside_high, outside_high], dtype=object),
    }


def identifiability(model: dict[str, Any], data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    plant = recipe.plant_of(model, "yaw")
    weight = data["weight_high"]
    poles = recipe.estimator_poles(plant, weight)
    with precision(PRECISION):
        exact = recipe.place_estimator(plant.A, plant.C, recipe.exact_poly(poles))[-1, 0]
    typed = recipe.place_estimator(plant.A, plant.C, recipe.typed_poly(recipe.typed(poles)))[-1, 0]
    return {
        "K": interval(row_of_52(plant, data), recipe.CONTROL_WEIGHT),
        "poles": interval(typed_poles(plant, weight), weight),
        "L_last": {"exact": exact, "typed4": typed, "move": typed - exact},
    }
