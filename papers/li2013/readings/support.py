"""What several readings need: statements from certificates, the loop in exact and ball form."""

from __future__ import annotations

from typing import Any

from flint import fmpq

from recontrol.claims.values import Result, Statement
from recontrol.exact.ball import precision
from recontrol.lmi import verify
from recontrol.lmi.proof import NotProvenError
from recontrol.systems import sampled

from .. import problems as pr


def proven(certificates: Any, name: str, **evidence: Any) -> Result:
    """The statement of a certificate as it stands."""
    from recontrol.claims.values import certified

    return Result(certified(certificates[name]), evidence, certificate=name)


def accepted(certificates: Any, name: str) -> str:
    """Strength of a certificate that must verify; raises NotProvenError otherwise."""
    found = verify.check(certificates[name])
    if not found.holds:
        raise NotProvenError(f"certificate {name}: {found.why}")
    return found.strength


def excluded(certificates: Any, name: str, **evidence: Any) -> Result:
    """ "There is a solution" is false: a certificate proves that there is none (margin -1)."""
    accepted(certificates, name)
    return Result(Statement({"solutions, less one": fmpq(-1)}), evidence, certificate=name)


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
