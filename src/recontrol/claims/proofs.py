"""What a reading may conclude from certificates: the standalone verifier checks each of them first.

`certificates` maps names to certificates, as a reading gets them. Strengths are those that the verifier found: what
rests on several certificates is as strong as the weakest of them, whatever the type of its margin.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from recontrol.claims.values import Certified, Membership, Result, Statement, certified, strength_of, weakest
from recontrol.errors import ValueContractError


def _answers(certificates: Mapping[str, Any], names: tuple[str, ...]) -> dict[str, Certified]:
    return {name: certified(certificates[name]) for name in names}


def _together(answers: Mapping[str, Certified]) -> Certified:
    """One answer for all of them: true if they all hold, as strong as the weakest."""
    strength = weakest([answer.strength for answer in answers.values()])
    why = "; ".join(f"{name}: {answer.why}" for name, answer in answers.items())
    return Certified(all(answer.holds for answer in answers.values()), strength, why)


def verified(certificates: Mapping[str, Any], *names: str) -> Certified:
    """Whether the verifier accepts every certificate named (the truth of the value), at the weakest strength."""
    return _together(_answers(certificates, names))


def accepted(certificates: Mapping[str, Any], *names: str) -> str:
    """Weakest strength of certificates that must all verify. Raises NotProvenError that names the one that does not."""
    from recontrol.lmi.proof import NotProvenError

    answers = _answers(certificates, names)
    for name, answer in answers.items():
        if not answer.holds:
            raise NotProvenError(f"certificate {name}: {answer.why}")
    return _together(answers).strength


def undecided() -> Any:
    """A margin about zero: it leaves a statement open."""
    from flint import arb

    return arb(0, 1)


def provided(found: Certified, margin: Any) -> Any:
    """``margin`` if the certificates that it rests on hold, else one that leaves the statement open.

    It is no stronger than they are: a rational margin becomes a ball where one of them is a ball certificate. Raises
    ValueContractError for a certificate in floats, which proves nothing.
    """
    from flint import arb

    if found.strength not in ("exact", "ball"):
        raise ValueContractError(f"a certificate of strength {found.strength} supports no margin")
    if not found.holds:
        return undecided()
    return arb(margin) if strength_of(margin) == "exact" and found.strength == "ball" else margin


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
    from flint import fmpq

    value = provided(verified(certificates, *names), fmpq(-1))
    return Result(Statement({margin: value}), evidence or {}, names[0])


def located(certificates: Mapping[str, Any], name: str, evidence: Mapping[str, Any] | None = None) -> Result:
    """Membership as the certificate decides it: a point found, or none possible; open if it does not verify."""
    return Result(Membership.from_certificate(certificates[name]), evidence or {}, name)
