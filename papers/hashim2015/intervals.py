"""Characteristic coefficients over a rounding box, and the part of it that Kharitonov's test certifies."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from recontrol.exact.polynomial import is_hurwitz, kharitonov_corners

from . import recipe
from .loops import first_state, printed_reduced, reduced_loop
from .symbols import lifted, symbolic_charpoly


def coefficient_polynomials(model: Any, data: Any) -> list[fmpq_mpoly]:
    """Characteristic coefficients (ascending, less the leading 1) of the loop of (66)-(69), x1 measured.

    They are polynomials in the 16 deviations, each scaled to -1..1 over its half unit. Expanding them first keeps the
    ranges tight: a determinant in interval arithmetic loses six digits here.
    """
    plant = recipe.plant_of(model, "yaw")
    centre, half = printed_reduced(lambda name: data[name]), printed_reduced(data.half)
    names = [f"{name}_{i}_{j}" for name, M in centre.items() for i, j in np.ndindex(M.shape)]
    deviations = iter(fmpq_mpoly_ctx.get(names, Ordering.lex).gens())
    boxed = {}
    for name, M in centre.items():
        boxed[name] = np.empty(M.shape, dtype=object)
        for index in np.ndindex(M.shape):
            boxed[name][index] = next(deviations) * half[name][index] + M[index]
    one = boxed["D_r"][0, 0] * 0 + 1
    loop = reduced_loop(plant, first_state(plant.n), **boxed)
    return symbolic_charpoly(lifted(loop, one))[:-1]


def coefficient_range(c: fmpq_mpoly, fraction: fmpq) -> tuple[fmpq, fmpq]:
    """Enclosure of ``c`` over deviations of at most ``fraction``: the constant plus or minus the other terms' sizes."""
    constant, spread = fmpq(0), fmpq(0)
    for exponents, value in c.to_dict().items():
        degree = sum(int(e) for e in exponents)
        if degree:
            spread += abs(value) * fraction**degree
        else:
            constant = value
    return constant - spread, constant + spread


def kharitonov_fraction(model: Any, data: Any, steps: int = 20) -> fmpq:
    """Largest fraction of the rounding box of (66)-(69), x1 measured, whose coefficients pass Kharitonov's test."""
    polynomials = coefficient_polynomials(model, data)

    def passes(fraction: fmpq) -> bool:
        corners = kharitonov_corners([coefficient_range(c, fraction) for c in polynomials])
        return all(is_hurwitz(corner) is True for corner in corners)

    inside, outside = fmpq(0), fmpq(1)
    if passes(outside):
        return outside
    for _ in range(steps):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if passes(middle) else (inside, middle)
    return inside
