"""What is proven about an outcome of every member of an ensemble: a bound, or why there is none.

In: numbers that a proof gave. Out: records that travel with the distributions. A bound says what proves it and how
strongly; an outcome without one says why, so that a reader never takes the worst case found for a limit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

ROUNDING = 1e-9
"""Relative error granted to a simulated outcome, which is computed in doubles, before it contradicts a proof."""


@dataclass(frozen=True)
class Bound:
    """`value`: what no member exceeds (None: nothing is proven); `by`: the proof, or the reason; `strength`: of it."""

    value: float | None
    by: str
    strength: str | None = None

    def to_json(self) -> dict[str, Any]:
        """Keys `bound`, `bound_by`, `bound_strength`."""
        return {"bound": self.value, "bound_by": self.by, "bound_strength": self.strength}

    def contradicted_by(self, value: float, worst: str) -> bool:
        """Whether an outcome lies beyond the bound by more than its rounding; `worst`: the bad end, `max` or `min`."""
        if self.value is None:
            return False
        if not math.isfinite(value):
            return True
        beyond = value - self.value if worst == "max" else self.value - value
        return beyond > ROUNDING * abs(self.value)


def unproven(why: str) -> Bound:
    """No bound is proven."""
    return Bound(None, f"no bound is proven: {why}")


def bounded(
    value: float | None, by: str, strength: str = "ball", otherwise: str = "the proof did not succeed"
) -> Bound:
    """The bound of a proof that may have failed: None or an infinite value gives no bound, `otherwise` says why."""
    if value is None or not math.isfinite(value):
        return unproven(otherwise)
    return Bound(float(value), by, strength)


def certified(certificates: Mapping[str, Any], name: str, value: float) -> Bound:
    """The bound that a certificate of the paper states, checked again here."""
    from recontrol.lmi.verify import check

    found = check(certificates[name])
    by = f"certificate {name}: {certificates[name].get('says', '')}".removesuffix(": ")
    return bounded(value if found.holds else None, by, found.strength, f"certificate {name} was refused: {found.why}")
