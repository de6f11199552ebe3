"""One function, every kind of matrix: blocks agree across kinds, and kinds that must not meet are refused."""

import numpy as np
import pytest
from flint import arb, fmpq
from inequalities import bounded_real

from recontrol.exact import ball, rational
from recontrol.exact.linalg import NotSymmetricError
from recontrol.lmi import blocks
from recontrol.lmi.affine import NotAffineError
from recontrol.lmi.blocks import BlockError, block, eye, grid, he, strict, trace
from recontrol.lmi.conditions import condition
from recontrol.lmi.variables import symmetric

A = rational.matrix("0 1\n-2 -3")
B = rational.matrix("0\n1")
C = rational.matrix("1 0.5")
P = rational.matrix("2 0.25\n0.25 1")


def test_one_condition_has_one_value_in_every_kind():
    import cvxpy

    exact = bounded_real(P, fmpq(3), A, B, C)
    floats = [rational.to_float(M) for M in (P, A, B, C)]
    in_floats = bounded_real(floats[0], 3.0, *floats[1:])
    variable = cvxpy.Variable((2, 2), symmetric=True)
    variable.value = floats[0]
    in_cvxpy = bounded_real(variable, 3.0, *floats[1:])
    in_balls = bounded_real(ball.to_ball(P), arb(3), A, B, C)
    affine = bounded_real(symmetric(2).affine(0), fmpq(3), A, B, C)
    assert in_floats.dtype == float
    # All entries are short binary fractions: every route is exact.
    assert (rational.to_float(exact) == in_floats).all()
    assert (in_cvxpy.value == in_floats).all()
    assert (ball.midpoint(in_balls) == in_floats).all()
    assert (affine.at([fmpq(2), fmpq(1, 4), fmpq(1)]) == exact).all()


def test_block_fills_the_lower_half_and_zeros():
    upper = block([[A, B, 0], [fmpq(5), 0], [P]])
    full = block([[A, B, 0], [None, fmpq(5), 0], [None, None, P]])
    assert (upper == full).all()
    assert upper.shape == (5, 5)
    assert (upper[2, :2] == B[:, 0]).all()
    assert all(x == 0 for x in upper[3:, :3].flat)


def test_grid_is_rectangular():
    M = grid([[A, B], [0, fmpq(7)]])
    assert M.shape == (3, 3)
    assert [str(x) for x in M[2]] == ["0", "0", "7"]


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ([[A, C], [fmpq(1)]], "one size"),
        ([[A, B], [B, fmpq(1)]], "below the diagonal"),
        ([[A, B, B], [fmpq(1)]], "expected"),
        ([[0, 0], [0]], "only zeros"),
        ([[np.zeros(2), B], [fmpq(1)]], "columns"),
    ],
)
def test_shapes_that_do_not_fit_are_named(rows, words):
    with pytest.raises(BlockError, match=words):
        block(rows)


def test_kinds_that_must_not_meet():
    import cvxpy

    with pytest.raises(BlockError, match="must not be mixed"):
        block([[A, 0], [np.eye(2)]])
    with pytest.raises(BlockError, match="cvxpy"):
        block([[A, 0], [cvxpy.Variable((2, 2), symmetric=True)]])
    with pytest.raises(BlockError, match="object array"):
        block([[np.array([[0.5]], dtype=object), 0], [fmpq(1)]])
    trap = np.block([[np.eye(1), np.eye(1)], [np.eye(1), cvxpy.Variable((1, 1))]])
    with pytest.raises(BlockError, match="object array"):
        blocks.kind_of(trap)


def test_rationals_beside_cvxpy_variables_are_refused_by_the_condition():
    import cvxpy

    variable = cvxpy.Variable((2, 2), symmetric=True)
    data = {"A": A, "B": B, "C": C}
    with pytest.raises(BlockError, match="must not be mixed"):
        condition(bounded_real).matrix({"P": variable, "gamma2": 1.0, **data})


def test_strict_takes_away_a_multiple_of_the_identity():
    import cvxpy

    M = rational.identity(2) * fmpq(3)
    assert (strict(M, fmpq(1, 2)) == rational.matrix("2.5 0\n0 2.5")).all()
    variable = cvxpy.Variable((2, 2), symmetric=True)
    variable.value = np.eye(2)
    assert (strict(variable, 0.5).value == 0.5 * np.eye(2)).all()


def test_trace_and_he():
    assert trace(P) == fmpq(3)
    assert (he(A) == rational.matrix("0 -1\n-1 -6")).all()
    assert trace(symmetric(2).affine(0)).at([fmpq(1), fmpq(9), fmpq(4)])[0, 0] == 5


def test_affine_forms_agree_with_evaluation_at_random_points():
    rng = np.random.default_rng(0)
    form = bounded_real(symmetric(2).affine(0), _scalar(3), A, B, C)
    for _ in range(5):
        x = [fmpq(int(k), 7) for k in rng.integers(-9, 9, 4)]
        assert (form.at(x) == bounded_real(symmetric(2).matrix(x[:3]), x[3], A, B, C)).all()


def _scalar(k):
    from recontrol.lmi.variables import scalar

    return scalar().affine(k)


def test_products_of_unknowns_are_not_affine():
    X = symmetric(2).affine(0)
    with pytest.raises(NotAffineError):
        X @ X
    with pytest.raises(NotAffineError):
        _scalar(3) * X


def test_constants_with_balls_do_not_widen_the_coefficients():
    wide = ball.box(A, rational.matrix("1 1\n1 1"))
    form = he(symmetric(2).affine(0) @ A) + he(wide)
    assert not any(isinstance(x, arb) for M in form.coefficients.values() for x in M.values())


def test_affine_slices_and_divisions():
    from recontrol.lmi.variables import full

    Y = full(2, 3).affine(0)
    row = Y[1:2, :]
    assert row.shape == (1, 3)
    assert sorted(row.coefficients) == [3, 4, 5]
    assert (Y / 2).coefficients[0] == {(0, 0): fmpq(1, 2)}
    assert (Y - Y).coefficients == {}
    with pytest.raises(TypeError, match="slices"):
        Y[0, 0]
    with pytest.raises(TypeError, match="ndarray"):
        Y + np.zeros((2, 3))


def test_a_condition_must_be_symmetric():
    skewed = condition(lambda P, A: P @ A, "skewed", sense="<")
    with pytest.raises(NotSymmetricError, match="skewed"):
        skewed.matrix({"P": P, "A": A})
    with pytest.raises(NotSymmetricError, match="skewed"):
        skewed.matrix({"P": symmetric(2).affine(0), "A": A})


def test_conditions_bind_by_name():
    def row(Y, axis):
        return Y[axis : axis + 1, :] @ Y[axis : axis + 1, :].T

    second = condition(row, "second", sense=">", rename={"Y": "gain"}, axis=1)
    assert second.matrix({"gain": A})[0, 0] == 13
    with pytest.raises(KeyError, match="gain"):
        second.matrix({"Y": A})
    with pytest.raises(ValueError, match="mark it"):
        condition(row)


def test_eye_fits_every_kind():
    assert (fmpq(1, 2) * eye(2) == rational.identity(2) * fmpq(1, 2)).all()
    assert (0.5 * eye(2) == 0.5 * np.eye(2)).all()
