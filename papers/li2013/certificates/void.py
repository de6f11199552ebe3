"""The printed (21) holds for stable, open and destabilised loops alike: points for the gains K_bar, 0, -K_bar."""

from __future__ import annotations

from typing import Any

from flint import fmpq

from recontrol.exact import rational

from .. import conditions as c
from .. import problems as pr
from ..points import prove, with_start
from ..synthesis.points import BOTH

# P1 = P2 = P3 = I, T1 = S2 = 0, T2 = -I, S1 = I, S3 = -I, times a common factor that lets (22) hold as well.
PATTERN = {"P1": 1, "P2": 1, "P3": 1, "T1": 0, "T2": -1, "S1": 1, "S2": 0, "S3": -1}
FACTOR = 15


def pattern(n: int = 9) -> dict[str, Any]:
    """The witness as exact multiples of the identity."""
    return {name: rational.identity(n) * fmpq(FACTOR * k) for name, k in PATTERN.items()}


def _void(data: Any, gain: str) -> dict[str, Any]:
    listed = [*pr.decay_conditions(BOTH, c.PRINTED), *pr.definite_conditions(), *pr.thrust_conditions("all")]
    says = f"(21) and (22) as printed hold for the gain {gain} with multiples of the identity"
    return prove(data, f"void-{gain}", f"gain={gain} alpha=0.02 h=0.5", listed, pattern(), says)


def void_K(data: Any) -> dict[str, Any]:
    """For the published gain."""
    return _void(data, "K_bar")


def void_zero(data: Any) -> dict[str, Any]:
    """For no control at all."""
    return _void(data, "zero")


def void_minus(data: Any) -> dict[str, Any]:
    """For the published gain with the wrong sign."""
    return _void(data, "minus")


def _print(data: Any, synthesis: Any, name: str) -> dict[str, Any]:
    stored = synthesis["points"][name]
    says = "(21), (22), (47) as printed hold with V(0) equal to the print"
    return prove(data, name, stored["case"], with_start(BOTH, c.PRINTED), stored["point"], says)


def print_K(data: Any, synthesis: Any) -> dict[str, Any]:
    """Printed (21), (22), (47) with the printed V(0), published gain."""
    return _print(data, synthesis, "print-K")


def print_minus(data: Any, synthesis: Any) -> dict[str, Any]:
    """The same for the gain with the wrong sign."""
    return _print(data, synthesis, "print-minus")
