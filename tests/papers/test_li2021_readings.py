"""li2021: what the readings find changes with what they read, each shown at a wrong matrix beside the right one."""

from pathlib import Path

import numpy as np
import pytest
from flint import fmpq

from papers.li2021 import conditions as c
from papers.li2021 import plant as pl
from papers.li2021.readings import algebra, appendix, attitude_model, loops, support, theorems
from recontrol.claims.identity import equal
from recontrol.claims.values import Certified
from recontrol.exact.rational import identity, matrix, zeros
from recontrol.paper import load
from recontrol.systems.generic import diag

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def data():
    return load(ROOT / "papers" / "li2021").data


def holds(identity_):
    return equal(identity_.left, identity_.right)


def changed(function, **factor):
    """The function with entries of its table multiplied."""
    return lambda data: {k: M * factor[k] if k in factor else M for k, M in function(data).items()}


@pytest.mark.parametrize("name", ["W", "L", "K"])
def test_factors_need_the_plants_own_matrices(data, monkeypatch, name):
    assert holds(attitude_model.sec2_factors(data).value)
    monkeypatch.setattr(attitude_model, "plant", changed(pl.plant, **{name: fmpq(99, 100)}))
    assert not holds(attitude_model.sec2_factors(data).value)


@pytest.mark.parametrize("name", ["Xi_J", "Xi_D", "Xi_G", "Gamma_D", "Gamma_G"])
def test_factors_need_their_own_matrices(data, monkeypatch, name):
    monkeypatch.setattr(attitude_model, "factors", changed(pl.factors, **{name: fmpq(99, 100)}))
    assert not holds(attitude_model.sec2_factors(data).value)


def test_a_wider_bound_on_the_inertia_error_holds_but_is_not_reached(data, monkeypatch):
    assert list(attitude_model.sec2_factors(data).evidence.values()) == [8]
    monkeypatch.setattr(attitude_model, "plant", changed(pl.plant, W=fmpq(101, 100)))
    found = attitude_model.sec2_factors(data)
    assert holds(found.value)
    assert list(found.evidence.values()) == [0]


def test_lacking_is_zero_for_semidefinite_matrices_only():
    singular = matrix([[1, 2], [2, 4]])
    assert support.lacking(singular) == support.lacking(zeros(3)) == 0
    assert support.lacking(singular - identity(2) * fmpq(1, 1000)) < 0
    assert support.lacking(matrix([[0, 1], [1, 5]])) == -1


def test_entry_33_of_G_is_that_of_the_model(monkeypatch):
    assert not holds(attitude_model.g0_printed())
    assert holds(attitude_model.g0_parenthesis())
    assert not holds(attitude_model._g0(lambda n, J1, J2: n**2 * (J1 - J2)))
    right = attitude_model.orbital_matrices
    monkeypatch.setattr(attitude_model, "orbital_matrices", lambda J, n: [2 * M for M in right(J, n)])
    assert not holds(attitude_model.g0_parenthesis())


def test_angular_velocity_needs_the_rates_of_3(monkeypatch):
    relative, rates, n = attitude_model._rates()
    monkeypatch.setattr(attitude_model, "_rates", lambda: (-relative, rates, n))
    assert not holds(attitude_model.eq4_w())


def agrees(statement):
    margins = statement.named().values()
    return all(m > 0 or (m == 0 and not statement.strict) for m in margins)


def test_stiffness_term_takes_lambda_and_no_other_matrix(data):
    w = np.ravel(data["modal_frequency"])
    assert not agrees(attitude_model.eq7_delta(data).value)
    assert agrees(attitude_model.eq7_lambda(data).value)
    needed = next(iter(attitude_model.eq7_lambda(data).evidence.values()))
    assert (needed == w * w).all()
    for wrong in (diag(w), -diag(w * w), identity(4), diag(w * w)[:, :3]):
        assert not agrees(attitude_model._stiffness(data, {"X": wrong}))
    assert agrees(attitude_model._stiffness(data, {"X": identity(3), "Y": identity(4), "Z": diag(w * w)}))


def test_sizes_of_A3_follow_from_the_loop(data):
    assert not agrees(algebra.eqA3_printed(data))
    assert algebra.mismatch(zeros(1, 12), zeros(12, 12), zeros(12, 3)) == 0
    assert algebra.mismatch(zeros(12, 1), zeros(12, 12), zeros(3, 3)) == 20
    assert holds(algebra.eqA3_transposed(data))


def test_only_with_both_terms_moved_is_17_affine(data, monkeypatch):
    found = algebra.thm3_lmi(data)
    assert holds(found.value)
    assert list(found.evidence.values()) == ["affine", "not affine", "not affine"]
    monkeypatch.setattr(algebra, "READINGS17", [("C", 6)])
    honest = c.eq17

    def unmoved(S, N, F_a, F_b, C_f, gamma2, *, B, **given):
        M = honest(S, N, F_a, F_b, C_f, gamma2, B=B, **given)
        M[:6, 21:27] += C_f.T @ B.T @ S
        M[21:27, :6] += S @ B @ C_f
        return M

    monkeypatch.setattr(c, "eq17", unmoved)
    assert algebra._affinity(data, ()) == "not affine"


def test_products_of_13_are_the_two_named(data, monkeypatch):
    assert not agrees(algebra.thm1_bilinear(data))
    assert holds(algebra.thm1_bilinear_both(data))
    honest = c.eq13
    monkeypatch.setattr(c, "eq13", lambda S, N, *more, **given: honest(S + N, N, *more, **given))
    assert not holds(algebra.thm1_bilinear_both(data))


def test_congruences_of_theorem_1_need_its_lyapunov_matrix(data, monkeypatch):
    assert holds(algebra.thm1_P(data))
    honest = c.lyapunov
    monkeypatch.setattr(c, "lyapunov", lambda S, N: honest(S + N, N))
    assert not holds(algebra.thm1_P(data))


def test_initial_state_bound_is_read_from_20(data, monkeypatch):
    assert not holds(appendix.eq20_needed(data))
    assert holds(appendix.eq20_inverse(data))

    def due(S, N, *, x0, theta):
        Y = S - N
        return np.block([[identity(1) * -theta, -(x0.T @ S), -(x0.T @ Y)], [-(S @ x0), -S, -S], [-(Y @ x0), -S, -Y]])

    monkeypatch.setattr(c, "eq20_printed", due)
    assert equal(appendix.eq20_needed(data).left[0], appendix.eq20_needed(data).right[0])
    assert not holds(appendix.eq20_inverse(data))


def test_a_loop_that_decreases_under_disturbance_would_be_seen(data, monkeypatch):
    P, t = identity(12), {"A": -identity(12), "B": pl.loop(pl.plant(data), pl.controller(data, "proposed"))["B"]}
    monkeypatch.setattr(appendix, "verified", lambda *names: Certified(True, "exact", ""))
    for sign, due in ((1, -1), (-1, 1)):
        monkeypatch.setattr(appendix, "_witness", lambda *_, sign=sign: (P * sign, t))
        (margin,) = appendix.invariance_disturbed(data, {}).named().values()
        assert margin * due > 0


def at(**cases):
    return {name.replace("_", "-"): {"case": case, "says": ""} for name, case in cases.items()}


@pytest.mark.parametrize(
    ("reading", "certificates"),
    [
        (algebra.thm1_equiv, at(drift_diag_below="p;delta_m=0.019", drift_one_above="p;delta_m=0.004")),
        (algebra.thm1_equiv, at(drift_diag_below="p;delta_m=0.034", drift_one_above="p;delta_m=0.021")),
        (theorems.thm2_equiv, at(drift_one_below="p;delta_m=0.0009")),
        (theorems.less_conservative, at(drift_one_below="p;delta_m=0.0009")),
        (theorems.index39, at(lemma_ref39="p;gamma=20")),
        (loops.disk_robust, at(disk_drift="p;delta_m=0.01")),
        (theorems.gains_eq17, at(eq17_empty="p;b=0.9")),
        (theorems.gains_eq13, at(gain_diag_empty="p;delta_m=0.1", gain_r1_empty="p", gain_r2_empty="p;e2=0.1")),
        (theorems.gains_start, at(start_printed_gamma10_empty="p;gamma=9", start_derived_empty="p")),
    ],
)
def test_a_certificate_of_another_case_leaves_the_claim_open(reading, certificates):
    (margin,) = reading(certificates).value.named().values()
    assert not margin > 0
    assert not margin < 0


def test_torque_is_that_of_the_start_which_the_certificates_accept(data, monkeypatch):
    monkeypatch.setattr(theorems, "verified", lambda *names: Certified(True, "exact", ""))
    found = theorems.lemma4(data, at(start_times10="p;times=2", start_times100="p;times=3")).value
    assert agrees(found)  # twice and three times the start of Table 1 stay below 2 N m


@pytest.mark.parametrize("case", ["p;gamma=11", "p;gamma=1.36;delta_m=0.01"])
def test_a_norm_bound_above_the_index_or_at_less_drift_leaves_the_claim_open(data, case):
    (margin,) = loops.hinf_robust(data, at(hinf_drift=case)).value.named().values()
    assert not margin > 0
    assert not margin < 0
