"""wan2014 by other routes: closed forms, two bodies, random matrices, and proofs that must fail when they should."""

from __future__ import annotations

import functools
import json
from pathlib import Path

import numpy as np
import pytest
from flint import arb, fmpq
from scipy.linalg import solve_continuous_lyapunov

from papers.wan2014 import boxes, conditions, loop, model, pole_boxes, problems, repaired
from papers.wan2014.certificates import impossible
from papers.wan2014.readings import observer
from papers.wan2014.simulation import linear, metrics
from papers.wan2014.synthesis import infeasible, observers
from recontrol.exact import ball, rational
from recontrol.lmi import proof, verify
from recontrol.lmi.enclosure import bound_by_point
from recontrol.paper import load

ROOT = Path(__file__).parents[2]


@functools.cache
def data():
    return load(ROOT / "papers" / "wan2014").data


@functools.cache
def plant():
    return model.model(data())


def test_mean_motion_is_that_of_the_orbit_with_the_printed_perigee():
    n = model.mean_motions(data())
    period = 2 * np.pi / float(rational.to_float(n["n_orbit"]))
    target = metrics.target_orbit(data())
    # Nine significant digits were kept: half a unit is 5e-9 relative at most.
    assert period == pytest.approx(target.period, rel=5e-9)
    assert target.semi_major_axis * (1 - target.eccentricity) == pytest.approx(6728140.0, rel=1e-14)


def test_observability_agrees_with_the_eigenvector_test():
    """(A, C) is unobservable iff an eigenvector of A lies in the kernel of C (in floats)."""
    A = rational.to_float(plant()["A"]["n_printed"])
    words = set(plant()["observable"]["words"])
    for k in range(64):
        word = f"{k:06b}"
        C = np.diag([float(c) for c in word])
        pencils = [np.vstack([A - s * np.eye(6), 1e-3 * C]) for s in (0, 1.13e-3j)]
        # Singular values of an unobservable pencil vanish to rounding, 1e-19; others are above 1e-9.
        least = min(np.linalg.svd(M)[1][-1] for M in pencils)
        assert (word in words) == (least > 1e-12), word


def test_every_placement_reaches_the_poles_and_none_is_the_print():
    found = observers.placement(data(), plant())
    for entry in found["report"].values():
        assert entry["pole_error"] < 1e-10  # simple well-conditioned poles: rounding times 1e3
        assert entry["distance"] > 1e-2  # a hundred units of the last printed place


def test_determinant_of_the_pole_boxes_is_the_characteristic_polynomial():
    A = plant()["A"]["n_printed"]
    L = data()["L_corrected"]
    d = pole_boxes.Characteristic(A)
    s = pole_boxes.exact_poles(data())[1]
    with ball.precision(128):
        value = d.value(L, s)
    full = rational.to_float(A - L @ data()["C"])
    expected = np.linalg.det(complex(-0.6, 0.08) * np.eye(6) - full)
    assert complex(value) == pytest.approx(expected, rel=1e-6)  # det of a float matrix with entries 1e-6 to 1


def test_gradient_of_the_determinant_matches_a_difference():
    A, L = plant()["A"]["n_printed"], data()["L_corrected"]
    d, s = pole_boxes.Characteristic(A), pole_boxes.exact_poles(data())[0]
    moved = L.copy()
    moved[4, 2] += fmpq(1, 10**6)
    gradient = d.gradient(L, s)[pole_boxes.PLACES.index((4, 2))]
    slope = (complex(d.value(moved, s)) - complex(d.value(L, s))) * 1e6
    # d is affine in one entry; what remains is the rounding of a difference of 1e-6.
    assert slope == pytest.approx(complex(gradient), rel=1e-6)


def test_krawczyk_refuses_a_gain_without_the_poles():
    with ball.precision(128):
        assert not pole_boxes.krawczyk(data(), plant()["A"]["n_printed"], data()["L_printed"])[0]


def test_poles_are_excluded_only_where_the_determinant_keeps_away_from_zero(monkeypatch):
    found = observer.poles_printed(data()).value
    assert (found.inside, found.why) == (False, "d(s) does not vanish over the box")
    monkeypatch.setattr(pole_boxes, "excluded", lambda *_: {"pole 1": arb(0), "pole 2": arb(0)})
    found = observer.poles_printed(data()).value
    assert found.inside is None
    assert "may vanish" in found.why


def test_a_placement_is_claimed_only_where_it_is_proven(monkeypatch):
    assert "lies within" in observer.poles_corrected(data()).value.why
    monkeypatch.setattr(pole_boxes, "krawczyk", lambda *_: (False, [], None))
    found = observer.poles_corrected(data()).value
    assert found.inside is None
    assert "lies within" not in found.why


def test_printed_form_of_the_thrust_inequality_is_congruent_to_the_short_one():
    X, Y = data()["X"], data()["Y"]
    r = fmpq(1, 4 * 10**9)
    short = conditions.eq31(X, Y, r, axis=0, limit=fmpq(40), kappa=2)
    long = conditions.eq31_printed(X, Y, r, axis=0, limit=fmpq(40))
    from recontrol.exact.linalg import is_positive_definite

    assert is_positive_definite(short) == is_positive_definite(long)


def test_contradiction_needs_the_observer_to_be_fed_by_the_position_only():
    """The same search for F = -0.5 I gives no contradiction: the condition is not void."""
    F = infeasible.contradiction(data(), problems.observer(data(), "minus half")).solve()
    assert F.value < 0
    refuted = infeasible.contradiction(data(), problems.observer(data(), "L_printed")).solve()
    assert refuted.value > 0
    Z = refuted.point["Z"]
    A, B = rational.to_float(plant()["A"]["n_printed"]), rational.to_float(plant()["B"])
    G = A.T @ Z[:6, :6] + Z[:6, :6] @ A
    Fl = rational.to_float(problems.observer(data(), "L_printed"))
    G = G + Fl.T @ Z[6:, 6:] + Z[6:, 6:] @ Fl
    assert np.linalg.eigvalsh(G)[0] == pytest.approx(refuted.value, abs=1e-7)
    assert np.abs(B.T @ (Z[:6, :6] - Z[:6, 6:])).max() < 1e-9


def test_certificate_of_infeasibility_is_refused_after_a_change():
    synthesis = {
        "placement": observers.placement(data(), plant()),
        "multipliers": {
            "L_printed": infeasible.contradiction(data(), problems.observer(data(), "L_printed")).solve().point
        },
    }
    good = impossible.p38(data(), synthesis, "L_printed")
    assert verify.check(good, ROOT).holds
    bad = {**good, "case": "n_orbit, L_printed"}
    assert not verify.check(bad, ROOT).holds
    bad["digest"] = verify.digest(bad)
    assert not verify.check(bad, ROOT).holds  # the data are not those of that case


def test_boxes_refute_the_printed_mean_motion_and_admit_the_orbit():
    _, held = problems.rendezvous(data(), "n_printed"), problems.rendezvous(data(), "n_printed", margin=True)
    assert boxes.refutation(held, data(), with_gain=False) is None  # X, Y alone do not tell
    plain = problems.rendezvous(data(), "n_printed")
    found = boxes.refutation(held, data(), with_gain=True)
    assert verify.check(boxes.refute(plain, data(), found), ROOT).holds
    orbit = [problems.rendezvous(data(), "n_orbit, canonical", margin=m) for m in (False, True)]
    point = boxes.witness(orbit[1], orbit[0], data(), steps=6)
    assert boxes.certify(orbit[0], data(), point) is not None
    spoiled = {**point, "K": np.asarray(point["K"]) + 2e-4}
    assert boxes.certify(orbit[0], data(), spoiled) is None


def test_printed_decimals_themselves_are_no_solution():
    X, Y, K = (data()[name] for name in "XYK")
    assert not boxes.inside(K @ X, Y, data().half("Y"))


def test_cost_bound_is_above_the_lyapunov_cost_of_the_nominal_loop():
    values = repaired.source(data(), "L_corrected, e0_velocity")
    Acl, Q = (rational.to_float(values[k]) for k in ("Acl", "Qbar"))
    xi0 = rational.to_float(values["xi0"])[:, 0]
    nominal = xi0 @ solve_continuous_lyapunov(Acl.T, -Q) @ xi0
    found = repaired.cost_problem(data(), "L_corrected, e0_velocity", shape="block", spread=True).solve()
    bound = found.value * float(rational.to_float(problems.Scale.cost))
    assert nominal < bound < 1.1 * nominal


def test_same_lyapunov_matrix_for_both_is_refused():
    problem = repaired.cost_problem(data(), "L_corrected, e0_zero", shape="same", spread=True)
    assert problem.solve().outcome == "infeasible"


def test_error_that_never_decays_has_no_last_time():
    times = np.arange(3.0)
    assert metrics.last_above(times, np.array([0.0, 0.5, 0.9]), 1.0) == 0.0
    assert metrics.last_above(times, np.array([0.0, 2.0, 2.0]), 1.0) is None
    assert metrics.last_above(times, np.array([2.0, 2.0, 0.0]), 1.0) == 1.5


def test_two_routes_of_the_simulation_agree_over_ten_minutes():
    runs = [{"estimate": "xhat0_r0"}, {"estimate": "xhat0_zero", "clip": True}]
    batch = metrics.make_batch(data(), plant(), runs)
    times = np.array([0.0, 300.0, 600.0])
    rotating = loop.simulate(batch, times)["state"]
    inertial = loop.simulate_inertial(batch, times)
    # Positions of 7e6 m carry 1e-9 m of rounding; at kinks of a clipped thrust the inertial route is good to 1e-5 m.
    gap = np.abs(rotating - inertial)[:3].max(axis=(0, 1))
    assert gap[0] < 1e-7
    assert gap[1] < 1e-5


def test_observer_is_fed_the_clipped_thrust():
    batch = metrics.make_batch(data(), plant(), [{"estimate": "xhat0_zero", "clip": True}])
    command, applied = batch.thrust(np.full((6, 1), 1e5))
    assert np.abs(applied).max() <= 40
    assert np.abs(command).max() > 40


def test_linear_model_without_eccentricity_has_the_lyapunov_cost():
    """Worst and best phase frame the nominal cost, which the Lyapunov equation gives."""
    values = repaired.source(data(), "L_corrected, e0_zero")
    Acl, Q = (rational.to_float(values[k]) for k in ("Acl", "Qbar"))
    xi0 = rational.to_float(values["xi0"])[:, 0]
    nominal = xi0 @ solve_continuous_lyapunov(Acl.T, -Q) @ xi0
    found, _ = linear.linear_cost(data(), plant())
    assert found["e0_zero"]["best"] < nominal < found["e0_zero"]["worst"]


def test_units_are_those_of_the_data():
    x0 = data().float("x0")[:, 0]
    assert float(rational.to_float(problems.Scale.length)) == pytest.approx(np.linalg.norm(x0[:3]), rel=1e-4)
    assert float(rational.to_float(problems.Scale.rate)) == pytest.approx(np.sqrt(40 / (200 * 5000)), rel=1e-3)


def test_margin_that_is_positive_gives_no_refutation():
    held = problems.rendezvous(data(), "n_orbit", margin=True)
    assert boxes.refutation(held, data(), with_gain=True) is None
    with pytest.raises(proof.NotProvenError):
        proof.prove_infeasible(problems.rendezvous(data(), "n_printed"), multipliers={})


def test_certificate_of_a_bound_survives_a_file_with_sorted_names():
    """The unknowns are numbered in the order of the problem, which a file written with sorted keys does not show."""
    problem = repaired.thrust_problem(data(), "L_corrected, e0_velocity", "x")
    _, certificate = bound_by_point(problem, problem.solve(margin="1e-7").point)
    stored = json.loads(json.dumps(certificate, sort_keys=True))
    found = verify.check(stored, ROOT)
    assert found.holds, found.why
    assert "rebuilt" in found.why
