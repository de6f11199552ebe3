"""What a reading may conclude from certificates: the standalone verifier checks each of them first.

`certificates` maps names to certificates, as a reading gets them. Strengths are those that the verifier found.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from recontrol.claims.values import Membership, Result, Statement, certified, weakest


def verified(certificates: Mapping[str, Any], *names: str) -> bool:
    """Whether the verifier accepts every certificate named."""
    return all(certified(certificates[name]).holds for name in names)


def accepted(certificates: Mapping[str, Any], *names: str) -> str:
    """Weakest strength of certificates that must all verify. Raises NotProvenError that names the one that does not."""
    from recontrol.lmi.proof import NotProvenError

    answers = {name: certified(certificates[name]) for name in names}
    for name, answer in answers.items():
        if not answer.holds:
            raise NotProvenError(f"certificate {name}: {answer.why}")
    return weakest([answer.strength for answer in answers.values()])


def undecided() -> Any:
    """A margin about zero: it leaves a statement open."""
    from flint import arb

    return arb(0, 1)


def provided(holds: bool, margin: Any) -> Any:
    """``margin`` if what it rests on holds, else one that leaves the statement open."""
    return margin if holds else undecided()


def proven(certificates: Mapping[str, Any], name: str, evidence: Mapping[str, Any] | None = None) -> Result:
    """The claim is what the certificate states; open if it does not verify."""
    return Result(certified(certificates[name]), evidence or {}, name)


def refuted(
    certificates: Mapping[str, Any],
    *names: str,
    margin: str = "proof of the contrary",
    evidence: Mapping[str, Any] | None = None,
) -> Result:
    """The claim is false because these certificates hold (a margin of -1 under the name ``margin``); else open."""
    from flint import arb, fmpq

    answers = [certified(certificates[name]) for name in names]
    exact = weakest([answer.strength for answer in answers]) == "exact"
    value = provided(all(answer.holds for answer in answers), fmpq(-1) if exact else arb(-1))
    return Result(Statement({margin: value}), evidence or {}, names[0])


def located(certificates: Mapping[str, Any], name: str, evidence: Mapping[str, Any] | None = None) -> Result:
    """Membership as the certificate decides it: a point found, or none possible; open if it does not verify."""
    return Result(Membership.from_certificate(certificates[name]), evidence or {}, name)
