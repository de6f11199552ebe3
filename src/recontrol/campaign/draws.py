"""What ensembles draw: directions of a start, and members of the box that the rounding of a print leaves."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact.rational import to_float

Array = Any


def directions(rng: Any, shape: tuple[int, ...], length: float = 1.0) -> Array:
    """Vectors of a length in uniform directions; their components lie along the last axis of ``shape``."""
    drawn = rng.standard_normal(shape)
    return length * drawn / np.linalg.norm(drawn, axis=-1, keepdims=True)


def boxed(rng: Any, count: int, data: Any, name: str, zeros_exact: bool = False) -> Array:
    """Members (count, rows, columns) of the rounding box of a printed matrix or number, uniform in every entry.

    zeros_exact: whether a printed zero stands for exactly zero.
    """
    centre = np.atleast_2d(data.float(name))
    half = to_float(np.atleast_2d(np.asarray(data.half(name), dtype=object)))
    if zeros_exact:
        half = half * (centre != 0)
    return centre + half * rng.uniform(-1, 1, (count, *centre.shape))
