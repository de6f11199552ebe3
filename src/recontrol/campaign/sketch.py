"""A distribution in bounded memory: exact count, extremes and worst trajectory, quantiles bracketed by narrow bins.

Sketches of two sets of trajectories merge into that of their union, in any order and with the same bytes; a campaign of
any size therefore needs the memory of one chunk.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

BINS_PER_OCTAVE = 64
"""A quantile is known to a factor of 2^(1/64), about 1.1 %."""
TINY = 2.0**-200
"""Magnitudes below this count as zero."""


@dataclass
class Sketch:
    """Distribution of one outcome over trajectories.

    worst: `max` or `min`, which end is the bad one. A value that is not finite (a diverged trajectory) is counted apart
    and is worse than every other.
    """

    worst: str = "max"
    count: int = 0
    diverged: int = 0
    minimum: float = math.inf
    maximum: float = -math.inf
    worst_index: int = -1
    bins: Counter[int] = field(default_factory=Counter)

    def add(self, values: Any, first_index: int) -> None:
        """Take in the outcomes of trajectories `first_index`, `first_index` + 1, ... (numbers over the campaign)."""
        values = np.asarray(values, dtype=float).ravel()
        finite = np.isfinite(values)
        self._note_worst(values, finite, first_index)
        self.count += values.size
        self.diverged += int(np.count_nonzero(~finite))
        good = values[finite]
        if good.size:
            self.minimum = min(self.minimum, float(good.min()))
            self.maximum = max(self.maximum, float(good.max()))
            keys, counts = np.unique(_bin(good), return_counts=True)
            self.bins.update(dict(zip(keys.tolist(), counts.tolist(), strict=True)))

    def _note_worst(self, values: Any, finite: Any, first_index: int) -> None:
        if not values.size:
            return
        if not finite.all():
            if not self.diverged:
                self.worst_index = first_index + int(np.argmin(finite))
            return
        local = int(np.argmax(values) if self.worst == "max" else np.argmin(values))
        if not self.diverged and (self.count == 0 or self._worse(float(values[local]))):
            self.worst_index = first_index + local

    def _worse(self, value: float) -> bool:
        return value > self.maximum if self.worst == "max" else value < self.minimum

    def merge(self, other: Sketch) -> Sketch:
        """The sketch of both sets together. Raises ValueError if they count different ends as bad."""
        if other.worst != self.worst:
            raise ValueError("sketches of different outcomes cannot be merged")
        return Sketch(
            self.worst,
            self.count + other.count,
            self.diverged + other.diverged,
            min(self.minimum, other.minimum),
            max(self.maximum, other.maximum),
            self._worse_of(other),
            self.bins + other.bins,
        )

    def _worse_of(self, other: Sketch) -> int:
        if not self.count or not other.count:
            return self.worst_index if self.count else other.worst_index
        if self.diverged or other.diverged:
            return min(sketch.worst_index for sketch in (self, other) if sketch.diverged)
        mine, theirs = (s.maximum if self.worst == "max" else -s.minimum for s in (self, other))
        if mine == theirs:
            return min(self.worst_index, other.worst_index)
        return self.worst_index if mine > theirs else other.worst_index

    def quantile(self, level: float) -> tuple[float, float] | None:
        """Ends of the bin that holds the `level` quantile of all trajectories, cut at the extremes.

        Diverged trajectories lie beyond the bad end: None if the quantile is one of them. Raises ValueError if there is
        no trajectory.
        """
        if not self.count:
            raise ValueError("no outcome")
        rank = min(max(math.ceil(level * self.count), 1), self.count)
        seen = self.diverged if self.worst == "min" else 0
        if rank <= seen:
            return None
        for key in sorted(self.bins):
            seen += self.bins[key]
            if seen >= rank:
                low, high = _ends(key)
                return max(low, self.minimum), min(high, self.maximum)
        return None

    def curve(self) -> tuple[Any, Any]:
        """Upper bin ends and the fraction of all trajectories at or below them (for a distribution plot)."""
        keys = sorted(self.bins)
        ends = np.array([min(_ends(key)[1], self.maximum) for key in keys])
        below = self.diverged if self.worst == "min" else 0
        return ends, (below + np.cumsum([self.bins[key] for key in keys])) / max(self.count, 1)

    def to_json(self) -> dict[str, Any]:
        """JSON types only."""
        finite = self.count > self.diverged
        return {
            "worst": self.worst,
            "count": self.count,
            "diverged": self.diverged,
            "minimum": self.minimum if finite else None,
            "maximum": self.maximum if finite else None,
            "worst_index": self.worst_index,
            "bins": {str(key): self.bins[key] for key in sorted(self.bins)},
        }

    @staticmethod
    def from_json(content: Mapping[str, Any]) -> Sketch:
        """Inverse of `to_json`."""
        return Sketch(
            content["worst"],
            int(content["count"]),
            int(content["diverged"]),
            math.inf if content["minimum"] is None else content["minimum"],
            -math.inf if content["maximum"] is None else content["maximum"],
            int(content["worst_index"]),
            Counter({int(key): int(number) for key, number in content["bins"].items()}),
        )


def _bin(values: Any) -> Any:
    """Signed logarithmic bin numbers: 0 holds zero, +-(k + OFFSET) the magnitudes from 2^(k/64) on."""
    size = np.abs(values)
    small = size < TINY
    exponent = np.floor(np.log2(np.where(small, 1.0, size)) * BINS_PER_OCTAVE).astype(int) + _OFFSET
    return np.where(small, 0, np.sign(values).astype(int) * exponent)


_OFFSET = 201 * BINS_PER_OCTAVE


def _ends(key: int) -> tuple[float, float]:
    if key == 0:
        return -TINY, TINY
    slack = 1e-12  # the logarithm of a bin's end may round to either side
    low = 2.0 ** ((abs(key) - _OFFSET) / BINS_PER_OCTAVE) * (1 - slack)
    high = 2.0 ** ((abs(key) - _OFFSET + 1) / BINS_PER_OCTAVE) * (1 + slack)
    return (low, high) if key > 0 else (-high, -low)
