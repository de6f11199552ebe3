"""Every number beyond the claims. Names, units and meaning: paper.yaml, `quantities`."""

from __future__ import annotations

from typing import Any

from . import experiments, gains, observer


def quantities(data: Any, model: Any, synthesis: Any, certificates: Any, simulation: Any) -> dict[str, Any]:
    """All quantities; a value that depends on a case is a mapping case -> value."""
    return {
        **observer.quantities(data, model, synthesis),
        **gains.quantities(data, synthesis, certificates),
        **experiments.quantities(simulation),
    }
