"""Every number beyond the claims, by topic. Names, units and meaning: paper.yaml, ``quantities``."""

from __future__ import annotations

from typing import Any

from . import design, experiments, loops, structure


def quantities(data: Any, model: Any, synthesis: Any, simulation: Any) -> dict[str, Any]:
    """All quantities; a value that depends on a case is a mapping case -> value."""
    return {
        **design.quantities(data, model, synthesis),
        **loops.quantities(data, model, synthesis),
        **structure.quantities(data, model),
        **experiments.quantities(simulation),
    }
