"""Random problems whose answer is known by construction."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from plant import holds, lyapunov_problem

from recontrol.exact import rational
from recontrol.lmi.blocks import eye, positive
from recontrol.lmi.conditions import minimise
from recontrol.lmi.enclosure import enclose
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError, prove_feasible, prove_infeasible
from recontrol.lmi.variables import scalar

# Each example solves; shrinking a failure would solve hundreds of times.
SETTINGS = settings(derandomize=True, deadline=None, max_examples=10, phases=[Phase.explicit, Phase.generate])

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
