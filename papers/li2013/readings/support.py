"""What several readings need: the loop in exact and ball form, the integral of its error."""

from __future__ import annotations

from typing import Any

from flint import fmpq

from recontrol.exact.ball import precision
from recontrol.systems import sampled

from .. import problems as pr


def loop(data: Any, orbit: str, gain: str = "K_bar") -> tuple[Any, Any, dict[str, Any]]:
    """A and B K of the orbit (exact, or balls for gain "box"), and all exact data."""
    exact = pr.exact_data(data, f"gain={gain}")
    return exact[pr.ORBITS[orbit]], exact["B"] @ exact["K"], exact


def integral_bound(data: Any, orbit: str, intervals: int = 200) -> Any:
    """Ball below the integral of e'e along the loop from x(0), d_bar = 0: the first intervals, the rest is positive."""
    A, G, exact = loop(data, orbit)
    with precision(128):
        M, W = sampled.monodromy(A, G, data["h"]), sampled.held_cost(A, G, exact["C2"], data["h"])
        x, total = exact["xi0"], fmpq(0)
        for _ in range(intervals):
            total = total + (x.T @ W @ x)[0, 0]
            x = M @ x
        return total
