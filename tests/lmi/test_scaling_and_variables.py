"""Units there and back, and unknowns with structure."""

import numpy as np
import pytest
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi import variables
from recontrol.lmi.scaling import Units, balance, variable_weights

UNITS = Units(state=["5000", "1/2"], input="40", output=3, time="158")
A, B, C = rational.matrix("0 1\n-2 -3"), rational.matrix("0\n1"), rational.matrix("1 0.5")


@pytest.mark.parametrize(
    ("method", "M"),
    [
        ("dynamics", A),
        ("inputs", B),
        ("outputs", C),
        ("feedthrough", rational.matrix("2")),
        ("gain", C),
        ("quadratic", A),
        ("covariance", A),
    ],
)
def test_units_return_what_they_took(method, M):
    scale = getattr(UNITS, method)
    assert (scale(scale(M), back=True) == M).all()
    np.testing.assert_allclose(scale(rational.to_float(M)), rational.to_float(scale(M)), rtol=1e-15)


def test_scaled_equations_are_the_same_equations():
    """x' = A x + B u, u = K x, V = x'P x in scaled units: V' is the scaled form divided by the unit of time."""
    K, P = rational.matrix("-1 -2"), rational.matrix("2 0.25\n0.25 1")
    loop = A + B @ K
    scaled = UNITS.dynamics(A) + UNITS.inputs(B) @ UNITS.gain(K)
    assert (scaled == UNITS.dynamics(loop)).all()
    rate = P @ loop + loop.T @ P
    Ps = UNITS.quadratic(P)
    assert (Ps @ scaled + scaled.T @ Ps == UNITS.quadratic(rate) * fmpq(158)).all()
    X = rational.matrix("3 1\n1 2")
    assert rational.trace_product(UNITS.quadratic(P), UNITS.covariance(X)) == rational.trace_product(P, X)


def test_units_must_be_positive_rationals_of_the_right_number():
    with pytest.raises(ValueError, match="expected 2 units"):
        Units(state=[1, 2, 3]).dynamics(A)
    with pytest.raises(ValueError, match="positive"):
        Units(state=0).dynamics(A)
    with pytest.raises(rational.NotExactError):
        Units(state=0.5).dynamics(A)


def test_weights_of_a_variable():
    assert (variable_weights([2, 3], (2, 2), "P") == rational.matrix("4 6\n6 9")).all()
    assert (variable_weights(([2, 3], 5), (2, 1), "Y") == rational.matrix("10\n15")).all()
    assert (variable_weights("0.5", (1, 2), "Y") == rational.matrix("0.5 0.5")).all()


def test_balance_brings_rows_to_order_one():
    scales = np.array([1e-6, 1.0, 3e5])
    s = rational.to_float(np.array(balance(np.outer(scales, scales)), dtype=object))
    largest = (s[:, None] * np.outer(scales, scales) * s[None, :]).max(axis=1)
    assert ((largest > 0.2) & (largest < 5)).all()
    assert (np.log2(s) == np.round(np.log2(s))).all()
    assert balance(np.zeros((2, 2))) == [1, 1]


@pytest.mark.parametrize(
    ("variable", "size"),
    [
        (variables.symmetric(3), 6),
        (variables.full(2, 3), 6),
        (variables.scalar(), 1),
        (variables.diagonal(3), 3),
        (variables.repeated([2, 1]), 2),
        (variables.skew(3), 3),
        (variables.patterned([[1, 0], [0, 1]]), 2),
        (variables.block_diagonal([variables.symmetric(2), variables.full(1, 2)]), 5),
    ],
)
def test_unknowns_unroll_and_return(variable, size):
    assert variable.size == size
    x = [fmpq(k + 1) for k in range(size)]
    M = variable.matrix(x)
    assert variable.exact_vector(M) == x
    assert (variable.vector(rational.to_float(M)) == np.arange(1.0, size + 1)).all()
    at = variable.affine(0).at(x)
    assert (at == np.reshape(np.array(M, dtype=object), variable.matrix_shape)).all()
    dense = (variable.basis() @ np.arange(1.0, size + 1)).reshape(variable.matrix_shape)
    assert (dense == rational.to_float(at)).all()
    assert len(set(variable.names("V"))) == size


def test_structure_is_enforced():
    with pytest.raises(ValueError, match="structure"):
        variables.symmetric(2).exact_vector(rational.matrix("1 2\n3 4"))
    with pytest.raises(ValueError, match="structure"):
        variables.diagonal(2).exact_vector(rational.matrix("1 2\n2 4"))
    with pytest.raises(ValueError, match="symmetric"):
        variables.patterned([[1, 1], [0, 1]], symmetric=True)
