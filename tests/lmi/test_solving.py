"""Solving: known optima by every solver, normalised outcomes, and answers that must not be believed."""

import os
import time

import numpy as np
import pytest
import scipy.linalg
from flint import fmpq
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

from recontrol.exact import ball, rational
from recontrol.lmi import solvers
from recontrol.lmi.blocks import eye, nonnegative, trace
from recontrol.lmi.conditions import condition, maximise, minimise
from recontrol.lmi.problem import Problem, ProblemError, agreement
from recontrol.lmi.solvers import Profile, SolverMissingError
from recontrol.lmi.variables import full, scalar, symmetric

A, B, C = rational.matrix("0 1\n-2 -3"), rational.matrix("0\n1"), rational.matrix("1 0")
PLANT = {"A": A, "B": B, "C": C}
ALL = list(solvers.PROFILES)


def gain_problem(**changes):
    given = {"units": {"P": "0.1"}, **changes}
    return Problem(
        "gain",
        {"P": symmetric(2), "gamma2": scalar()},
        [positive_P, bounded_real],
        PLANT,
        minimise(squared_gain),
        **given,
    )


def lqr_problem():
    data = {"A": A, "B": B, "Q": rational.identity(2), "R": rational.identity(1)}
    return Problem("lqr", {"P": symmetric(2)}, [riccati], data, maximise(trace_of_P))


def test_where_the_default_solver_fails_the_backup_answers_under_its_own_name(monkeypatch):
    def refuse(problem):
        raise ArithmeticError("no")

    monkeypatch.setitem(solvers.PROFILES, "REFUSING", Profile("REFUSING", "x", "none", "interior point", run=refuse))
    monkeypatch.setenv("RECONTROL_SOLVER", "REFUSING")
    solution = gain_problem().solve(fast=True)
    assert (solution.solver, solution.outcome) == ("CLARABEL", "optimal")
    assert solution.value == pytest.approx(0.25, rel=1e-5)
    named = gain_problem().solve("REFUSING")
    assert (named.solver, named.outcome) == ("REFUSING", "failed")


@pytest.mark.parametrize("solver", ALL)
def test_options_of_a_search_are_the_solvers_own(solver):
    assert gain_problem().solve(solver, fast=True).value == pytest.approx(0.25, rel=1e-5)


@pytest.mark.parametrize("solver", ALL)
def test_bounded_real_lemma_gives_the_peak_gain(solver):
    """1/(s^2 + 3 s + 2) has its peak 1/2 at zero frequency."""
    solution = gain_problem().solve(solver)
    assert solution.outcome in ("optimal", "inaccurate")
    # Solvers stop at gaps of 1e-7 or better, relative to 1: below 1e-5 of 0.25.
    assert solution.value == pytest.approx(0.25, rel=1e-5)


@pytest.mark.parametrize("solver", ALL)
def test_lqr_gives_the_riccati_solution(solver):
    a, b = rational.to_float(A), rational.to_float(B)
    expected = scipy.linalg.solve_continuous_are(a, b, np.eye(2), np.eye(1))
    solution = lqr_problem().solve(solver)
    assert solution.value == pytest.approx(np.trace(expected), rel=1e-5)
    # The optimum of a Riccati inequality is flat to first order: the matrix has the root of the objective's accuracy.
    np.testing.assert_allclose(solution.point["P"], expected, atol=1e-3)


def test_h2_norm_is_the_gramian():
    """||1/(s^2 + 3 s + 2)||_2^2 = 1/(2 * 3 * 2)."""
    problem = Problem("h2", {"X": symmetric(2)}, [gramian], PLANT, minimise(output_power))
    assert problem.solve().value == pytest.approx(1 / 12, rel=1e-6)


def test_lyapunov_equation_is_the_least_solution():
    problem = Problem(
        "least",
        {"P": symmetric(2)},
        [positive_P, lyapunov_with],
        {"A": A, "Q": rational.identity(2)},
        minimise(trace_of_P),
    )
    exact = scipy.linalg.solve_continuous_lyapunov(rational.to_float(A).T, -np.eye(2))
    solution = problem.solve()
    assert solution.value == pytest.approx(np.trace(exact), rel=1e-6)
    assert min(solution.margins.values()) > -1e-6


@nonnegative
def shifted(x, C5):
    """t I + sum of edge unknowns minus the all-ones matrix, for the pentagon."""
    n = C5.shape[0]
    return x[0:1, 0:1] * eye(n) - C5 - _edges(x, n)


def _edges(x, n):
    total = 0
    for k in range(n):
        E = np.zeros((n, n), dtype=int)
        E[k, (k + 1) % n] = E[(k + 1) % n, k] = 1
        total = x[k + 1 : k + 2, 0:1] * E + total
    return total


def first(x):
    return trace(x[0:1, 0:1])


def lovasz(n):
    """Theta of the odd cycle: min t with t I - J - sum_edges y E >= 0."""
    ones = rational.matrix([[1] * n] * n)
    return Problem(f"theta C{n}", {"x": full(n + 1, 1)}, [shifted], {"C5": ones}, minimise(first))


@pytest.mark.parametrize("n", [5, 7])
def test_published_value_lovasz_theta_of_odd_cycles(n):
    """Lovasz, IEEE Trans. Inf. Theory 25 (1979) 1-7: theta(C_n) = n cos(pi/n) / (1 + cos(pi/n)), sqrt(5) for C_5."""
    expected = n * np.cos(np.pi / n) / (1 + np.cos(np.pi / n))
    assert lovasz(n).solve().value == pytest.approx(expected, rel=1e-6)


def test_units_change_the_numbers_a_solver_sees_not_the_answer():
    T = [fmpq(1), fmpq(1, 1000)]
    left, right = rational.diagonal([1 / t for t in T]), rational.diagonal(T)
    badly = {"A": left @ A @ right, "B": left @ B, "C": C @ right}
    conditions = [positive_P, bounded_real]
    unknowns = {"P": symmetric(2), "gamma2": scalar()}
    problem = Problem("scaled", unknowns, conditions, badly, minimise(squared_gain), units={"P": T})
    assert problem.solve().value == pytest.approx(0.25, rel=1e-6)


def test_margin_holds_strict_conditions_off():
    problem = Problem("feasible", {"P": symmetric(2)}, [positive_P, lyapunov], {"A": A})
    assert min(problem.solve(margin="0.01").margins.values()) >= 0.01 - 1e-7
    largest = problem.solve()
    assert largest.outcome == "optimal"
    assert float(largest.margin) == pytest.approx(1.0, abs=1e-6)


def test_boxes_bind_the_unknowns():
    low, high = rational.matrix("1 0.1\n0.1 1"), rational.matrix("2 0.2\n0.2 1.5")
    problem = Problem(
        "boxed", {"P": symmetric(2)}, [positive_P], {}, maximise(trace_of_P), boxes={"P": (low, high)}, units={"P": 7}
    )
    solution = problem.solve()
    assert solution.value == pytest.approx(3.5, rel=1e-6)
    assert solution.margins["box of P"] > -1e-7


def test_infeasible_problems_are_named_and_carry_no_point():
    unstable = Problem("unstable", {"P": symmetric(2)}, [positive_P, lyapunov], {"A": -A})
    solution = unstable.solve()
    assert solution.outcome == "infeasible"
    assert not solution.has_point
    assert solution.value is None
    assert "no proof" in solution.reason
    too_small = Problem("small", {"P": symmetric(2)}, [positive_P, bounded_real], {**PLANT, "gamma2": fmpq(1, 5)})
    assert too_small.solve().outcome == "infeasible"
    assert too_small.solve(margin="1e-6").outcome == "infeasible"


def test_unbounded_problems_are_named():
    problem = Problem("unbounded", {"P": symmetric(2)}, [positive_P], {}, maximise(trace_of_P))
    solution = problem.solve()
    assert solution.outcome == "unbounded"
    assert solution.value is None


def test_missing_solvers_say_so():
    with pytest.raises(SolverMissingError, match="no solver profile"):
        gain_problem().solve("MOSEK")
    with pytest.raises(SolverMissingError, match="not installed"):
        gain_problem().solve(Profile("X", "X", "no_such_package", "interior point"))


def stub(run):
    return Profile("stub", "stub", "none", "interior point", run=run)


def lying(problem):
    """Says optimal at a point that violates the conditions, with a fine value."""
    problem.solve(solver="CLARABEL")
    for v in problem.variables():
        v.value = 0.01 * v.value


def boasting(problem):
    """A right point, with a wrong objective."""
    problem.solve(solver="CLARABEL")
    problem._value = 0.1


def not_finite(problem):
    problem.solve(solver="CLARABEL")
    problem.variables()[0].value[:] = np.nan


@pytest.mark.parametrize(
    ("run", "outcome", "words"),
    [(lying, "failed", "violated"), (boasting, "inaccurate", "solver reported"), (not_finite, "failed", "not finite")],
)
def test_a_lying_solver_is_not_believed(run, outcome, words):
    solution = gain_problem().solve(stub(run))
    assert solution.words == "optimal"
    assert solution.outcome == outcome
    assert words in solution.reason


def test_crash_hang_and_exception_are_outcomes():
    crashed = gain_problem().solve(stub(lambda problem: os._exit(11)))
    assert (crashed.outcome, crashed.value) == ("failed", None)
    assert "code 11" in crashed.words
    started = time.perf_counter()
    hung = gain_problem().solve(stub(lambda problem: time.sleep(60)), time_limit=0.5)
    assert time.perf_counter() - started < 20
    assert "out of time" in hung.words

    def raising(problem):
        raise ArithmeticError("singular KKT matrix")

    raised = gain_problem().solve(stub(raising))
    assert "singular KKT matrix" in raised.words
    assert raised.outcome == "failed"


def test_a_time_limit_binds_a_real_solver():
    rng = np.random.default_rng(0)
    n = 14
    M = rational.rounded(rng.standard_normal((n, n)) - 6 * np.eye(n), 3)
    data = {"A": M, "B": rational.identity(n), "C": rational.identity(n)}
    problem = Problem(
        "large", {"P": symmetric(n), "gamma2": scalar()}, [positive_P, bounded_real], data, minimise(squared_gain)
    )
    # CVXOPT knows no limit of its own; translating the problem for it alone takes longer than this one.
    solution = problem.solve("CVXOPT", time_limit=0.005)
    assert solution.outcome == "failed"
    assert "out of time" in solution.words


def test_agreement_counts_optimal_interior_point_answers():
    solutions = [gain_problem().solve(name) for name in ALL]
    found = agreement(solutions, relative=1e-5)
    assert found["agrees"] is True
    assert "SCS" not in found["voters"]
    assert set(found["solvers"]) == set(ALL)
    lone = agreement([solutions[0], gain_problem().solve(stub(lying))])
    assert lone["agrees"] is None
    other = Problem("other", {"P": symmetric(2)}, [positive_P, lyapunov], {"A": A})
    assert agreement([other.solve()])["spread"] is None


def test_record_is_the_same_in_each_run():
    assert gain_problem().solve().record() == gain_problem().solve().record()


def test_malformed_problems_say_what_is_wrong():
    with pytest.raises(ProblemError, match="different names"):
        Problem("twice", {"P": symmetric(2)}, [positive_P, positive_P])
    with pytest.raises(ProblemError, match="both a variable and a datum"):
        Problem("clash", {"P": symmetric(2)}, [positive_P], {"P": A})
    with pytest.raises(ProblemError, match="no variables"):
        Problem("units", {"P": symmetric(2)}, [positive_P], units={"Q": 2})
    with pytest.raises(rational.NotExactError, match="datum A"):
        Problem("floats", {"P": symmetric(2)}, [lyapunov], {"A": np.eye(2)})
    broken = Problem("unit", {"P": symmetric(2)}, [positive_P], units={"P": ([1, 2], [1, 3])})
    with pytest.raises(ProblemError, match="breaks its structure"):
        broken.unknown_units  # noqa: B018


def test_balls_reach_the_solver_as_midpoints():
    data = {**PLANT, "A": ball.box(A, rational.matrix("0.1 0\n0 0.1"))}
    problem = Problem("balls", {"P": symmetric(2)}, [positive_P, lyapunov], {"A": data["A"]})
    assert (problem.float_data["A"] == rational.to_float(A)).all()


def test_equalities_are_conditions_too():
    tied = condition(lambda P: P[0:1, 0:1] - P[1:2, 1:2], "tied", sense="=")
    problem = Problem("tied", {"P": symmetric(2)}, [positive_P, lyapunov, tied], {"A": A})
    solution = problem.solve(margin="0.1")
    assert solution.point["P"][0, 0] == pytest.approx(solution.point["P"][1, 1], abs=1e-6)
