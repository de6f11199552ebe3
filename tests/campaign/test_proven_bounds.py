"""Ellipsoids, contractions, growth and small proofs against closed forms and members."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from scipy.linalg import expm

from recontrol.campaign import forms
from recontrol.campaign.ellipsoid import ellipsoid, energy, in_disk
from recontrol.campaign.growth import least_growth
from recontrol.campaign.proven import Bound, bounded, certified, unproven
from recontrol.campaign.switched import contraction, transitions
from recontrol.exact.ball import box
from recontrol.exact.rational import identity, matrix, zeros

OSCILLATOR = matrix("0 1\n-4 -0.8")
LOOP = {"A": OSCILLATOR, "Bp": matrix("0\n0.4"), "Cq": matrix("1 0"), "Dq": zeros(1)}
"""The stiffness is off by 10 % either way."""


def stiffnesses(count: int = 41) -> np.ndarray:
    return np.array([[[0.0, 1.0], [-4.0 + 0.4 * d, -0.8]] for d in np.linspace(-1, 1, count)])


def test_ellipsoid_covers_every_member():
    found = ellipsoid(LOOP, [matrix("0 1")], matrix("1\n0"), fmpq(1, 5))
    for A in stiffnesses():
        for time in np.linspace(0, 10, 201):
            velocity = (expm(A * time) @ [1.0, 0.0])[1]
            assert abs(velocity) <= found.size * np.exp(-found.rate * time)
    assert found.size < 4
    assert found.settled(0.01) == pytest.approx(np.log(found.size / 0.01) / 0.2)


def test_ellipsoid_refuses_a_rate_that_no_member_has():
    assert ellipsoid(LOOP, [matrix("0 1")], matrix("1\n0"), fmpq(1, 2)) is None


def test_energy_of_a_scalar_loop_and_of_members():
    one = {"A": matrix("-2"), "Bp": matrix("0.1"), "Cq": matrix("1"), "Dq": zeros(1)}
    # The slowest member decays at 1.9: the integral of e^{-3.8 t} is 1/3.8.
    assert 1 / 3.8 <= energy(one, matrix("1"), matrix("1")) < 1 / 3.8 + 1e-3


def test_disk_of_the_poles():
    inside = max(abs(np.linalg.eigvals(A) + 1).max() for A in stiffnesses())
    assert in_disk(LOOP, fmpq(1), fmpq(3))
    assert inside < 3
    assert not in_disk(LOOP, fmpq(1), fmpq(19, 10))
    assert inside > 1.9


def test_contraction_of_a_sampled_loop_holds_for_every_sequence():
    A, B, K = matrix("0 1\n0 0"), matrix("0\n1"), matrix("-1 -1.6")
    periods = [fmpq(k, 20) for k in range(1, 11)]
    steps = transitions(A, B, box(K, K * 0 + fmpq(1, 1000)), periods)
    found = contraction(steps, periods)
    rate, size = float(found.rate), float(found.size(identity(2)[:1], identity(2)).upper())
    rng = np.random.default_rng(2)
    for _ in range(50):
        x, time = rng.standard_normal(2), 0.0
        x /= np.linalg.norm(x)
        gain = np.array([-1, -1.6]) + 1e-3 * rng.uniform(-1, 1, 2)
        for _ in range(60):
            held, period = gain @ x, float(rng.integers(1, 11)) / 20
            x = np.array([x[0] + period * x[1] + period**2 / 2 * held, x[1] + period * held])
            time += period
            assert abs(x[0]) <= size * np.exp(-rate * time)
    assert rate > 0.3


def test_no_contraction_of_an_unstable_step():
    periods = [fmpq(1), fmpq(4)]
    steps = transitions(matrix("0 1\n0 0"), matrix("0\n1"), matrix("-1 -1.6"), periods)
    assert contraction(steps, periods) is None


def test_every_member_grows_as_fast_as_is_proven():
    centre = matrix("0.3 1 0\n-1 0.3 0.2\n0 0 -1")
    proven = least_growth(box(centre, centre * 0 + fmpq(1, 20)), [fmpq(k, 100) for k in range(1, 40)])
    middle = np.array([[0.3, 1, 0], [-1, 0.3, 0.2], [0, 0, -1]])
    A = middle + 0.05 * np.random.default_rng(4).uniform(-1, 1, (2000, 3, 3))
    slowest = np.linalg.eigvals(A).real.max(axis=1).min()
    assert 0.1 < float(proven.p) / float(proven.q) < slowest


def test_a_stable_box_does_not_grow():
    assert least_growth(-identity(2), [fmpq(1, 10)]) is None


@pytest.mark.parametrize("order", [1, 3, 6])
def test_eigenvalue_bounds_enclose(order):
    rng = np.random.default_rng(order)
    values = rng.integers(-9, 10, (order, order))
    form = values @ values.T
    exact = np.array([[fmpq(int(x)) for x in row] for row in form], dtype=object) + box(zeros(order), zeros(order))
    largest, least = np.linalg.eigvalsh(form)[[-1, 0]]
    assert largest <= float(forms.largest_eigenvalue(exact).upper()) * (1 + 1e-14) <= largest * (1 + 1e-9) + 1e-9
    assert float(forms.least_eigenvalue(exact)) <= max(least, 0) + 1e-9
    as_matrix = np.array([[fmpq(int(x)) for x in row] for row in values], dtype=object)
    assert float(forms.spectral_norm(as_matrix)) >= np.linalg.norm(values, 2) * (1 - 1e-14)


@pytest.mark.parametrize(
    ("value", "worst", "beyond"),
    [(1.0, "max", False), (1.0 + 1e-12, "max", False), (1.001, "max", True), (0.9, "min", True), (np.inf, "max", True)],
)
def test_what_contradicts_a_bound(value, worst, beyond):
    assert Bound(1.0, "a proof", "exact").contradicted_by(value, worst) is beyond
    assert not unproven("too hard").contradicted_by(value, worst)


def test_failed_proofs_give_reasons():
    assert bounded(None, "x", otherwise="too wide").by == "no bound is proven: too wide"
    assert bounded(np.inf, "x").value is None
    assert unproven("why").to_json() == {"bound": None, "bound_by": "no bound is proven: why", "bound_strength": None}


def test_a_refused_certificate_gives_no_bound():
    found = certified({"c": {"schema": "recontrol/certificate/1", "digest": "wrong"}}, "c", 1.0)
    assert found.value is None
    assert "certificate c was refused" in found.by
