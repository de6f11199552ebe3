"""Scaled inequalities and ellipsoidal input bounds against direct computation."""

import numpy as np
import pytest

from recontrol.exact.rational import matrix
from recontrol.systems import input_bound, robust
from recontrol.systems.output_feedback import Controller


def test_gain_drift_channels_rebuild_the_drifted_loop():
    rng = np.random.default_rng(1)
    B, C = rng.standard_normal((2, 1)), rng.standard_normal((1, 2))
    c = Controller(rng.standard_normal((2, 2)), rng.standard_normal((2, 1)), rng.standard_normal((1, 2)))
    found = robust.channels(robust.gain_drift(B, C, c, 0.1), 1)
    d = rng.uniform(-1, 1, 4)
    shift = found.Bp @ np.diag(d) @ found.Cq
    due = np.zeros((4, 4))
    due[2:, 2:] = c.A @ np.diag(0.1 * d[:2])
    due[2:, :2] = c.B * (0.1 * d[2]) @ C
    due[:2, 2:] = B @ (0.1 * d[3] * c.C)
    assert np.allclose(shift, due, atol=1e-14)


def test_norm_bounded_channel_keeps_the_product_and_drops_zeros():
    L, K = matrix([["1/1000", "0", "3"], ["2/1000", "0", "1"]]), matrix([["4", "5"], ["1", "1"], ["0", "2"]])
    B, C = robust.norm_bounded(L, K, 3)
    assert B.shape == (3, 2)
    assert (B @ C)[:2, :2].tolist() == (L[:, [0, 2]] @ K[[0, 2]]).tolist()


def test_derivative_channel_is_the_implicit_solution():
    # x' = A x + E d W x' solved for x' at one d, against A + Bp D (I - Dq D)^-1 Cq.
    rng = np.random.default_rng(2)
    A, B, E, W = (rng.standard_normal(s) for s in ((3, 3), (3, 1), (3, 1), (1, 3)))
    empty = robust.Channels(np.zeros((3, 0)), np.zeros((0, 3)), np.zeros((0, 0)), np.zeros((0, 1)))
    found = robust.with_derivative(empty, A, B, E, W)
    D = np.array([[0.3]])
    lft = A + found.Bp @ D @ np.linalg.solve(np.eye(1) - found.Dq @ D, found.Cq)
    assert np.allclose(lft, np.linalg.solve(np.eye(3) - E @ D @ W, A), atol=1e-12)


def test_scaled_disk_is_sharp_for_one_scalar():
    # Pole -1 + 0.5 d, |d| <= 1, disk about -1: the smallest radius that can be proven is 0.5.
    data = {"A": np.array([[-1.0]]), "Bp": np.ones((1, 1)), "Cq": np.array([[0.5]]), "Dq": np.zeros((1, 1)), "a": 1.0}

    def largest(b):
        grid = [
            np.linalg.eigvalsh(robust.scaled_disk(np.eye(1), np.array([[s]]), b=b, **data))[-1]
            for s in np.linspace(0.5, 6, 400)
        ]
        return min(grid)

    assert largest(0.52) < 0
    assert largest(0.48) > 0


def test_scaled_hinf_bounds_a_first_order_lag():
    # x' = -(1 + 0.5 d) x + u, y = x: worst gain 2 at d = -1.
    data = {"A": np.array([[-1.0]]), "Bp": np.ones((1, 1)), "B": np.ones((1, 1)), "C": np.ones((1, 1)),
            "Cq": np.array([[0.5]]), "Dq": np.zeros((1, 1)), "Dd": np.zeros((1, 1))}  # fmt: skip

    def provable(gamma):
        points = [(p, s) for p in np.linspace(0.5, 6, 60) for s in np.linspace(0.5, 12, 60)]
        return any(
            np.linalg.eigvalsh(robust.scaled_hinf(np.array([[p]]), np.array([[s]]), gamma**2, **data))[-1] < 0
            for p, s in points
        )

    assert provable(2.1)
    assert not provable(1.9)


def test_torque_bound_of_a_decaying_state():
    # x' = -x, u = 2 x: P = 4 is the least cover and decays, so |u| <= 2 |x0|.
    P = np.array([[4.0]])
    assert input_bound.decay(P, A=np.array([[-1.0]])).item() == pytest.approx(-8.0)
    assert input_bound.covers(P, K=np.array([[2.0]])).item() == pytest.approx(0.0)
    assert input_bound.level(P, np.array([[3.0]])).item() == pytest.approx(36.0)
