"""Every number beyond the claims, under the names of paper.yaml."""

from __future__ import annotations

from typing import Any

from .experiments import experiment_quantities


def quantities(simulation: Any) -> dict[str, Any]:
    """Name -> {case: value}."""
    return experiment_quantities(simulation)
