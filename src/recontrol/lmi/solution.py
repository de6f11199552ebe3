"""What a solver answered, checked at the stored point."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from recontrol.lmi.solvers import INACCURATE, OPTIMAL


@dataclass(frozen=True)
class Solution:
    """One solver's answer, checked: words, outcome, the point, and what was recomputed from the stored point.

    ``value`` is recomputed, ``reported`` is the solver's. ``margins`` are least eigenvalues of the (scaled) conditions
    at the point, 0 or more if they hold; for an equality minus the largest residual. ``reason`` says why an outcome
    differs from the solver's words. ``seconds`` varies from run to run and is not part of `record`.
    """

    problem: str
    solver: str
    outcome: str
    words: str
    reason: str = ""
    value: float | None = None
    reported: float | None = None
    point: dict[str, Any] = field(default_factory=dict)
    margins: dict[str, float] = field(default_factory=dict)
    duals: dict[str, np.ndarray] = field(default_factory=dict)
    margin: str = "0"
    iterations: int | None = None
    seconds: float = 0.0

    @property
    def has_point(self) -> bool:
        """Whether a point came back that violates no condition grossly."""
        return self.outcome in (OPTIMAL, INACCURATE) and bool(self.point)

    def record(self) -> dict[str, Any]:
        """What an artifact keeps: everything that is the same in each run, without the point and the duals."""
        names = (
            "problem",
            "solver",
            "outcome",
            "words",
            "reason",
            "value",
            "reported",
            "margins",
            "margin",
            "iterations",
        )
        return {name: getattr(self, name) for name in names}
