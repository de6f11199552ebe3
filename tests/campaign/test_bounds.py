"""Proven bounds against the members of the box and against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb_poly, fmpq

from recontrol.campaign import bounds
from recontrol.exact.ball import box
from recontrol.exact.rational import identity, matrix


def loop_box(half: str):
    centre = matrix("-0.5 2 0\n-2 -0.5 1\n0 0 -1.25")
    spread = centre * 0 + fmpq(*map(int, half.split("/")))
    return centre, box(centre, spread)


def members(half: float, count: int = 200) -> np.ndarray:
    centre = np.array([[-0.5, 2, 0], [-2, -0.5, 1], [0, 0, -1.25]])
    return centre + half * np.random.default_rng(5).uniform(-1, 1, (count, 3, 3))


def test_decay_bound_covers_the_box_and_is_near_it():
    bound = bounds.decay_bound(loop_box("1/100")[1])
    worst = np.linalg.eigvals(members(0.01)).real.max()
    assert worst < bound < worst + 0.05


def test_decay_bound_of_a_point_is_sharp():
    assert bounds.decay_bound(loop_box("0/1")[0]) == pytest.approx(-0.5, abs=1e-3)


def test_a_box_too_wide_for_a_proof_gives_none():
    assert bounds.decay_bound(loop_box("50/1")[1]) is None


def test_integral_bound_of_a_scalar_loop():
    # The integral of exp(-4t) is 1/4.
    found = bounds.integral_bound(matrix("-2"), matrix("1"), identity(1))
    assert 0.25 <= found < 0.2501


def test_integral_bound_covers_members():
    from scipy.linalg import solve_continuous_lyapunov

    row = np.array([[1.0, 0.0, 2.0]])
    found = bounds.integral_bound(loop_box("1/1000")[1], matrix("1 0 2"), identity(3))
    gramians = (solve_continuous_lyapunov(A.T, -row.T @ row) for A in members(0.001))
    largest = max(np.linalg.eigvalsh(W).max() for W in gramians)
    assert largest < found < 1.2 * largest


def test_root_bound_of_a_known_polynomial():
    # (s + 1)(s + 2)(s + 3)
    assert -1 < bounds.root_bound(arb_poly([6, 11, 6, 1])) < -1 + 1e-3
