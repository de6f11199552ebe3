"""What readings conclude from certificates: true, false or open, with the verifier's strength."""

from __future__ import annotations

import copy
from typing import Any

import pytest
from flint import arb, fmpq

from recontrol.claims import proofs
from recontrol.claims.values import Approx, Membership, ValueContractError, strength_of
from recontrol.exact import ball, rational
from recontrol.lmi import loops
from recontrol.lmi.blocks import positive
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError, prove_infeasible
from recontrol.lmi.variables import scalar


@positive
def above(x: Any) -> Any:
    return x - 3


@positive
def below(x: Any) -> Any:
    return 2 - x


@pytest.fixture(scope="module")
def certificates() -> dict[str, Any]:
    """One of rationals, one of balls, one without a solution, and one that says too much."""
    M = rational.matrix("-1 0.5\n0 -2")
    exact = loops.prove_stable(M)
    wrong = copy.deepcopy(exact)
    wrong["data"]["M"] = [["1", "0"], ["0", "1"]]
    empty = Problem("empty", {"x": scalar()}, [above, below], {})
    return {
        "exact": exact,
        "box": loops.prove_stable(ball.box(M, rational.matrix("0.1 0.1\n0 0.1"))),
        "empty": prove_infeasible(empty, multipliers={"above": rational.identity(1), "below": rational.identity(1)}),
        "wrong": wrong,
    }


def test_proven_carries_the_strength_of_the_verifier(certificates) -> None:
    for name, strength in (("exact", "exact"), ("box", "ball")):
        found = proofs.proven(certificates, name, {"seen": 1})
        assert (found.value.holds, found.value.strength) == (True, strength)
        assert (found.certificate, found.evidence) == (name, {"seen": 1})
    assert not proofs.proven(certificates, "wrong").value.holds


def test_a_refutation_is_as_strong_as_its_weakest_certificate(certificates) -> None:
    alone = proofs.refuted(certificates, "exact", margin="solutions").value.margins["solutions"]
    both = proofs.refuted(certificates, "exact", "box").value.margins["proof of the contrary"]
    assert (alone, strength_of(alone)) == (fmpq(-1), "exact")
    assert (both < 0, strength_of(both)) == (True, "ball")


def test_a_refutation_without_its_proof_is_open(certificates) -> None:
    (margin,) = proofs.refuted(certificates, "exact", "wrong").value.margins.values()
    assert margin.contains(0)
    assert margin.contains(fmpq(1, 2))


def test_what_rests_on_a_certificate_is_open_without_it(certificates) -> None:
    assert proofs.provided(proofs.verified(certificates, "exact", "box"), fmpq(7)) == 7
    assert proofs.provided(proofs.verified(certificates, "exact", "wrong"), fmpq(7)).contains(0)


@pytest.mark.parametrize(("names", "strength"), [(("exact",), "exact"), (("exact", "box"), "ball"), (("box",), "ball")])
def test_a_rational_margin_is_as_strong_as_the_certificates_it_rests_on(certificates, names, strength) -> None:
    found = proofs.verified(certificates, *names)
    assert (bool(found), found.strength) == (True, strength)
    assert strength_of(proofs.provided(found, fmpq(7))) == strength


def test_a_margin_with_an_error_of_its_own_keeps_it(certificates) -> None:
    assert strength_of(proofs.provided(proofs.verified(certificates, "exact"), arb(7))) == "ball"
    assert strength_of(proofs.provided(proofs.verified(certificates, "box"), Approx(7.0, 0.5))) == "float"


def test_accepted_gives_the_weakest_strength_or_names_the_certificate(certificates) -> None:
    assert proofs.accepted(certificates, "exact") == "exact"
    assert proofs.accepted(certificates, "exact", "box") == "ball"
    with pytest.raises(NotProvenError, match="certificate wrong"):
        proofs.accepted(certificates, "exact", "wrong")


def test_an_empty_set_has_no_member(certificates) -> None:
    found = proofs.located(certificates, "empty")
    assert (found.value.inside, found.value.strength, found.certificate) == (False, "exact", "empty")
    broken = copy.deepcopy(certificates["empty"])
    broken["data"]["none"] = "1"
    assert proofs.located({"empty": broken}, "empty").value.inside is None
    with pytest.raises(ValueContractError, match="decides no membership"):
        Membership.from_certificate(certificates["exact"])


def test_undecided_is_neither_side_of_zero() -> None:
    assert isinstance(proofs.undecided(), arb)
    assert not proofs.undecided() > 0
    assert not proofs.undecided() < 0
