"""hashim2015, experiments: loops, settling, costs and margins by a second route."""

import itertools
import math

import numpy as np
import pytest

from papers.hashim2015.analysis import nearest
from papers.hashim2015.quantities import experiments
from papers.hashim2015.simulation import designs
from papers.hashim2015.simulation.limits import INPUT_WEIGHTS, SHAPING
from papers.hashim2015.simulation.recovery import observer
from papers.hashim2015.simulation.regulator import HORIZON, SAMPLES, initial_states, loop_start, settle
from papers.hashim2015.simulation.steps import percent
from papers.hashim2015.simulation.sweep import lqr_loop
from recontrol import paper
from recontrol.simulate import linear, ode
from recontrol.systems.statespace import frequency_response, loop_matrix, spectral_abscissa
from tests.conftest import ROOT
from tests.papers.hashim2015_artifacts import MODEL, SYNTHESIS, simulated

W = np.array([0.07, 0.3, 0.83, 1.7, 12.0])  # rad/s, off the plants' poles 0.42 and 0.96


@pytest.fixture(scope="module")
def artifacts():
    return simulated()


def responses(axis, design):
    """P from u to y, P from u to the measured signal, and K on the frequencies W."""
    loop = designs.loop_of(MODEL, SYNTHESIS, axis, design)
    plant = designs.plant_of(MODEL, axis)
    return tuple(frequency_response(g, W)[:, 0, 0] for g in (plant, loop.plant, loop.compensator))


@pytest.mark.parametrize("axis", designs.AXES)
@pytest.mark.parametrize("design", ["full", "corrected", "x1", "x1-fed-y"])
def test_reference_entries_are_the_textbook_maps(axis, design):
    """B: P / (1 - K Pm); C: -P K / (1 - K Pm), Pm from u to the measured signal."""
    p, seen, k = responses(axis, design)
    loop = designs.loop_of(MODEL, SYNTHESIS, axis, design)
    expected = {"B": p / (1 - k * seen), "C": -p * k / (1 - k * seen)}
    for entry, value in expected.items():
        found = frequency_response(designs.from_reference(loop, entry), W)[:, 0, 0]
        np.testing.assert_allclose(found, value, rtol=1e-9)


@pytest.mark.parametrize("axis", designs.AXES)
@pytest.mark.parametrize("design", ["full", "corrected", "x1"])
def test_loops_have_the_spectra_of_the_separation_principle(axis, design):
    loop = designs.loop_of(MODEL, SYNTHESIS, axis, design)
    found = np.sort_complex(np.linalg.eigvals(loop_matrix(loop.plant, loop.compensator)))
    entry, n = SYNTHESIS["gains"][axis], MODEL[axis]["A"].shape[0]
    error = np.roots(np.real(np.poly(entry["estimator_poles"][: n if design == "full" else n - 1])))
    expected = np.sort_complex(np.concatenate([entry["controller_poles"], error]))
    np.testing.assert_allclose(np.poly(found), np.poly(expected), rtol=0, atol=1e-9)


def test_unknown_reference_entry_is_refused():
    with pytest.raises(ValueError, match="none of S, B, C, D"):
        designs.from_reference(designs.loop_of(MODEL, SYNTHESIS, "yaw", "full"), "E")


def test_full_order_S_is_state_feedback(artifacts):
    assert max(artifacts["steps"]["values"]["same_map_S"].values()) < 1e-11


@pytest.mark.parametrize(("axis", "name"), [("yaw", "full-C"), ("pitch-tf", "x1-C"), ("roll", "corrected-C")])
def test_settling_on_a_grid_hundred_times_finer(artifacts, axis, name):
    found = artifacts["steps"]["values"]["metrics"][axis][name]
    system = designs.systems(MODEL, SYNTHESIS, axis)[name]
    response = linear.step_response(system, found["horizon"], 400_001)
    error = np.abs(response.outputs - found["final"])
    for band in designs.BANDS:
        last = response.times[np.flatnonzero(error > band * abs(found["final"]))[-1]]
        step = response.times[1]
        assert last - 1e-9 <= found["settling"][percent(band)] <= last + step + 1e-9


def test_no_like_for_like_pair_shows_the_pattern_in_the_two_percent_band(artifacts):
    pairs = artifacts["steps"]["values"]["pairs"]["2"]["pairs"]
    assert len(pairs) == 45
    assert not any(pairs[f"{full} | {reduced}"]["pattern"] for full, reduced in designs.LIKE_FOR_LIKE.values())


def test_only_the_statement_on_roll_survives_every_band(artifacts):
    values = artifacts["steps"]["values"]
    assert {axis for axis, row in values["like_for_like"].items() if row["robust"]} == {"roll"}
    for band, name in (("1", "full-C | x1-C"), ("5", "full-C | corrected-C")):
        shown = [
            p for p in values["pairs"][band]["pattern_pairs"] if tuple(p.split(" | ")) in designs.LIKE_FOR_LIKE.values()
        ]
        assert shown == [name]


def test_exact_stepping_agrees_with_three_other_routes(artifacts):
    for routes in artifacts["steps"]["values"]["cross_check"].values():
        eighth, fifth, library = routes.values()
        assert eighth < 1e-9
        assert fifth < 1e-5
        assert library < 1e-12


def test_regulator_of_one_state_by_integration(artifacts):
    """Roll, corrected design, third initial state: settling within a sample, integral of y^2 by the integrator."""
    loop = designs.loop_of(MODEL, SYNTHESIS, "roll", "corrected")
    A = loop_matrix(loop.plant, loop.compensator)
    start = loop_start(loop, initial_states(4), "corrected")[:, 2]
    assert start[:4] @ start[:4] == pytest.approx(1.0)
    times = np.linspace(0, HORIZON, SAMPLES)
    y = ode.integrate(lambda _t, x: A @ x, start, times)[:, :4] @ loop.output[0]
    settled = times[np.flatnonzero(np.abs(y) > 0.02 * np.abs(y).max())[-1]]
    found = artifacts["regulator"]["series"]["roll/corrected"][2]
    assert found == pytest.approx(settled, abs=1e-9)
    ise = settle(A, np.hstack([loop.output, np.zeros((1, 3))]), start[:, None])[1]
    assert ise[0] == pytest.approx(np.trapezoid(y**2, times), rel=1e-4)


def test_regulator_starts_with_an_estimate_of_zero():
    """xh2 = xc + L m must vanish at t = 0."""
    loop = designs.loop_of(MODEL, SYNTHESIS, "yaw", "x1")
    x0 = initial_states(4)
    start = loop_start(loop, x0, "x1")
    np.testing.assert_allclose(start[4:] + loop.L @ x0[:1], 0, atol=1e-12)
    np.testing.assert_array_equal(loop_start(loop, x0, "x1-xc0")[4:], 0)


@pytest.mark.parametrize("axis", designs.AXES)
def test_riccati_and_spectral_factor_give_the_same_gains(axis):
    """K from a CARE solver and L from the Kalman filter against the Hurwitz factors of the synthesis."""
    plant, entry = designs.plant_of(MODEL, axis), SYNTHESIS["gains"][axis]
    K = np.reshape(entry["K"], (1, -1))
    loop = lqr_loop(plant, plant.C.T @ plant.C)
    np.testing.assert_allclose(plant.A - loop.A, plant.B @ K, atol=1e-9)
    L = observer(plant, K, 10.0).B
    np.testing.assert_allclose(L.ravel(), np.ravel(entry["L"]["exact"]), rtol=1e-7, atol=1e-9)


def test_sweep_never_finds_the_printed_weight_best(artifacts):
    for entry in artifacts["sweep"]["values"]["axes"].values():
        assert all(best["gain"] > 1e-3 for best in entry["best"].values())


def test_front_holds_only_undominated_weights(artifacts):
    for entry in artifacts["sweep"]["values"]["axes"].values():
        points = [(p["settling"], p["overshoot"]) for p in entry["front"]]
        assert points == sorted(points)
        assert all(a[1] > b[1] for a, b in itertools.pairwise(points))


@pytest.mark.parametrize("axis", designs.AXES)
def test_recovery_of_yaw_and_pitch_but_not_of_roll(artifacts, axis):
    entry = artifacts["recovery"]["values"]["axes"][axis]
    assert entry["state_feedback"]["peak_sensitivity"] == pytest.approx(1.0)  # Kalman's inequality
    reached = entry["weights"]["1e+06"]["peak_sensitivity"]
    assert reached > 2.5 if axis == "roll" else reached < 1.1


@pytest.mark.parametrize("axis", designs.AXES)
def test_margins_are_the_distance_to_instability(artifacts, axis):
    """Loop gains just inside the interval are stable, just outside unstable: by eigenvalues."""
    for name, row in artifacts["robustness"]["values"]["axes"][axis].items():
        loop = designs.loop_of(MODEL, SYNTHESIS, axis, name)
        assert row["peak_hamiltonian_difference"] < 1e-7
        assert abs(row["peak_enclosure"] / row["peak_sensitivity"] - 1) < 2e-5  # proof width, from 1e-6 up
        for end, side in ((row["gain_lower"], 1), (row["gain_upper"], -1)):
            if end in (0.0, "infinite"):
                continue
            for factor, stable in ((1 + side * 1e-5, True), (1 - side * 1e-5, False)):
                compensator = loop.compensator._replace(
                    C=loop.compensator.C * end * factor, D=loop.compensator.D * end * factor
                )
                assert (spectral_abscissa(loop_matrix(loop.plant, compensator)) < 0) == stable


def test_radius_never_exceeds_the_best(artifacts):
    for table in artifacts["robustness"]["values"]["axes"].values():
        for row in table.values():
            assert 0 < row["coprime_radius"] <= row["coprime_best"] * (1 + 1e-9)
            assert row["peak_sensitivity"] <= 1 / row["coprime_radius"]  # S is one of the four maps bounded by 1 / b


@pytest.mark.parametrize("axis", designs.AXES)
def test_limits(artifacts, axis):
    found = artifacts["limits"]["values"][axis]
    assert found["lqg_cost"]["full"] == pytest.approx(found["lqg_optimum"], rel=1e-8)
    assert found["lqg_cost"]["corrected"] == "infinite"
    assert found["coprime_loop_shaping"] >= found["coprime_best"] / SHAPING * (1 - 1e-9)
    ise = [found["tracking_ise"][f"{w:g}"] - found["tracking_ise_limit"] for w in INPUT_WEIGHTS]
    assert 0 < ise[2] < ise[1] < ise[0]
    assert ise[2] < 2e-3


def test_printed_gains_cost_little_more_than_the_optimum(artifacts):
    found = artifacts["limits"]["values"]["yaw"]
    assert 0 < found["lqg_cost"]["published"] / found["lqg_optimum"] - 1 < 1e-6


def test_cheap_control_limit_of_roll_is_four_re_z_over_z_squared(artifacts):
    z = complex(0.3023, math.sqrt(4 * 0.8088 - 0.3023**2)) / 2
    expected = 4 * z.real / abs(z) ** 2
    assert artifacts["limits"]["values"]["roll"]["tracking_ise_limit"] == pytest.approx(expected, rel=1e-12)


def test_printed_reduced_compensator_needs_the_first_state(artifacts):
    loops = artifacts["published"]["values"]["loops"]
    assert loops["x1"]["spectral_abscissa"] < 0 < loops["y"]["spectral_abscissa"]
    assert abs(artifacts["published"]["series"]["x1"][-1]) < 1e-3
    assert abs(artifacts["published"]["series"]["y"][-1]) > 1e3


def test_nearest_matches_by_the_least_sum():
    assert nearest(np.array([0.0, 1.0]), np.array([1.1, 0.2])) == pytest.approx([0.2, 0.1])


def test_quantities_are_those_of_the_paper_file(artifacts):
    found = experiments.quantities(artifacts)
    known = paper.load(ROOT / "papers/hashim2015").file.quantities
    assert set(found) <= set(known)
    assert all(table for table in found.values())
