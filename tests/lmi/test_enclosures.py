"""Optimal values known in closed form are enclosed, and no bound beyond them is proven."""

import pytest
from flint import arb, fmpq
from inequalities import (
    gramian,
    lyapunov_with,
    output_power,
    positive_P,
    riccati,
    squared_gain,
    trace_of_P,
)
from plant import PLANT, A, B, C, gain, holds

from recontrol.exact import linalg, rational
from recontrol.lmi.blocks import block, eye, he, negative
from recontrol.lmi.conditions import maximise, minimise
from recontrol.lmi.enclosure import bound_by_multipliers, bound_by_point, enclose
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError
from recontrol.lmi.variables import full, scalar, symmetric


def lqr():
    data = {"A": A, "B": B, "Q": rational.identity(2), "R": rational.identity(1)}
    return Problem("lqr", {"P": symmetric(2)}, [riccati], data, maximise(trace_of_P))


def h2():
    return Problem("h2", {"X": symmetric(2)}, [gramian], PLANT, minimise(output_power))


def least():
    data = {"A": A, "Q": rational.identity(2)}
    return Problem("least", {"P": symmetric(2)}, [positive_P, lyapunov_with], data, minimise(trace_of_P))


def riccati_trace():
    """Trace of the solution of A'P + PA - PBB'P + I = 0 for this A, B, solved by hand: p12 = sqrt5 - 2, ..."""
    p12 = arb(5).sqrt() - 2
    p22 = (arb(9) + 1 + 2 * p12).sqrt() - 3
    p11 = 3 * p12 + 2 * p22 + p12 * p22
    return p11 + p22


KNOWN = {"lqr": (lqr, riccati_trace), "gain": (gain, lambda: arb(fmpq(1, 4))), "h2": (h2, lambda: arb(fmpq(1, 12)))}
KNOWN["least"] = (
    least,
    lambda: arb(rational.trace_product(linalg.lyapunov(A.T, rational.identity(2)), rational.identity(2))),
)


@pytest.mark.parametrize("name", KNOWN)
def test_enclosures_contain_the_closed_form(name):
    problem, value = KNOWN[name][0](), KNOWN[name][1]()
    found = enclose(problem)
    assert found.lower <= value <= found.upper
    assert found.relative_width < 1e-6
    assert holds(found.lower_certificate)
    assert holds(found.upper_certificate)


def test_own_witnesses_give_bounds():
    """A little above the controllability Gramian is feasible, and the observability Gramian is the multiplier."""
    problem = h2()
    X = linalg.lyapunov(A, B @ B.T + rational.identity(2) * fmpq(1, 10**6))
    upper, certificate = bound_by_point(problem, {"X": X})
    assert holds(certificate)
    Y = linalg.lyapunov(A.T, C.T @ C)
    lower, other = bound_by_multipliers(problem, {"gramian": Y})
    assert holds(other)
    assert lower <= fmpq(1, 12) <= upper
    assert fmpq(1, 12) - lower < fmpq(1, 10**8)


def test_a_bound_beyond_the_optimum_is_refused():
    problem = h2()
    Y = linalg.lyapunov(A.T, C.T @ C) * fmpq(11, 10)
    with pytest.raises(NotProvenError, match="eliminate"):
        bound_by_multipliers(problem, {"gramian": Y})
    with pytest.raises(NotProvenError, match="gramian"):
        bound_by_point(problem, {"X": linalg.lyapunov(A, B @ B.T) * fmpq(9, 10)})


def test_no_enclosure_of_an_unbounded_or_infeasible_problem():
    with pytest.raises(NotProvenError, match="no enclosure"):
        enclose(Problem("unbounded", {"P": symmetric(2)}, [positive_P], {}, maximise(trace_of_P)), margin="1e-8")
    unstable = {"A": -A, "Q": rational.identity(2)}
    infeasible = Problem("none", {"P": symmetric(2)}, [positive_P, lyapunov_with], unstable, minimise(trace_of_P))
    with pytest.raises(NotProvenError, match="no enclosure"):
        enclose(infeasible, margin="1e-8")


DESCRIPTOR = {"P": symmetric(2), "T": full(2, 2), "S": full(2, 2)}


@negative
def descriptor_gain(P, T, S, gamma2, A, B, C):
    return block([[-he(T.T @ A) + C.T @ C, P + T.T - A.T @ S, -T.T @ B], [he(S), -S.T @ B], [-gamma2 * eye(1)]])


def test_enclosure_where_multipliers_have_no_interior():
    unknowns = {**DESCRIPTOR, "gamma2": scalar()}
    problem = Problem("gain", unknowns, [positive_P, descriptor_gain], PLANT, minimise(squared_gain))
    found = enclose(problem)
    assert found.lower <= fmpq(1, 4) <= found.upper
    assert found.relative_width < 1e-4
    assert holds(found.lower_certificate)
