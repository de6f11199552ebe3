"""The ensemble of wan2014 against single runs of the published loop."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from flint import arb

from papers.wan2014 import campaign, model
from papers.wan2014 import campaign_bounds as bounds
from papers.wan2014.loop import simulate
from papers.wan2014.simulation.metrics import make_batch, target_orbit
from recontrol import paper
from recontrol.pipeline.campaign import generator
from recontrol.spacecraft import orbit
from tests.conftest import ROOT

FOLDER = paper.load(ROOT / "papers/wan2014")
DATA = FOLDER.data
MODEL = model.model(**dict.fromkeys(inspect.signature(model.model).parameters, DATA))


class Nominal:
    """Deviates in the middle: printed eccentricity, opposite anomaly, no velocity error."""

    def uniform(self, low, high, shape):
        return np.zeros(shape) if isinstance(shape, tuple) else np.full(shape, (low + high) / 2)

    def standard_normal(self, shape):
        return np.ones(shape)


def test_outcomes_are_finite_and_named_in_paper_yaml():
    found = campaign.start(generator(1, 0), 20, DATA, MODEL)
    assert set(found) == set(FOLDER.file.campaigns["start"].outcomes)
    assert all(np.all(np.isfinite(values)) and values.shape == (20,) for values in found.values())


def test_undisturbed_start_is_a_single_run_of_the_loop():
    found = campaign.start(Nominal(), 2, DATA, MODEL)
    run = {"estimate": "xhat0_x0", "anomaly": np.pi, "orbit": target_orbit(DATA)}
    single = simulate(make_batch(DATA, MODEL, [run]), np.array([0.0, campaign.HORIZON]))
    # Relative tolerance 1e-8 there against 1e-11 here.
    assert found["distance"] == pytest.approx([np.linalg.norm(single["state"][:3, -1, 0])] * 2, rel=1e-5)
    assert found["cost"] == pytest.approx([single["cost"][-1, 0]] * 2, rel=1e-6)


def test_velocity_errors_stay_in_the_ball(monkeypatch):
    kept = []
    monkeypatch.setattr(
        campaign, "make_batch", lambda data, model, runs: kept.extend(runs) or make_batch(data, model, runs)
    )
    campaign.start(generator(5, 0), 30, DATA, MODEL)
    exact = campaign.estimates(DATA)["xhat0_x0"]
    sizes = [np.linalg.norm(run["estimate"] - exact) for run in kept]
    assert 2.0 < max(sizes) <= campaign.VELOCITY_BALL
    assert max(run["orbit"].eccentricity for run in kept) <= 2 * DATA.float("e")


def test_the_two_body_motion_stays_inside_what_is_proven():
    proven = bounds.start(DATA, MODEL)
    found = campaign.start(generator(7, 0), 60, DATA, MODEL)
    assert set(proven) == set(found)
    for outcome, bound in proven.items():
        assert found[outcome].max() <= bound.value, outcome
    assert found["thrust"].max() > 0.9 * proven["thrust"].value


def test_interval_matrix_holds_the_relative_acceleration():
    box = bounds.accelerations(DATA)
    low, high = (np.array([[float(end(x)) for x in row] for row in box]) for end in (arb.lower, arb.upper))
    rng = np.random.default_rng(1)
    for _ in range(500):
        target = target_orbit(DATA, rng.uniform(0, 2) * DATA.float("e"))
        radius, radial_rate, rate = target.radial_state(rng.uniform(0, 2 * np.pi))[:3]
        position, velocity = rng.standard_normal((2, 3))
        position *= rng.uniform(0, 8000) / np.linalg.norm(position)
        velocity *= rng.uniform(0, 20)
        true = orbit.relative_acceleration(position, velocity, radius, radial_rate, rate, target.gm)
        state = np.concatenate([position, velocity])
        ends = np.stack([low * state, high * state])
        slack = 1e-9  # m/s^2: the difference of two pulls of 9 m/s^2, in doubles
        assert np.all(ends.min(axis=0).sum(axis=1) - slack <= true)
        assert np.all(true <= ends.max(axis=0).sum(axis=1) + slack)
