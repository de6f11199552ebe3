"""Bounds over time against closed forms and against many members of a box, simulated by other means."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from scipy.linalg import expm, solve_continuous_lyapunov

from recontrol.campaign.least import least_peak
from recontrol.campaign.linear import trajectories
from recontrol.campaign.modes import growth_bound, modes
from recontrol.campaign.tube import NO_PEAK, TOO_WIDE, outcome_bounds, tube
from recontrol.exact.ball import box
from recontrol.exact.rational import identity, matrix

CENTRE = matrix("-0.5 2 0\n-2 -0.5 1\n0 0 -1.25")
ROW = matrix("1 0 2")
STEP, SAMPLES = 0.05, 600


def boxed(half: str):
    return box(CENTRE, CENTRE * 0 + fmpq(*map(int, half.split("/"))))


def members(half: float, count: int = 300) -> np.ndarray:
    centre = np.array([[-0.5, 2, 0], [-2, -0.5, 1], [0, 0, -1.25]])
    return centre + half * np.random.default_rng(5).uniform(-1, 1, (count, 3, 3))


def outputs(A: np.ndarray, x0: np.ndarray) -> np.ndarray:
    return trajectories(A, x0, STEP, SAMPLES) @ np.array([1.0, 0.0, 2.0])


def unit(count: int, n: int = 3) -> np.ndarray:
    x0 = np.random.default_rng(6).standard_normal((count, n))
    return x0 / np.linalg.norm(x0, axis=1, keepdims=True)


def test_scalar_loop_in_closed_form():
    # e^{-2t}: peak 1, integral of the square 1/4, 0.1 reached at ln(10)/2.
    found = tube(modes(matrix("-2")), matrix("1"), [identity(1)], step=0.001, until=1e-6)
    assert found.peak == pytest.approx(1, abs=1e-5)
    assert found.peak >= 1
    assert 0.25 <= found.energy < 0.25 + 1e-4
    assert np.log(10) / 2 <= found.settled(0.1) < np.log(10) / 2 + 0.01
    assert -2 <= found.rate < -2 + 1e-8


def test_peak_between_the_instants_of_the_grid_is_covered():
    # sin(2t) e^{-t/2} peaks at atan(4)/2, which no grid of this step meets.
    found = tube(modes(matrix("-0.5 2\n-2 -0.5")), matrix("1 0"), [matrix("0\n1")], step=0.3, until=1e-3)
    time = np.arctan(4) / 2
    assert np.sin(2 * time) * np.exp(-time / 2) <= found.peak < 1


def test_members_of_the_box_stay_inside():
    found = tube(modes(boxed("1/50")), ROW, [identity(3)], step=0.01, until=1e-3)
    y = np.abs(outputs(members(0.02), unit(300)))
    assert y.max() < found.peak < 1.3 * np.sqrt(5)
    late = [STEP * np.flatnonzero(row > 0.1).max(initial=0) for row in y]
    assert max(late) < found.settled(0.1) < 2 * max(late)
    row = np.array([[1.0, 0.0, 2.0]])
    gramians = [solve_continuous_lyapunov(A.T, -row.T @ row) for A in members(0.02)]
    largest = max(np.linalg.eigvalsh(W).max() for W in gramians)
    assert largest < found.energy < 1.5 * largest


def test_members_that_vary_in_time_stay_inside():
    found = tube(modes(boxed("1/50")), ROW, [identity(3)], step=0.01, until=1e-2)
    rng = np.random.default_rng(9)
    for start in unit(20):
        x, largest = start, 0.0
        for _ in range(200):
            x = expm(members(0.02, 1)[0] * 0 + 0.1 * (members(0, 1)[0] + 0.02 * rng.choice([-1, 1], (3, 3)))) @ x
            largest = max(largest, abs(x[0] + 2 * x[2]))
        assert largest <= found.peak


def test_blocks_of_starts_add_up():
    blocks = [matrix("1\n0\n0"), matrix("0 0\n0.1 0\n0 0.1")]
    both = tube(modes(boxed("1/100")), ROW, blocks, step=0.01, until=1e-2)
    x0 = np.hstack([np.ones((300, 1)), 0.1 * unit(300, 2)])
    assert np.abs(outputs(members(0.01), x0)).max() < both.peak


def test_a_parameter_in_several_entries_costs_less_when_tied():
    E, F = matrix("0.05\n0.05\n0"), matrix("1 1 0")
    half = E @ np.abs(F)
    tied, loose = growth_bound(modes(CENTRE, (E, F))), growth_bound(modes(box(CENTRE, half)))
    factor = np.linspace(-1, 1, 41)[:, None, None]
    A = members(0, 1)[0] + factor * np.array([[0.05, 0.05, 0], [0.05, 0.05, 0], [0, 0, 0]])
    worst = np.linalg.eigvals(A).real.max()
    assert worst <= tied < loose


def test_a_box_too_wide_gives_no_tube_and_a_growth_bound_that_still_holds():
    wide = modes(boxed("3/1"))
    assert tube(wide, ROW, [identity(3)], step=0.01, until=1e-2) is None
    assert np.linalg.eigvals(members(3.0)).real.max() < growth_bound(wide)


def test_settling_is_infinite_where_the_level_lies_below_the_end_of_the_tube():
    found = tube(modes(CENTRE), ROW, [identity(3)], step=0.01, until=0.5)
    assert found.settled(1e-6) == np.inf
    assert found.settled(10.0) == 0.0


def test_length_of_several_rows():
    found = tube(modes(boxed("1/100")), identity(3), [identity(3)], step=0.01, until=1e-2)
    size = np.linalg.norm(trajectories(members(0.01), unit(300), STEP, SAMPLES), axis=2)
    for k in (0, 7, 40, 120):
        assert size[:, k].max() <= found.length_at(STEP * k)
    assert STEP * np.flatnonzero(size.max(axis=0) > 0.2)[-1] <= found.near(0.2)


def test_every_trajectory_peaks_above_the_proven_least():
    times = [STEP * k for k in range(100)]
    found = least_peak(modes(boxed("1/1000")), ROW, identity(3), times)
    seen = np.abs(outputs(members(0.001, 3000), unit(3000))).max(axis=1).min()
    assert 0.3 * seen < found <= seen


def test_an_invisible_start_has_no_least_peak():
    # The third state of this loop is never seen in the first.
    loop = matrix("-1 1 0\n-1 -1 0\n0 0 -3")
    assert least_peak(modes(loop), matrix("1 0 0"), identity(3), [0.1 * k for k in range(50)]) == 0.0


def outcomes(pieces, level):
    given = {"step": 0.01, "level": level, "peaks": "chosen", "integral": "ise"}
    return outcome_bounds([modes(boxed(half)) for half in pieces], ROW, [identity(3)], **given)


def test_the_worst_piece_decides():
    narrow, wide, both = (outcomes(pieces, 0.05) for pieces in (["1/100"], ["1/50"], ["1/50", "1/100"]))
    for name in ("settling", "peak", "ise", "abscissa"):
        assert both[name] == wide[name]
        assert wide[name].value > narrow[name].value
    assert both["settling"].by.endswith("; chosen")


def test_nothing_settles_below_an_unknown_level():
    found = outcomes(["1/100"], 0.0)
    assert found["settling"].value is None
    assert found["settling"].by.endswith(NO_PEAK)
    assert found["peak"].value > 0


def test_one_piece_too_wide_leaves_nothing_proven():
    found = outcomes(["1/100", "3/1"], 0.05)
    assert set(found) == {"settling", "peak", "ise", "abscissa"}
    assert all(bound.value is None and bound.by.endswith(TOO_WIDE) for bound in found.values())
