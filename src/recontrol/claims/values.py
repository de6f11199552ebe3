"""What a reading may return. The strength of a finding follows from the type of its value, never from a label.

Exact: `fmpq` (and integers) or object arrays of them. Ball: `arb`, `acb` or object arrays of them. Float: `Approx`,
a float with a bound on its error.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from recontrol.approx import Approx
from recontrol.errors import ValueContractError

STRENGTHS = ("float", "ball", "exact")
"""From the weakest to the strongest."""

__all__ = [
    "Approx",
    "Certified",
    "Identity",
    "Membership",
    "Result",
    "Size",
    "Statement",
    "certified",
    "enclosure",
    "strength_of",
    "weakest",
]


def weakest(strengths: list[str]) -> str:
    """The weakest of several strengths; `exact` for none."""
    return min(strengths, key=STRENGTHS.index, default="exact")


def strength_of(scalar: Any) -> str:
    """Strength of one scalar. Raises ValueContractError for a bare float and everything else without a meaning."""
    from flint import acb, arb, fmpq, fmpz

    if isinstance(scalar, (fmpq, fmpz)) or type(scalar) is int:
        return "exact"
    if isinstance(scalar, (arb, acb)):
        return "ball"
    if isinstance(scalar, Approx):
        return "float"
    raise ValueContractError(
        f"a value of type {type(scalar).__name__} has no strength; return fmpq (exact), arb/acb (ball) or "
        "Approx(value, error)"
    )


def enclosure(scalar: Any) -> tuple[Any, Any]:
    """Exact rational lower and upper end of a real scalar. Raises ValueContractError if it is not finite."""
    from flint import arb, fmpq, fmpz

    if isinstance(scalar, fmpq):
        return scalar, scalar
    if isinstance(scalar, fmpz) or type(scalar) is int:
        return fmpq(scalar), fmpq(scalar)
    if isinstance(scalar, arb):
        if not scalar.is_finite():
            raise ValueContractError(f"the ball {scalar} is not finite")
        mid, rad = scalar.mid().fmpq(), scalar.rad().fmpq()
        return mid - rad, mid + rad
    if isinstance(scalar, Approx):
        value, error = fmpq(*float(scalar.value).as_integer_ratio()), fmpq(*float(scalar.error).as_integer_ratio())
        return value - error, value + error
    raise ValueContractError(f"a value of type {type(scalar).__name__} has no enclosure; see recontrol.claims.values")


@dataclass(frozen=True)
class Statement:
    """A predicate with margins: scalar values that must all (or any) be positive.

    margins: one scalar, or a mapping name -> scalar. strict=False lets an exact zero count as holding.
    """

    margins: Any
    strict: bool = True
    any: bool = False

    @staticmethod
    def any_of(margins: Mapping[str, Any], strict: bool = True) -> Statement:
        """True if one margin is positive."""
        return Statement(margins, strict, any=True)

    def named(self) -> dict[str, Any]:
        """Margins under their names."""
        if isinstance(self.margins, Mapping):
            return dict(self.margins)
        return {"margin": self.margins}


@dataclass(frozen=True)
class Identity:
    """Two exact objects that should be equal: fmpq scalars or arrays, flint polynomials, or sympy expressions."""

    left: Any
    right: Any


@dataclass(frozen=True)
class Size:
    """The size of a matrix as it should be."""

    rows: int
    columns: int


@dataclass(frozen=True)
class Membership:
    """Does some point of the rounding boxes satisfy a condition: True found, False proven impossible, None open."""

    inside: bool | None
    strength: str = "exact"
    why: str = ""

    @staticmethod
    def from_certificate(certificate: Mapping[str, Any]) -> Membership:
        """Truth and strength from the standalone verifier, by the certificate's statement.

        `membership` is a point inside; `exclusion` and `infeasible` leave none. Raises ValueContractError for others.
        """
        kind, answer = certificate.get("statement"), certified(certificate)
        if kind not in ("membership", "exclusion", "infeasible"):
            raise ValueContractError(f"a certificate of statement {kind!r} decides no membership")
        return Membership((kind == "membership") if answer.holds else None, answer.strength, answer.why)


@dataclass(frozen=True)
class Certified:
    """Truth of what one or several certificates state, as the standalone verifier found it; true if they hold."""

    holds: bool
    strength: str
    why: str

    def __bool__(self) -> bool:
        return self.holds


def certified(certificate: Mapping[str, Any]) -> Certified:
    """Run the standalone verifier on a certificate; a certificate that does not verify is open, not a refutation."""
    import recontrol.lmi.verify as verify

    verified = verify.check(certificate)
    return Certified(bool(verified.holds), verified.strength, verified.why)


@dataclass(frozen=True)
class Result:
    """A value together with evidence to show and the name of the certificate that proves it."""

    value: Any
    evidence: Mapping[str, Any] = field(default_factory=dict)
    certificate: str | None = None
