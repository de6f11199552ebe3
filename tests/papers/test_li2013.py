"""li2013: the derivation by two routes, the exact witnesses of closed form, and what must fail."""

from pathlib import Path

import numpy as np
import pytest
from flint import fmpq
from scipy.integrate import quad

from papers.li2013 import conditions as c
from papers.li2013 import problems as pr
from papers.li2013.certificates.performance import pair_vectors
from papers.li2013.certificates.void import pattern
from papers.li2013.derivation import quadratic_form, some_point, summands, trajectory_gap
from papers.li2013.readings import blocks as blocks_readings
from papers.li2013.readings import plant as readings
from papers.li2013.readings import section4
from papers.li2013.readings.blocks import last_term_of_27
from papers.li2013.simulation.functional import along
from papers.li2013.simulation.loops import floats_sine, loop
from papers.li2013.simulation.nonlinear import rates
from papers.li2013.sweeps import floats, search
from papers.li2013.synthesis.inputs import _quadratic
from recontrol.claims import proofs
from recontrol.claims.identity import equal
from recontrol.claims.values import Certified, Size, enclosure, strength_of
from recontrol.exact import rational
from recontrol.exact.linalg import is_positive_definite
from recontrol.lmi.certificate import encode
from recontrol.paper import load
from recontrol.simulate.sampled import held_linear, held_nonlinear, periodic

ROOT = Path(__file__).parents[2]


def lower_end(margin):
    return enclosure(margin)[0]


def upper_end(margin):
    return enclosure(margin)[1]


@pytest.fixture(scope="module")
def data():
    return load(ROOT / "papers" / "li2013").data


def blocks(data, faults):
    exact, point = pr.exact_data(data, ""), some_point(9, seed=5)
    common = {"h": exact["h"], "alpha": exact["alpha"], "tau": fmpq(1, 5), "decay": fmpq(97, 100)}
    rows = c.functional(**point, A=exact["A_geo"], B=exact["B"], K=exact["K"], faults=faults, **common)
    form = quadratic_form(point, exact["A_geo"], exact["B"] @ exact["K"], **common)
    return c.block(rows), form


def test_derived_blocks_are_the_quadratic_form(data):
    left, right = blocks(data, c.DERIVED)
    assert (left == right).all()


@pytest.mark.parametrize("fault", c.FAULTS)
def test_each_fault_changes_the_form(data, fault):
    left, right = blocks(data, fault)
    assert not (left == right).all()


def test_unknown_fault_is_refused(data):
    with pytest.raises(ValueError, match="unknown fault"):
        blocks(data, "sign-P4")


def test_form_is_the_derivative_on_a_trajectory(data):
    # Richardson's rule on V with steps down to 0.0025 s leaves about 1e-11 of the terms
    assert trajectory_gap(data, c.DERIVED) < 1e-8
    assert trajectory_gap(data, c.PRINTED) > 1e-4


@pytest.mark.parametrize("gain", ["K_bar", "zero", "minus"])
def test_multiples_of_the_identity_satisfy_the_print(data, gain):
    exact, point = pr.exact_data(data, f"gain={gain}"), pattern()
    loop = {name: exact[name] for name in ("B", "K", "h", "alpha")}
    for A in ("A_print", "A_geo"):
        assert is_positive_definite(-c.phi(**point, A=exact[A], faults=c.PRINTED, **loop))
        hat = c.phi_hat(**point, A=exact[A], decay=exact["decay"], faults=c.PRINTED, **loop)
        assert is_positive_definite(-hat)
    assert not is_positive_definite(-c.phi(**point, A=exact["A_print"], faults=c.DERIVED, **loop))


def test_rate_with_the_lost_exponent_is_the_one_that_is_carried(data):
    digits, exponent = readings._factors(data)
    assert digits / 10**exponent == data["w-print"]
    assert all(lower_end(margin) > 0 for margin in readings.s4_w_exponent(data).value.margins.values())


@pytest.mark.parametrize("exponent", [1, 2, 4, 5])
def test_any_other_exponent_is_refused(data, monkeypatch, exponent):
    monkeypatch.setattr(readings, "_factors", lambda _: (fmpq(1117, 1000), exponent))
    assert any(upper_end(margin) < 0 for margin in readings.s4_w_exponent(data).value.margins.values())


def test_literal_product_lies_inside_the_earth(data):
    (margin,) = readings.s4_w_literal(data).value.margins.values()
    assert margin < 0


def test_functional_gives_the_weight_that_27_needs():
    import sympy as sp

    printed, due = last_term_of_27()
    weights = {symbol.name: symbol for symbol in printed.free_symbols | due.free_symbols}
    assert sp.simplify(printed - due) != 0
    assert sp.simplify(printed.subs(weights["P3"], weights["P2"]) - due) == 0


def test_summands_of_the_functional_against_quadrature():
    rng = np.random.default_rng(4)
    held, slope = rng.normal(size=(9, 1)), rng.normal(size=(9, 1))
    point = {name: np.diag(rng.uniform(1, 2, 9)) for name in ("P1", "P2", "P3")}
    h, tau, alpha = 0.5, 0.3, 0.7
    memory, _ = quad(lambda s: np.exp(-2 * alpha * (tau - s)), 0, tau)
    V1, V2, V3 = summands(point, held, slope, h, tau, memory)
    xi = held + tau * slope
    energy, _ = quad(lambda s: (slope.T @ point["P2"] @ slope).item() * np.exp(-2 * alpha * (tau - s)), 0, tau)
    assert pytest.approx((xi.T @ point["P1"] @ xi).item()) == V1
    assert pytest.approx((h - tau) * energy) == V2
    assert pytest.approx((h - tau) * ((held - xi).T @ point["P3"] @ (held - xi)).item()) == V3


def test_order_of_48_turns_with_the_sign_of_the_weights(data, monkeypatch):
    (margin,) = blocks_readings.eq48_order(data).margins.values()
    assert margin < 0
    minus = dict.fromkeys(("P1", "P2", "P3"), rational.identity(9) * -1)
    monkeypatch.setattr(blocks_readings, "summands", lambda _, *motion: summands(minus, *motion))
    (margin,) = blocks_readings.eq48_order(data).margins.values()
    assert margin > 0


def test_zero_terms_make_a_quadratic_form_as_a_sum_only(data):
    printed = blocks_readings.eq38_product(data)
    assert not equal(printed.left, printed.right)
    h22 = blocks_readings.h22_twice(data)
    assert not equal(h22.left, h22.right)
    assert equal(h22.right, h22.right.T)


@pytest.mark.parametrize("strength", ["exact", "ball"])
def test_thrust_bound_is_as_strong_as_its_certificate(data, monkeypatch, strength):
    monkeypatch.setattr(proofs, "certified", lambda _: Certified(True, strength, ""))
    certificates = {"decay-box": {"witness": {"point": {"P1": encode(rational.identity(9) * fmpq(1, 2))}}}}
    xi0 = pr.exact_data(data, "")["xi0"]
    model = {"exact": {"xi0": xi0}, "orbits": {"w-geo": {"equilibrium": xi0 * 0}}}
    margins = section4.umax_certificate(data, model, certificates, "w-geo").value.margins
    assert {strength_of(margin) for margin in margins.values()} == {strength}
    assert all(margin == data["rho"] - fmpq(600, 2) for margin in margins.values())


def test_sizes_follow_from_the_data(data):
    assert readings.eq36_shape(data) == Size(9, 1)
    assert readings.eq13_shape(data) == Size(3, 3)


def test_decay_bounds_enclose_the_exponential():
    low, high = pr.exponential_bounds(fmpq(1, 50))
    assert float(low.p) / float(low.q) <= np.exp(-0.02) <= float(high.p) / float(high.q)
    assert high - low <= fmpq(2, 10**9)


@pytest.mark.parametrize("h", [fmpq(1, 3), fmpq(1, 2), fmpq(7, 4), fmpq(3)])
def test_pair_eliminates_every_unknown_and_gives_four_fifths_h(data, h):
    # Both vectors applied to (55) leave |z|^2 - gamma^2 |y_r|^2 for any S, T and gain, and nonnegative P terms.
    exact = {**pr.exact_data(data, ""), "h": h}
    first, second = pair_vectors(h)
    point = some_point(9, seed=8)
    point["P1"], point["P2"], point["P3"] = (rational.zeros(9) for _ in range(3))
    common = {name: exact[name] for name in ("B", "K", "h", "zero", "B1", "C2")}
    given = {"A": exact["A_print"], "gamma2": (4 * h / 5) ** 2, "faults": c.PRINTED, "schur": False, **common}
    total = first.T @ c.performance(**point, **given) @ first + second.T @ c.performance_hat(**point, **given) @ second
    assert total[0, 0] == 0
    for name in ("P1", "P2", "P3"):
        definite = {**{key: rational.zeros(9) for key in c.UNKNOWNS}, name: rational.identity(9)}
        more = first.T @ c.performance(**definite, **given) @ first
        more = more + second.T @ c.performance_hat(**definite, **given) @ second
        assert more[0, 0] >= 0


def test_equilibrium_holds_the_reference_without_thrust(data):
    exact = pr.exact_data(data, "")
    xi = pr.equilibrium(exact, "A_print", data["y_r"].T)
    assert (xi[:3] == data["y_r"].T).all()
    assert all(x == 0 for x in (exact["K"] @ xi).flat)


def test_nonlinear_rates_linearise_to_the_model(data):
    gm, radius, mass = 3.986e14, 7e6, 200.0
    w = np.sqrt(gm / radius**3)
    rate, zero = rates(gm, radius, w, mass), np.zeros(3)
    x = np.array([3.0, -2.0, 1.0, 0.01, 0.02, -0.03])
    step = 1e-3
    slope = (rate(np.append(step * x, zero), zero, zero) - rate(np.append(-step * x, zero), zero, zero)) / (2 * step)
    expected = [3 * w**2 * x[0] + 2 * w * x[4], -2 * w * x[3], -(w**2) * x[2]]
    assert slope[3:6] == pytest.approx(expected, abs=1e-12)


def test_functional_falls_at_instants_only_when_the_interval_is_short(data):
    v = floats(data, "")
    G, P = v["B"] @ v["K"], [np.eye(9)] * 3
    for intervals, jumps in (([0.5] * 4, False), ([0.2] * 4, True)):
        run = held_linear(v["A_print"], v["B"], v["K"], v["xi0"][:, 0], intervals, 20)
        V = along(run, v["A_print"], G, P, v["h"], v["alpha"], np.zeros(9))["V"]
        fall = V[:-1, -1] - V[1:, 0]
        assert (fall > 1e-3).all() if jumps else np.abs(fall) == pytest.approx(0, abs=1e-9)


def test_quadratic_cost_is_the_integral_of_a_simulation(data):
    plant = {name: rational.to_float(M) for name, M in pr.plant(data["w-print"], data["mass"]).items()}
    x0 = floats(data, "")["xi0"][:, 0]
    H, f, constant = _quadratic(plant["A"], plant["B"], plant["C2"], x0, 0.5)
    u = np.zeros((60, 3))
    u[0] = [100.0, -50.0, 20.0]
    laws = iter(u)
    motion = held_nonlinear(
        lambda t, x, w: plant["A"] @ x + plant["B"] @ w, lambda t, x: next(laws), x0, periodic(0.5, 30.0), 40,
        rtol=1e-9, atol=1e-9,
    )  # fmt: skip
    density = np.sum(motion.state[:, 6:9] ** 2, axis=1)
    integral = np.trapezoid(density, motion.time)
    # trapezoidal rule with steps of 1/80 s
    assert u.ravel() @ H @ u.ravel() + f @ u.ravel() + constant == pytest.approx(integral, rel=1e-4)


def test_search_brackets_the_change_of_sign():
    found = search(lambda x: 2.0 - x**2, 1.0, 3.0, 1e-6)
    assert found["low"] < np.sqrt(2) < found["high"] <= found["low"] + 1e-6
    assert (found["start"], found["stop"]) == (1.0, 3.0)


def test_sine_leaves_the_bounded_residual_of_its_response(data):
    # amplitude of the steady response: continuous approximation of the sampled loop, within a quarter (hold of 0.5 s)
    run = loop(data, "w-print", np.zeros(3), floats_sine(data), 200.0)
    v = floats(data, "")
    A = v["A_print"] + v["B"] @ v["K"]
    response = np.linalg.solve(2j * np.eye(9) - A, v["B"] @ floats_sine(data))
    late = np.abs(run.state[run.time > 180, 2]).max()
    assert late == pytest.approx(abs(response[2]), rel=0.25)
