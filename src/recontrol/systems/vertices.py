"""Worst cases over the vertices of a box of parameters, all loops in batched eigenvalue calls.

A vertex sweep refutes a robustness claim or supports it; it never proves one (poles are not convex in the parameters).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

Array = np.ndarray


class Worst(NamedTuple):
    """Largest value of a measure, and the parameters where it was found."""

    value: float
    at: Array


def sign_vertices(count: int) -> Array:
    """All 2^count vectors of -1 and +1, (2^count, count), in binary order."""
    if not 0 < count <= 24:
        raise ValueError(f"expected 1 to 24 parameters, found {count}")
    numbers = np.arange(2**count)[:, None]
    return np.where((numbers >> np.arange(count)[::-1]) & 1, 1.0, -1.0)


def worst_each(measures: Callable[[Array], Mapping[str, Array]], points: Array, chunk: int = 4096) -> dict[str, Worst]:
    """Largest value of each named measure over the rows of ``points`` (m, k), in chunks to bound the memory."""
    best: dict[str, Worst] = {}
    for start in range(0, len(points), chunk):
        part = points[start : start + chunk]
        for name, values in measures(part).items():
            k = int(np.argmax(values))
            if name not in best or values[k] > best[name].value:
                best[name] = Worst(float(values[k]), part[k])
    return best


def worst(measure: Callable[[Array], Array], points: Array, chunk: int = 4096) -> Worst:
    """Largest ``measure(points)`` over the rows of ``points``, see `worst_each`."""
    return worst_each(lambda part: {"": np.asarray(measure(part))}, points, chunk)[""]


def abscissa(matrices: Array) -> Array:
    """Largest real part of the eigenvalues of each matrix (batch, n, n)."""
    return np.linalg.eigvals(matrices).real.max(axis=-1)


def threshold(exceeds: Callable[[float], bool], low: float, high: float, tolerance: float) -> tuple[float, float]:
    """Bracket of the least parameter where ``exceeds`` turns true, by bisection.

    Raises ValueError unless ``exceeds`` is false at ``low`` and true at ``high``.
    """
    if exceeds(low) or not exceeds(high):
        raise ValueError(f"expected a change between {low:g} and {high:g}, found none")
    while high - low > tolerance:
        middle = (low + high) / 2
        low, high = (low, middle) if exceeds(middle) else (middle, high)
    return low, high
