"""Proofs: what is true is proven and enclosed, what is false is refused, whatever the solver says."""

import numpy as np
import pytest
from flint import arb, fmpq
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from inequalities import (
    bounded_real,
    gramian,
    lyapunov,
    lyapunov_with,
    output_power,
    positive_P,
    riccati,
    squared_gain,
    trace_of_P,
)

from recontrol.exact import ball, linalg, rational
from recontrol.lmi import loops, verify
from recontrol.lmi.blocks import block, eye, he, negative, nonnegative, positive
from recontrol.lmi.certificate import decode
from recontrol.lmi.conditions import condition, maximise, minimise
from recontrol.lmi.enclosure import bound_by_multipliers, bound_by_point, enclose
from recontrol.lmi.faces import complement
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError, prove_feasible, prove_infeasible, prove_member
from recontrol.lmi.variables import full, scalar, symmetric

A, B, C = rational.matrix("0 1\n-2 -3"), rational.matrix("0\n1"), rational.matrix("1 0")
PLANT = {"A": A, "B": B, "C": C}
# Each example solves; shrinking a failure would solve hundreds of times.
SETTINGS = settings(derandomize=True, deadline=None, max_examples=10, phases=[Phase.explicit, Phase.generate])


def holds(certificate, strength="exact"):
    found = verify.check(certificate)
    return found.holds and found.strength == strength


def lyapunov_problem(M, **boxes):
    return Problem("lyapunov", {"P": symmetric(M.shape[0])}, [positive_P, lyapunov], {"A": M}, boxes=boxes)


# -- enclosures of optima known in closed form -------------------------------------------------------------------------


def lqr():
    data = {"A": A, "B": B, "Q": rational.identity(2), "R": rational.identity(1)}
    return Problem("lqr", {"P": symmetric(2)}, [riccati], data, maximise(trace_of_P))


def gain():
    return Problem(
        "gain", {"P": symmetric(2), "gamma2": scalar()}, [positive_P, bounded_real], PLANT, minimise(squared_gain)
    )


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


# -- feasibility ------------------------------------------------------------------------------------------------------


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


# -- infeasibility ----------------------------------------------------------------------------------------------------


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


def test_multipliers_of_ball_data_need_slack_or_boxes():
    """With balls in A the equation of an unknown cannot hold exactly; P > 0 absorbs it, and the proof is a ball one."""
    box = ball.box(-A, rational.matrix("0 0\n0.01 0.01"))
    Z = linalg.lyapunov(A, rational.identity(2))
    assert holds(prove_infeasible(lyapunov_problem(box), multipliers={"lyapunov": Z}), "ball")
    without = Problem("without", {"P": symmetric(2)}, [lyapunov], {"A": box})
    with pytest.raises(NotProvenError):
        prove_infeasible(without)


# -- membership -------------------------------------------------------------------------------------------------------


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


# -- loops ------------------------------------------------------------------------------------------------------------


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


def test_box_lemma_of_a_symmetric_matrix():
    """M0 + he(E D F) over the box is the family [2, d; d, 2] with abs(d) <= 1."""
    E, F = rational.matrix("1\n0"), rational.matrix("0 1")
    problem = Problem(
        "box", {"T": symmetric(1)}, [loops.box_definite], {"M0": 2 * rational.identity(2), "E": E, "F": F}
    )
    assert holds(prove_feasible(problem, {"T": rational.matrix("1")}, statement="box"))
    with pytest.raises(NotProvenError):
        prove_feasible(problem, {"T": rational.matrix("3")}, statement="box")


# -- problems whose answer is known by construction --------------------------------------------------------------------

entries = st.integers(-5, 5)


@st.composite
def squares(draw, n):
    values = draw(st.lists(entries, min_size=n * n, max_size=n * n))
    return rational.matrix([values[i * n : (i + 1) * n] for i in range(n)])


@given(st.data(), st.integers(2, 4))
@SETTINGS
def test_stable_by_construction_is_proven_feasible(data, n):
    """(J - R) Q with J skew and R, Q > 0 is stable, with V = x'Q x."""
    G, H, J = (data.draw(squares(n)) for _ in range(3))
    one = rational.identity(n)
    M = ((J - J.T) - (G @ G.T + one)) @ (H @ H.T + one)
    problem = lyapunov_problem(M)
    assert holds(prove_feasible(problem, problem.solve()))


@given(st.data(), st.integers(2, 3))
@SETTINGS
def test_infeasible_by_construction_is_proven_infeasible(data, n):
    """M x' + x M' = I has a solution x > 0 for M = (J + R) Q; it is a multiplier against any Lyapunov matrix."""
    G, H, J = (data.draw(squares(n)) for _ in range(3))
    one = rational.identity(n)
    M = ((J - J.T) + (G @ G.T + one)) @ (H @ H.T + one)
    problem = lyapunov_problem(M)
    assert problem.solve().outcome == "infeasible"
    assert holds(prove_infeasible(problem))
    with pytest.raises(NotProvenError):
        prove_feasible(problem, {"P": H @ H.T + one})


@positive
def shifted(x, M):
    return x * eye(M.shape[0]) - M


def height(x):
    return x


@given(squares(3))
@SETTINGS
def test_largest_eigenvalues_are_enclosed(M):
    S = M + M.T
    problem = Problem("eigenvalue", {"x": scalar()}, [shifted], {"M": S}, minimise(height), units={"x": 10})
    found = enclose(problem)
    largest = np.linalg.eigvalsh(rational.to_float(S))[-1]
    # The float eigenvalue is good to 1e-13 of a norm below 60.
    assert rational.to_float(found.lower) <= largest + 1e-11
    assert rational.to_float(found.upper) >= largest - 1e-11
    assert rational.to_float(found.upper - found.lower) < 1e-5
