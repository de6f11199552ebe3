"""Stability of loops at a point and over a box."""

import pytest
from flint import fmpq
from plant import A, holds

from recontrol.exact import ball, rational
from recontrol.lmi import loops
from recontrol.lmi.proof import NotProvenError


@pytest.mark.parametrize(
    ("kind", "M", "given"),
    [
        ("hurwitz", A, {}),
        ("decay", A, {"rate": fmpq(99, 100)}),
        ("schur", rational.matrix("0.5 1\n0 -0.9"), {}),
        ("disk", A, {"centre": fmpq(-2), "radius": fmpq(101, 100)}),
    ],
)
def test_loops_are_proven_stable(kind, M, given):
    assert holds(loops.prove_stable(M, kind=kind, given=given))
    assert holds(loops.prove_stable(M, kind=kind, given=given, units=["10", "1"]))


@pytest.mark.parametrize(
    ("kind", "M", "given"),
    [
        ("hurwitz", -A, {}),
        ("decay", A, {"rate": fmpq(1)}),
        ("schur", rational.matrix("0.5 1\n0 -1"), {}),
        ("disk", A, {"centre": fmpq(-2), "radius": fmpq(1)}),
    ],
)
def test_unstable_and_marginal_loops_are_not(kind, M, given):
    with pytest.raises(NotProvenError):
        loops.prove_stable(M, kind=kind, given=given)


def test_instability_is_proven_with_some_stable_eigenvalues():
    assert holds(loops.prove_unstable(rational.matrix("0 1\n2 -3")))
    assert holds(loops.prove_unstable(ball.box(rational.matrix("0 1\n2 -3"), rational.matrix("0 0\n0.1 0.1"))), "ball")
    with pytest.raises(NotProvenError, match="somewhere_positive"):
        loops.prove_unstable(A)
    with pytest.raises(NotProvenError):
        loops.prove_unstable(rational.matrix("0 1\n-1 0"))


def test_box_lemma_proves_a_box_and_no_more():
    """[0 1; -a -b] is stable for a, b > 0: a box that stays there is proven, one that leaves it is not."""
    E, F = loops.entry_box(rational.matrix("0 0\n1 1"))
    certificate = loops.prove_box_stable(A, E, F)
    assert certificate["statement"] == "box"
    assert holds(certificate)
    E, F = loops.entry_box(rational.matrix("0 0\n2 1"))
    with pytest.raises(NotProvenError):
        loops.prove_box_stable(A, E, F)
