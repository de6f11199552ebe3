"""Exact and ball matrices: identities that hold exactly, oracles from scipy, guards against floats."""

from fractions import Fraction

import numpy as np
import pytest
import scipy.linalg
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from recontrol.exact import ball, linalg, rational

SMALL = st.integers(-9, 9)
SETTINGS = settings(derandomize=True, deadline=None, max_examples=60)


@st.composite
def square(draw, low=1, high=5):
    n = draw(st.integers(low, high))
    entries = draw(st.lists(SMALL, min_size=n * n, max_size=n * n))
    return rational.matrix([entries[i * n : (i + 1) * n] for i in range(n)])


def equal(A, B):
    return A.shape == B.shape and all(x == y for x, y in zip(A.flat, B.flat, strict=True))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-0.0250", fmpq(-1, 40)),
        ("3.036e+02", fmpq(1518, 5)),
        ("1.13e-3", fmpq(113, 100000)),
        (".5", fmpq(1, 2)),
        ("7", fmpq(7)),
        ("+2.", fmpq(2)),
        ("-1/3", fmpq(-1, 3)),
    ],
)
def test_decimal_is_exact(text, value):
    assert rational.decimal(text) == value


@pytest.mark.parametrize("text", ["", ".", "1,5", "nan", "inf", "1e", "0x10", "1/0x"])
def test_decimal_refuses_other_text(text):
    with pytest.raises(ValueError, match="expected a decimal"):
        rational.decimal(text)


@given(st.decimals(allow_nan=False, allow_infinity=False, min_value=-(10**6), max_value=10**6))
@SETTINGS
def test_decimal_agrees_with_fractions(value):
    q = rational.decimal(str(value))
    assert Fraction(int(q.p), int(q.q)) == Fraction(value)


def test_matrix_reads_text_blocks_and_refuses_ragged_ones():
    assert equal(rational.matrix("1 0.5\n-2 1e1"), rational.matrix([[1, "0.5"], [-2, 10]]))
    assert rational.matrix("1 2 3").shape == (1, 3)
    with pytest.raises(ValueError, match="equal length"):
        rational.matrix("1 2\n3")


@pytest.mark.parametrize("bad", [0.5, np.float64(1), True, arb(1)])
def test_floats_and_balls_are_not_exact(bad):
    with pytest.raises(rational.NotExactError):
        rational.rational(bad)


def test_floats_do_not_mix_with_rationals():
    with pytest.raises(TypeError):
        rational.identity(2) @ np.eye(2)
    with pytest.raises(TypeError):
        rational.identity(2) * 0.5


def test_float_round_trips():
    A = np.array([[0.1, -1e-9], [1 / 3, 2e8]])
    assert (rational.to_float(rational.from_float(A)) == A).all()
    assert rational.rounded(0.1, 3) == fmpq(1, 10)
    assert rational.rounded(np.float64(-2.5), 0) == fmpq(-2)
    assert rational.rounded(fmpq(1, 3), 4) == fmpq(3333, 10000)
    with pytest.raises((ValueError, OverflowError)):
        rational.rounded(float("nan"), 3)


def test_text_writes_fractions():
    assert rational.text(rational.matrix("0.5 -3")) == [["1/2", "-3"]]
    assert equal(rational.matrix(rational.text(rational.matrix("0.5 -3"))), rational.matrix("0.5 -3"))


@given(square(high=6))
@SETTINGS
def test_definiteness_agrees_with_eigenvalues(A):
    S = rational.symmetric_part(A) + 3 * rational.identity(A.shape[0])
    lowest = np.linalg.eigvalsh(rational.to_float(S))[0]
    # Entries are halves below 13 and the order is at most 6: an eigenvalue that is not zero exceeds 1e-9 by far.
    assert linalg.is_positive_definite(S) == (lowest > 1e-9)


def test_ldl_multiplies_back():
    A = rational.matrix("4 1 -2\n1 -3 0.5\n-2 0.5 7")
    L, d = linalg.ldl(A)
    assert equal(L @ rational.diagonal(d) @ L.T, A)
    with pytest.raises(linalg.SingularError):
        linalg.ldl(rational.matrix("0 1\n1 0"))


def test_definiteness_of_balls_is_three_valued():
    wide = ball.box(rational.matrix("1 0\n0 1"), rational.matrix("0.5 0.5\n0.5 0.5"))
    assert linalg.definiteness(ball.box(rational.identity(2), rational.matrix("0.1 0.1\n0.1 0.1"))) is True
    assert linalg.definiteness(wide - 2 * rational.identity(2)) is False
    assert linalg.definiteness(wide * 1 - rational.matrix("0.5 0\n0 0.5")) is None
    assert not linalg.is_positive_definite(wide - rational.matrix("0.5 0\n0 0.5"))


def test_a_nan_ball_is_never_definite():
    A = ball.to_ball(rational.identity(2))
    A[1, 1] = arb("nan")
    assert linalg.definiteness(A) is None


def test_unsymmetric_matrices_are_refused():
    with pytest.raises(linalg.NotSymmetricError, match=r"\(2,1\)"):
        linalg.is_positive_definite(rational.matrix("1 2\n3 1"))


def test_exactly_singular_matrix_is_decided():
    A = rational.matrix("1 2\n2 4")
    assert not linalg.is_positive_definite(A)


def test_lyapunov_agrees_with_scipy():
    A = rational.matrix("0 1 0\n-2 -3 1\n0 0.25 -0.5")
    Q = rational.matrix("1 0 0.5\n0 2 0\n0.5 0 1")
    X = linalg.lyapunov(A, Q)
    a, q = rational.to_float(A), rational.to_float(Q)
    # scipy's answer is good to a few roundings of a well-conditioned 3x3 problem.
    np.testing.assert_allclose(rational.to_float(X), scipy.linalg.solve_continuous_lyapunov(a, -q), rtol=1e-12)
    assert all(x == 0 for x in (A @ X + X @ A.T + Q).flat)


def test_ball_lyapunov_encloses_the_exact_solution():
    A, Q = rational.matrix("0 1\n-2 -3"), rational.identity(2)
    exact = linalg.lyapunov(A, Q)
    with ball.precision(100):
        enclosed = linalg.lyapunov(ball.box(A, rational.matrix("0 0\n1e-3 1e-3")), Q)
        assert all(e.contains(arb(x)) for e, x in zip(enclosed.flat, exact.flat, strict=True))
    assert ctx.prec == 53


def test_solve_says_singular():
    with pytest.raises(linalg.SingularError):
        linalg.inverse(rational.matrix("1 2\n2 4"))
    with pytest.raises(linalg.SingularError):
        linalg.inverse(ball.box(rational.identity(1), rational.matrix("2")))


@given(square(low=2, high=5))
@SETTINGS
def test_null_space_and_independent_rows(A):
    A[-1] = A[0] * 2
    N, rows = linalg.nullspace(A), linalg.independent_rows(A)
    assert N.shape[1] == A.shape[0] - linalg.rank(A)
    assert all(x == 0 for x in (A @ N).flat)
    assert linalg.rank(A[rows]) == len(rows) == linalg.rank(A) if rows else linalg.rank(A) == 0


def test_boxes_contain_their_ends_and_survive_storage():
    x = ball.ball("0.1", "0.05")
    assert x.contains(arb(fmpq(15, 100)))
    assert x.contains(arb(fmpq(5, 100)))
    with ball.precision(20):
        again = ball.from_mid_rad(ball.exact_midpoint(x), ball.exact_radius(x))
    assert again.mid() == x.mid()
    # A radius keeps 30 bits, rounded outwards: it may only grow, by one unit of its last bit.
    assert x.rad() <= again.rad() < x.rad() * (1 + fmpq(1, 2**28))


def test_guard_names_the_float():
    A = rational.identity(2)
    A[0, 1] = 0.5
    with pytest.raises(rational.NotExactError, match=r"stiffness.*float"):
        ball.assert_rigorous(A, "stiffness")
    with pytest.raises(rational.NotExactError):
        linalg.is_positive_definite(np.eye(2))


def test_precision_is_restored_after_an_error():
    def fail():
        with ball.precision(300):
            assert ctx.prec == 300
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert ctx.prec == 53
