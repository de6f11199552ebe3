"""shi2016: the folder's own algebra, oracles and measures by second routes; the findings themselves are the chain's."""

import json
from pathlib import Path

import numpy as np
import pytest
from flint import arb, fmpq
from oracles import integrated_monodromy

from papers.shi2016 import algebra, conditions, plant, problems, riccati
from papers.shi2016.certificates import bounds, theorems
from papers.shi2016.readings import behaviour, equations, gains, lemmas
from papers.shi2016.readings import theorems as theorem_readings
from papers.shi2016.simulation import measures
from papers.shi2016.simulation.linear import Loop
from papers.shi2016.synthesis import amplitude
from recontrol import paper
from recontrol.claims import identity, proofs
from recontrol.claims.values import Certified
from recontrol.exact.ball import midpoint
from recontrol.exact.linalg import is_positive_definite
from recontrol.exact.rational import decimal, from_float
from recontrol.exact.rational import matrix as decimal_matrix
from recontrol.lmi import verify
from recontrol.systems.riccati import float_minimal_solution

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def data():
    return paper.load(ROOT / "papers" / "shi2016").data


def test_orbital_rate_gives_the_known_period(data):
    # 300 km above the equatorial radius: 90.52 min (two-body).
    assert 2 * np.pi / float(plant.orbital_rate(data)) / 60 == pytest.approx(90.52, abs=0.01)
    for case in plant.RADII:
        assert plant.rate_interval(data).contains(plant.orbital_rate(data, case))
        assert abs(float(plant.exact_rate(data, case) - plant.orbital_rate(data, case))) < 1e-16


def test_rounding_box_keeps_printed_zeros_exact(data):
    box = plant.gain_box(data, "ext")
    assert box[0, 1].rad() == 0
    assert box[0, 0].contains(decimal("-2.28545"))
    assert not box[0, 0].contains(decimal("-2.2856"))


def test_scaling_changes_no_norm(data):
    # h2^2 is h times and the squared effort ws times the scaled one: two unit systems of one loop.
    rate = plant.orbital_rate(data)
    si, K = plant.matrices(data, rate), data["K_trad"]
    for name in ("trad", "ext"):
        unit, factors = plant.units(data, name), plant.scale_factors(data, name)
        scaled = plant.scaled(data, rate, name)
        ratio = riccati.h2_squared(scaled, unit.gain(K)) * factors["h"] / riccati.h2_squared(si, K)
        assert abs(float(ratio) - 1) < 1e-12
        ratio = riccati.effort_squared(scaled, unit.gain(K)) * factors["ws"] / riccati.effort_squared(si, K)
        assert abs(float(ratio) - 1) < 1e-12


def test_oracle_agrees_with_the_bounded_real_block(data):
    # At the minimal solution of the Riccati form the 12 x 12 block of (8) is singular; with a larger source it is < 0.
    scaled, K = problems.source(data, "scaled:ext"), plant.scaled_gain(data, "ext")
    g = decimal("1.1")
    c, C = float(g * g - 1), midpoint(scaled["C1"] + K)
    A, B = midpoint(plant.closed_loop(scaled, K)), midpoint(scaled["B2"])
    given = {name: midpoint(scaled[name]) for name in ("A", "B1", "B2", "C1", "D1", "D2")}

    def solution(extra):
        source = 1.1 / c * B @ B.T + extra * np.eye(6)
        return float_minimal_solution((A + B @ C / c).T, source, 1.1 / c * C.T @ C)

    def top(X):
        return np.linalg.eigvalsh(conditions.brl_fixed(X, midpoint(K), gamma=1.1, **given))[-1]

    assert float(riccati.least_rho(scaled, K, "trad", g)) == pytest.approx(np.trace(solution(0.0)[:3, :3]), rel=1e-7)
    assert abs(top(solution(0.0))) < 1e-9
    assert top(solution(1e-3)) < -1e-5


def test_normalisations_of_the_bounded_real_lemma_differ_by_gamma(data):
    scaled, K = problems.source(data, "scaled:trad"), plant.scaled_gain(data, "trad")
    g = decimal("2")
    ratio = riccati.least_rho(scaled, K, "std", g) / riccati.least_rho(scaled, K, "trad", g)
    assert abs(float(ratio) - 2) < 1e-6


def test_vacuous_point_needs_no_gain(data):
    # Any X > 0, and a plant matrix without meaning: (26) holds.
    rng = np.random.default_rng(1)
    L, A, B = (from_float(rng.normal(size=s)) for s in ((6, 6), (6, 6), (6, 3)))
    X = L @ L.T
    Q, N2 = problems.vacuous(X, A, B)
    assert is_positive_definite(-conditions.thm1_iii(X, Q, N2, A, B))


def test_counter_example_certificate_stands_alone(data):
    certificate = theorems.thm2_printed_trad(data)
    assert verify.check(certificate, ROOT).holds
    rho = float(arb(verify.number(certificate["data"]["rho"])))
    # The loop's norm is 11.8: three orders of magnitude above the root of rho.
    assert np.sqrt(rho) < 11.8 / 1000


def test_certificate_with_sorted_keys_can_be_rebuilt(data):
    # The artifact store sorts keys; the unknowns X, W, Y are not in alphabetical order.
    stored = json.loads(json.dumps(bounds.single_print(data), sort_keys=True))
    assert verify.check(stored, ROOT).holds
    # 1.15 at g = 2 against 1.0845 of K_ext: squared effort is 1000 ws = 3 times the scaled bound.
    assert float(arb(verify.number(stored["bound"]["value"]))) * 3 > 1.0845**2


def test_shared_lyapunov_matrix_is_impossible_for_floats_too(data):
    # Second route to the contradiction: the two linear functionals of X12 have opposite signs on random X.
    si = problems.source(data, "SI:ext")
    Ms, V = midpoint(si["Ms"]), midpoint(theorems.symmetriser(si["Ms"]))
    U = Ms @ V
    assert np.abs(U - U.T).max() < 1e-15
    assert np.linalg.eigvalsh(U).min() > 0
    assert np.linalg.eigvalsh(V).min() > 0
    X12 = np.random.default_rng(2).normal(size=(3, 3))
    left = np.trace(U @ (X12 + X12.T))
    assert left == pytest.approx(np.trace(V @ (X12 @ Ms + Ms.T @ X12.T)), abs=1e-12)


@pytest.mark.parametrize("n", [1, 3])
def test_block_algebra_holds_for_numbers(n):
    # The normal form must be a true identity: evaluate the reciprocal projection with random rational matrices.
    rng = np.random.default_rng(n)
    Psi, L, W, S = (from_float(rng.integers(-3, 4, size=(n, n)).astype(float)) for _ in range(4))
    Psi, P = Psi + Psi.T, L @ L.T + from_float(np.eye(n))
    from recontrol.exact.linalg import inverse

    U, Pi = W + S, inverse(P)
    left = Psi + P - W - W.T + (S + W).T @ Pi @ (S + W)
    assert (left == Psi + S + S.T + (U - P).T @ Pi @ (U - P)).all()


def test_normal_form_cancels_inverses_and_transposes():
    X, Y, Q = algebra.symbols("X Y Q")
    assert algebra.normal(X * Y * Q) == Q
    assert algebra.T(X * Q) == algebra.symbol("Qt") * X
    assert algebra.normal(Q * X - X * Q) != 0


def test_misprints_are_refuted_and_their_corrections_hold():
    for wrong, right in (
        (equations.gravity_y_printed, equations.gravity_y_theta),
        (lemmas.eq16_printed, lemmas.eq16_without),
        (lemmas.eq20_printed, lemmas.eq20_transposed),
    ):
        assert not identity.equal(wrong().left, wrong().right)
        assert identity.equal(right().left, right().right)


@pytest.mark.parametrize("strengths", [("exact", "ball"), ("ball", "exact")])
def test_the_tied_pair_is_as_strong_as_its_weaker_certificate(monkeypatch, strengths):
    found = {f"tied-separate-{g}": Certified(True, s, "") for g, s in zip(("ext", "trad"), strengths, strict=True)}
    for module in (proofs, theorem_readings):
        monkeypatch.setattr(module, "certified", lambda certificate: certificate)
    assert theorem_readings.tied_separate(found).value.strength == "ball"


def dropped(condition):
    """The condition with N replaced by zero."""

    def changed(X, Q, N, A, B):
        return condition(X, Q, 0 * N, A, B)

    return changed


@pytest.mark.parametrize("name", ["thm1_iii", "thm1_iv"])
def test_chain_to_the_conditions_of_theorem_1_needs_their_slack(monkeypatch, name):
    reading = {"thm1_iii": lemmas.chain_21_26, "thm1_iv": lemmas.chain_29_30}[name]
    assert identity.equal(reading().left, reading().right)
    monkeypatch.setattr(conditions, name, dropped(getattr(conditions, name)))
    assert not identity.equal(reading().left, reading().right)


def test_dual_needs_the_transposes():
    L, C = algebra.symbols("L C")
    right = algebra.exchange(lemmas.eq25(), {"L": algebra.T(L), "B": algebra.T(C)})
    wrong = algebra.exchange(lemmas.eq25(), {"L": L, "B": algebra.T(C)})
    assert identity.equal(algebra.flat(right), algebra.flat(lemmas.eq29()))
    assert not identity.equal(algebra.flat(wrong), algebra.flat(lemmas.eq29()))


def test_a_block_of_symbols_takes_the_values_of_its_matrices():
    Q, B = algebra.symbols("Q B")
    values = {"Q": decimal_matrix("1 2\n3 4"), "B": decimal_matrix("5\n6")}
    found = algebra.evaluate([[2 * Q * algebra.T(Q), B], [algebra.T(B), -1]], values)
    assert (found == decimal_matrix("10 22 5\n22 50 6\n5 6 -1")).all()
    with pytest.raises(ValueError, match="block row 2"):
        algebra.evaluate([[Q, 0], [0, -1]], values)


def test_coupling_cancels_at_the_printed_digits(data):
    found = gains.cancelled_coupling(data, "Re-equatorial")
    assert abs(float(found.value[0, 5]) + 0.0197) < 5e-5
    low, high = (float(found.evidence[f"{end} altitude [km]"]) for end in ("lowest", "highest"))
    assert low < 300 < high


def test_settling_counts_the_last_exit():
    times = np.linspace(0, 10, 1001)
    largest = 0.1 * np.exp(-times) + np.where(np.abs(times - 7) < 0.005, 0.05, 0.0)
    found = measures.settling(times, largest, 0.1)
    # exp(-t) = 0.05 at 2.996 s, but the spike at 7 s is the last exit.
    assert found["0.05"] == pytest.approx(7.0, abs=0.01)
    assert measures.settling(times, 0.01 + 0 * times, 0.1)["0.05"] == "never"
    assert found["0.001"] == pytest.approx(7.0, abs=0.01)


def test_never_settling_is_never_within_bounds():
    runs = {"ext": {"of_x0": {"0.001": "never"}, "of_peak": {}}}
    value = behaviour.settling_ext({"linear": {"values": {"runs": runs}}}, "x0-0.1")
    assert value.value - value.error > 500


def test_free_run_solves_the_equations(data):
    loop = Loop(data, "ext")
    x = loop.free("d-1", 1.0)
    slope = (x[2:] - x[:-2]) / 0.02
    right = x @ loop.A.T + loop.d(np.arange(len(x)) * 0.01, "d-1") @ loop.plant["B2"].T
    # Central differences: h^2/6 times the third derivative, about 1e-6 here.
    assert np.abs(slope - right[1:-1]).max() < 2e-6


def test_magnus_against_integration(data):
    A, A1, wave = amplitude._loop(data, "trad", "N-printed")
    found = amplitude.monodromies(A, A1, wave["frequency"], wave["phase"], np.array([0.5, 1.0]))
    reference = integrated_monodromy(
        lambda t: A + np.sin(wave["frequency"] * t + wave["phase"]) * A1, 2 * np.pi / wave["frequency"]
    )
    # Fourth order with 128 steps: relative 1e-8.
    assert np.abs(found[1] - reference).max() < 1e-6 * np.abs(reference).max()


def test_pareto_constant_is_the_least_over_gains(data):
    # One double integrator per axis: minimise h2 * effort^3 numerically over the split of stiffness.
    from scipy.optimize import minimize

    inertia = np.array([float(j) for j in plant.inertias(data)])

    def product(log_gains):
        stiffness, damping = np.exp(log_gains[:3]), np.exp(log_gains[3:])
        # q'' J + b q' + k q = d: variance of q 1/(2 b k), of the rate 1/(2 b J).
        h2 = np.sum(1 / (2 * damping * stiffness))
        effort = np.sum(stiffness / (2 * damping) + damping / (2 * inertia))
        return np.sqrt(h2) * effort**1.5

    best = minimize(product, np.zeros(6), method="BFGS", options={"gtol": 1e-10})
    assert best.fun == pytest.approx(float(plant.pareto_constant(data)), rel=1e-7)


def test_reading_of_level_is_exact(data):
    norms = {"Re-equatorial": {gain: {"hinf": {"lower": arb(1)}} for gain in plant.GAINS}}
    found = equations.least_gamma(data, {"norms": norms})
    assert found.value == fmpq(1, 1000)
    # (8) holds strictly at no level up to 1e-3, whatever X and W: a 2 x 2 block of it is singular there.
    assert [v for name, v in found.evidence.items() if name.startswith("determinant")] == [0]
