"""Outcomes of many linear loops against one loop at a time by other routes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.linalg import expm

from recontrol.campaign import linear


def ensemble(runs: int, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(11)
    A = rng.standard_normal((runs, n, n))
    A -= (linear.abscissa(A)[:, None, None] + 0.3) * np.eye(n)
    return A, rng.standard_normal((runs, n)), rng.standard_normal(n)


def test_trajectories_agree_with_an_integrator():
    A, x0, _ = ensemble(4, 5)
    states = linear.trajectories(A, x0, 0.05, 61)
    for run in range(4):
        found = solve_ivp(
            lambda _t, x, a=A[run]: a @ x, (0, 3), x0[run], t_eval=[1.5, 3.0], method="DOP853", rtol=1e-11, atol=1e-13
        )
        # The integrator's own tolerance is the larger error.
        assert np.allclose(states[run, [30, 60]], found.y.T, rtol=1e-8, atol=1e-9)


def test_one_matrix_serves_all_starts():
    A, x0, _ = ensemble(6, 4)
    shared = linear.trajectories(A[0], x0, 0.1, 8)
    assert np.allclose(shared[3, 7], expm(0.7 * A[0]) @ x0[3], rtol=1e-12)


def test_integral_square_is_the_integral():
    A, x0, row = ensemble(5, 4)
    found = linear.integral_square(A, x0, row)
    for run in range(5):
        truth, error = quad(lambda t, r=run: float(row @ expm(A[r] * t) @ x0[r]) ** 2, 0, 60, limit=200)
        assert found[run] == pytest.approx(truth, abs=10 * error, rel=1e-7)


def test_unstable_runs_have_no_integral():
    A, x0, row = ensemble(3, 3)
    A[1] += np.eye(3)
    assert np.isinf(linear.integral_square(A, x0, row)).tolist() == [False, True, False]


def test_settling_and_peak_of_known_curves():
    A = np.array([[[-1.0, 0.0], [0.0, -1.0]], [[0.0, 1.0], [-1.0, 0.0]]])
    x0 = np.array([[1.0, 0.0], [0.0, 2.0]])
    settling, peak = linear.settling_and_peak(A, x0, np.array([1.0, 0.0]), step=0.01, samples=1001, band=0.05)
    # exp(-t) leaves 5 % at ln 20, the oscillation never settles and reaches 2 at a quarter of a turn.
    assert settling == pytest.approx([np.log(20), np.inf], abs=0.01)
    assert peak == pytest.approx([1.0, 2.0], rel=1e-4)


def test_blocks_give_the_same_numbers(monkeypatch):
    A, x0, row = ensemble(50, 3)
    whole = linear.settling_and_peak(A, x0, row, step=0.05, samples=200, band=0.1)
    monkeypatch.setattr(linear, "BLOCK_BYTES", 8 * 200 * 3 * 7)
    parts = linear.settling_and_peak(A, x0, row, step=0.05, samples=200, band=0.1)
    assert np.allclose(whole, parts, rtol=1e-12)
