"""Figure regression: plotted data against the reviewed, decimated reference of the paper folder."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from recontrol.errors import PaperError
from recontrol.plotting import extent

POINTS = 160
"""A reference keeps at most about this many points of each curve."""

Curves = dict[str, tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Drift:
    """Largest scaled difference of one curve and the tolerance it was held against; None if the shape differs."""

    curve: str
    difference: float | None
    tolerance: float
    why: str

    @property
    def agrees(self) -> bool:
        """Whether the curve exists and stays within its tolerance."""
        return self.difference is not None and self.difference <= self.tolerance


def parse(content: bytes, name: str = "figure data") -> Curves:
    """CSV bytes (curve, x, y) -> curves. Raises PaperError for another header or unreadable numbers."""
    reader = csv.reader(io.StringIO(content.decode("utf-8")))
    if next(reader, None) != ["curve", "x", "y"]:
        raise PaperError(f"{name}: expected the columns curve, x, y")
    points: dict[str, list[tuple[float, float]]] = {}
    try:
        for label, x, y in reader:
            points.setdefault(label, []).append((float(x), float(y)))
    except ValueError as error:
        raise PaperError(f"{name}: {error}") from None
    return {label: tuple(np.array(pairs).T) for label, pairs in points.items()}  # type: ignore[misc]


def decimate(curves: Curves) -> Curves:
    """Every k-th point of each curve, its last point, and its extremes, in order."""
    return {label: (x[keep], y[keep]) for label, (x, y) in curves.items() for keep in [_kept(y)]}


def _kept(y: np.ndarray) -> np.ndarray:
    step = max(1, -(-y.size // POINTS))
    extremes = [] if step == 1 else [int(np.argmin(y)), int(np.argmax(y))]
    return np.unique([*range(0, y.size, step), y.size - 1, *extremes])


def compare(
    found: Curves, reference: Curves, tolerance: float, looser: Mapping[str, float] | None = None
) -> list[Drift]:
    """Hold full plotted data against a decimated reference; `looser` maps curves to tolerances of their own.

    Both axes are scaled by the range of the reference curve (its largest magnitude if the range is zero). At each point
    of the reference, the distance to the polyline through the found data is taken: a shift of a sampling instant along
    the curve is no drift, a shift of the curve is.
    """
    drifts = []
    own = looser or {}
    for label in dict.fromkeys([*reference, *found, *own]):
        allowed = own.get(label, tolerance)
        if label in found and label in reference:
            drifts.append(Drift(label, _distance(*found[label], *reference[label]), allowed, "largest scaled distance"))
            continue
        side = "the reference" if label in reference else "this run" if label in found else "paper.yaml"
        drifts.append(Drift(label, None, allowed, f"the curve exists only in {side}"))
    return drifts


def _distance(x: np.ndarray, y: np.ndarray, x_ref: np.ndarray, y_ref: np.ndarray) -> float:
    scale_x, scale_y = extent(x_ref), extent(y_ref)
    points = np.stack([x_ref / scale_x, y_ref / scale_y], axis=1)
    line = np.stack([x / scale_x, y / scale_y], axis=1)
    if len(line) == 1:
        return float(np.max(np.linalg.norm(points - line, axis=1)))
    starts, steps = line[:-1], np.diff(line, axis=0)
    lengths = np.maximum(np.sum(steps**2, axis=1), 1e-300)
    worst = 0.0
    for point in points:
        along = np.clip(np.sum((point - starts) * steps, axis=1) / lengths, 0.0, 1.0)
        worst = max(worst, float(np.min(np.linalg.norm(starts + along[:, None] * steps - point, axis=1))))
    return worst


def read(path: Path) -> Curves:
    """Curves of a reference CSV of a paper folder. Raises PaperError."""
    return parse(path.read_bytes(), str(path))
