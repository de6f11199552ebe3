"""Points and contradictions: what is true is proven, what is false is refused, whatever the solver says."""

import numpy as np
import pytest
from flint import fmpq
from inequalities import (
    bounded_real,
    lyapunov,
    positive_P,
)
from plant import PLANT, A, gain, holds, lyapunov_problem

from recontrol.exact import ball, linalg, rational
from recontrol.lmi.blocks import block, he, negative, nonnegative
from recontrol.lmi.certificate import decode
from recontrol.lmi.conditions import condition
from recontrol.lmi.faces import complement
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError, prove_feasible, prove_infeasible, prove_member
from recontrol.lmi.variables import full, scalar, symmetric


def test_feasible_points_survive_rounding():
    problem = lyapunov_problem(A)
    solution = problem.solve(margin="1e-6")
    certificate = prove_feasible(problem, solution)
    assert holds(certificate)
    assert certificate["notes"]["back_off"] == "1e-6"


@pytest.mark.parametrize("wrong", [-A, A + 3 * rational.identity(2), rational.matrix("0 1\n2 -3")])
def test_flipped_signs_and_destabilising_changes_are_refused(wrong):
    P = lyapunov_problem(A).solve().point
    with pytest.raises(NotProvenError, match="lyapunov"):
        prove_feasible(lyapunov_problem(wrong), P)


def test_a_solver_without_a_point_proves_nothing():
    problem = lyapunov_problem(-A)
    with pytest.raises(NotProvenError, match="gave no point"):
        prove_feasible(problem, problem.solve())


def test_a_point_on_the_boundary_is_not_proven():
    """The optimum of the LQR program makes the matrix singular; the float point is off it by the solver's error."""
    problem = gain()
    with pytest.raises(NotProvenError, match="bounded_real"):
        prove_feasible(problem, problem.solve(), decimals=6)


def test_an_ill_conditioned_point_is_named_when_rounding_kills_it():
    thin = Problem("thin", {"P": symmetric(2)}, [positive_P], {})
    point = {"P": np.array([[1.0, 1.0], [1.0, 1.0 + 1e-9]])}
    with pytest.raises(NotProvenError, match="positive_P"):
        prove_feasible(thin, point, decimals=6)
    assert holds(prove_feasible(thin, point, decimals=14))


def test_nonstrict_conditions_accept_singular_matrices_and_strict_ones_do_not():
    singular = {"P": rational.matrix("1 1\n1 1")}
    at_least = nonnegative(lambda P: P)
    assert holds(prove_feasible(Problem("edge", {"P": symmetric(2)}, [condition(at_least, "edge")]), singular))
    with pytest.raises(NotProvenError, match="positive_P"):
        prove_feasible(Problem("edge", {"P": symmetric(2)}, [positive_P]), singular)


def test_equalities_must_hold_exactly():
    tied = condition(lambda P: P[0:1, 0:1] - P[1:2, 1:2], "tied", sense="=")
    problem = Problem("tied", {"P": symmetric(2)}, [positive_P, tied])
    assert holds(prove_feasible(problem, {"P": rational.identity(2)}))
    with pytest.raises(NotProvenError, match="tied"):
        prove_feasible(problem, {"P": rational.matrix("1 0\n0 1.000001")})


def test_ball_data_make_ball_proofs():
    data = ball.box(A, rational.matrix("0 0\n0.1 0.1"))
    P = lyapunov_problem(A).solve().point
    assert holds(prove_feasible(lyapunov_problem(data), P), "ball")
    wide = ball.box(A, rational.matrix("0 0\n3 3"))
    with pytest.raises(NotProvenError):
        prove_feasible(lyapunov_problem(wide), P)


def test_infeasibility_is_proven_by_multipliers():
    assert holds(prove_infeasible(lyapunov_problem(-A)))
    short = Problem("short", {"P": symmetric(2)}, [positive_P, bounded_real], {**PLANT, "gamma2": fmpq(249, 1000)})
    assert holds(prove_infeasible(short))


def test_feasible_conditions_are_not_proven_infeasible():
    with pytest.raises(NotProvenError, match="finds a point"):
        prove_infeasible(lyapunov_problem(A))
    enough = Problem("enough", {"P": symmetric(2)}, [positive_P, bounded_real], {**PLANT, "gamma2": fmpq(251, 1000)})
    with pytest.raises(NotProvenError):
        prove_infeasible(enough)


def test_given_multipliers_are_checked_not_believed():
    problem = lyapunov_problem(-A)
    Z = linalg.lyapunov(A, rational.identity(2))
    assert holds(prove_infeasible(problem, multipliers={"lyapunov": Z}))
    with pytest.raises(NotProvenError, match="semidefinite"):
        prove_infeasible(problem, multipliers={"lyapunov": -Z})
    with pytest.raises(NotProvenError, match="slack of positive_P"):
        prove_infeasible(lyapunov_problem(A), multipliers={"lyapunov": Z})
    with pytest.raises(NotProvenError, match="no conditions"):
        prove_infeasible(problem, multipliers={"lyapanov": Z})
    with pytest.raises(NotProvenError, match="no contradiction"):
        prove_infeasible(problem, multipliers={})


def test_rank_one_multipliers_are_enough():
    """A state that does not decay refutes V' < 0: Z = v v' with A v = v / 2."""
    M = rational.matrix("0.5 0\n1 -2")
    v = rational.matrix("2.5\n1")
    assert holds(prove_infeasible(lyapunov_problem(M), multipliers={"lyapunov": v @ v.T}))


@negative
def descriptor(P, T, S, A):
    """[-T'A - A'T, P + T' - A'S; ., S + S']: V' < 0 with free T, S beside x' = A x, P > 0."""
    return block([[-he(T.T @ A), P + T.T - A.T @ S], [he(S)]])


DESCRIPTOR = {"P": symmetric(2), "T": full(2, 2), "S": full(2, 2)}


def test_free_unknowns_force_faces_and_they_are_found():
    """Multipliers of a descriptor form live on x' = A x: Z = [I; A] Y [I, A'] and nothing else."""
    problem = Problem("descriptor", DESCRIPTOR, [positive_P, descriptor], {"A": -A})
    certificate = prove_infeasible(problem)
    assert holds(certificate)
    assert linalg.rank(decode(certificate["witness"]["multipliers"]["descriptor"])) == 2
    W = complement(np.vstack([(-A).T, -rational.identity(2)]))
    assert holds(prove_infeasible(problem, faces={"descriptor": W}))
    with pytest.raises(NotProvenError):
        prove_infeasible(problem, faces={"descriptor": [0, 1]})


def test_descriptor_form_with_a_feasible_answer():
    problem = Problem("descriptor", DESCRIPTOR, [positive_P, descriptor], {"A": A})
    assert holds(prove_feasible(problem, problem.solve()))


def test_multipliers_of_ball_data_need_slack_or_boxes():
    """With balls in A the equation of an unknown cannot hold exactly; P > 0 absorbs it, and the proof is a ball one."""
    box = ball.box(-A, rational.matrix("0 0\n0.01 0.01"))
    Z = linalg.lyapunov(A, rational.identity(2))
    assert holds(prove_infeasible(lyapunov_problem(box), multipliers={"lyapunov": Z}), "ball")
    without = Problem("without", {"P": symmetric(2)}, [lyapunov], {"A": box})
    with pytest.raises(NotProvenError):
        prove_infeasible(without)


def test_membership_finds_a_point_in_the_box():
    P = linalg.lyapunov(A.T, rational.identity(2))
    half = rational.matrix("0.01 0.01\n0.01 0.01")
    certificate = prove_member(lyapunov_problem(A, P=(P - half, P + half)))
    assert certificate["statement"] == "membership"
    assert holds(certificate)


def test_exclusion_proves_that_there_is_none():
    low, high = rational.matrix("1 -2\n-2 1"), rational.matrix("3 -0.5\n-0.5 3")
    certificate = prove_member(lyapunov_problem(A, P=(low, high)))
    assert certificate["statement"] == "exclusion"
    assert holds(certificate)


def test_exclusion_with_ball_data():
    low, high = rational.matrix("1 -2\n-2 1"), rational.matrix("3 -0.5\n-0.5 3")
    box = ball.box(A, rational.matrix("0 0\n0.01 0.01"))
    assert holds(prove_member(lyapunov_problem(box, P=(low, high))), "ball")


@nonnegative
def at_most_root_two(x, two):
    """x^2 <= 2."""
    return block([[two, x], [1]])


@nonnegative
def at_least_root_two(x, half):
    """x^2 / 2 >= 1 and x >= 0."""
    return block([[x, 1], [half * x]])


def test_a_question_on_the_edge_stays_open():
    """Only the square root of two satisfies both conditions: no rational point does, and no multipliers exclude it."""
    data = {"two": fmpq(2), "half": fmpq(1, 2)}
    conditions = [at_most_root_two, at_least_root_two]
    problem = Problem("root", {"x": scalar()}, conditions, data, boxes={"x": (fmpq(1), fmpq(2))})
    with pytest.raises(NotProvenError, match="open"):
        prove_member(problem)
    with pytest.raises(NotProvenError):
        prove_feasible(problem, problem.solve())
