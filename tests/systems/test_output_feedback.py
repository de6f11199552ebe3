"""Change of variables, coordinates and comparison of output-feedback controllers."""

import numpy as np
import pytest

from recontrol.exact.rational import matrix
from recontrol.systems import output_feedback as of
from recontrol.systems.generic import eye, inverse


def random_exact(rng, m, n):
    return matrix([[f"{int(v)}/7" for v in row] for row in rng.integers(-9, 10, (m, n))])


@pytest.fixture
def case():
    rng = np.random.default_rng(5)
    A, B, C = random_exact(rng, 3, 3), random_exact(rng, 3, 2), random_exact(rng, 2, 3)
    controller = of.Controller(random_exact(rng, 3, 3), random_exact(rng, 3, 2), random_exact(rng, 2, 3))
    root = random_exact(rng, 3, 3)
    S = root @ root.T + eye(root, 3)
    return A, B, C, controller, S, -(S + eye(root, 3))


def test_change_of_variables_linearises_the_lyapunov_products(case):
    A, B, C, c, S, N = case
    v = of.convex_variables(A, B, C, S, N, c)
    P, At = of.structured(S, N), of.closed_loop(A, B, C, c)
    # Source: the congruence with T = [[X, I], [X, 0]] maps P and P A~ to the matrices that are linear in the variables.
    one = eye(S, 3)
    T = np.vstack([np.hstack([v.X, one]), np.hstack([v.X, 0 * one])])
    images = T.T @ P @ T
    assert (images == np.vstack([np.hstack([v.X, one]), np.hstack([one, v.Y])])).all()
    linear = np.vstack([np.hstack([A @ v.X + B @ v.Ch, A]), np.hstack([v.Ah, v.Y @ A + v.Bh @ C])])
    assert (T.T @ P @ At @ T == linear).all()


def test_controller_comes_back_from_its_variables(case):
    A, B, C, c, S, N = case
    back = of.controller_of(A, B, C, of.convex_variables(A, B, C, S, N, c))
    assert all((x == y).all() for x, y in zip(back, c, strict=True))


def test_structured_coordinates_keep_the_transfer_function(case):
    c = case[3]
    rng = np.random.default_rng(6)
    root = random_exact(rng, 6, 6)
    P = root @ root.T + eye(root, 6)
    new = of.structured_coordinates(P, c)
    for k in range(3):  # Markov parameters, exact
        power = eye(c.A, 3)
        other = eye(c.A, 3)
        for _ in range(k):
            power, other = power @ c.A, other @ new.A
        assert (c.C @ power @ c.B == new.C @ other @ new.B).all()
    T = -inverse(P[3:, 3:]) @ P[3:, :3]
    W = np.vstack([np.hstack([eye(T, 3), 0 * T]), np.hstack([0 * T, T])])
    Q = W.T @ P @ W
    assert (Q[:3, 3:] == -Q[3:, 3:]).all()


def test_response_distance_ignores_coordinates_and_sees_gain():
    rng = np.random.default_rng(7)
    c = of.Controller(rng.standard_normal((3, 3)), rng.standard_normal((3, 2)), rng.standard_normal((2, 3)))
    T = rng.standard_normal((3, 3))
    other = of.Controller(np.linalg.solve(T, c.A @ T), np.linalg.solve(T, c.B), c.C @ T)
    omega = np.logspace(-2, 2, 50)
    assert of.response_distance(other, c, omega) < 1e-10  # similarity: rounding times the condition of T
    doubled = of.Controller(c.A, c.B, 2 * c.C)
    assert of.response_distance(doubled, c, omega) == pytest.approx(1.0)


def test_drift_scales_columns_and_rows():
    c = of.Controller(np.ones((2, 2)), np.ones((2, 1)), np.ones((1, 2)))
    d = of.drifted(c, np.array([[0.1, 0.2, 0.3, 0.4]]))
    assert np.allclose(d.A[0], [[1.1, 1.2], [1.1, 1.2]])
    assert np.allclose(d.B[0], 1.3)
    assert np.allclose(d.C[0], 1.4)


def test_closed_loop_refuses_a_controller_that_does_not_fit():
    c = of.Controller(np.eye(2), np.ones((2, 2)), np.ones((1, 2)))
    with pytest.raises(ValueError, match="expected 1 inputs and 1 outputs, found 2 and 1"):
        of.closed_loop(np.eye(2), np.ones((2, 1)), np.ones((1, 2)), c)
