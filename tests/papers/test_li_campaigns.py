"""Ensembles of li2013 and li2021 against single runs of their loops."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq

from papers.li2013 import campaign as sampled
from papers.li2013 import campaign_bounds as sampled_bounds
from papers.li2013.simulation.loops import loop
from papers.li2021 import campaign as fragile
from papers.li2021 import campaign_bounds as bounds
from papers.li2021 import plant as fragile_plant
from recontrol import paper
from recontrol.pipeline.campaign import generator
from tests.conftest import ROOT

LI2013, LI2021 = (paper.load(ROOT / "papers" / key) for key in ("li2013", "li2021"))


class Printed:
    """Deviates that give the printed gain, the longest interval at every instant, and the printed start."""

    def __init__(self, direction=None):
        self.direction = direction

    def uniform(self, low, high, shape):
        return np.zeros(shape)

    def integers(self, levels, size):
        return np.full(size, levels - 1)

    def standard_normal(self, shape):
        return np.broadcast_to(self.direction, shape)


def test_longest_intervals_are_the_periodic_loop():
    start = LI2013.data.float("x0")[0][:3]
    found = sampled.jitter(Printed(start), 2, LI2013.data)
    run = loop(LI2013.data, "w-print", np.zeros(3), np.zeros(3), sampled.DURATION)
    assert found["thrust"] == pytest.approx([np.abs(run.control).max()] * 2, rel=1e-9)
    assert found["distance"] == pytest.approx([np.linalg.norm(run.state[-1, :3])] * 2, rel=1e-6)


@pytest.mark.parametrize("name", ["gain-drift", "drift-inertia"])
def test_outcomes_of_li2021_are_named_and_finite(name):
    found = getattr(fragile, name.replace("-", "_"))(generator(1, 0), 40, LI2021.data)
    assert set(found) == set(LI2021.file.campaigns[name].outcomes)
    assert all(np.all(np.isfinite(values)) and values.shape == (40,) for values in found.values())


def test_outcomes_of_li2013_are_named_and_finite():
    found = sampled.jitter(generator(1, 0), 40, LI2013.data)
    assert set(found) == set(LI2013.file.campaigns["jitter"].outcomes)
    assert all(np.all(np.isfinite(values)) for values in found.values())
    assert np.all(found["rate"] < -LI2013.data.float("alpha"))


def test_no_drift_is_the_printed_loop():
    p = fragile_plant.floats(fragile_plant.plant(LI2021.data))
    loop_matrix = fragile_plant.loop(
        p, fragile_plant.float_controller(fragile_plant.controller(LI2021.data, "proposed"))
    )
    truth = np.linalg.eigvals(loop_matrix["A"]).real.max()
    found = fragile.gain_drift(Printed(), 3, LI2021.data)
    assert found["abscissa"] == pytest.approx([truth] * 3, rel=1e-8)


def test_drifted_poles_stay_in_the_proven_disk():
    found = fragile.gain_drift(generator(3, 0), 400, LI2021.data)
    assert np.all(found["radius"] < LI2021.data.float("disk_b"))


def test_no_sampled_trajectory_exceeds_what_is_proven():
    proven = sampled_bounds.jitter(LI2013.data)
    found = sampled.jitter(generator(2, 0), 300, LI2013.data)
    assert set(proven) == set(found)
    for outcome, bound in proven.items():
        assert found[outcome].max() <= bound.value, outcome
    assert found["thrust"].max() > 0.7 * proven["thrust"].value


@pytest.mark.parametrize(("name", "case", "rate"), [("gain_drift", "gains", "15"), ("drift_inertia", "all", "12")])
def test_no_drifting_loop_exceeds_what_is_proven(name, case, rate):
    proven = bounds.drifting(LI2021.data, f"{case}-proposed", fmpq(int(rate), 100))
    found = getattr(fragile, name)(generator(2, 0), 300, LI2021.data)
    assert set(proven) == set(found) - {"radius"}
    for outcome, bound in proven.items():
        assert found[outcome].max() <= bound.value, outcome
    assert bound.strength == "exact"


def test_poles_of_drifting_loops_with_other_inertia_stay_in_the_proven_disk():
    found = fragile.drift_inertia(generator(3, 0), 400, LI2021.data)
    proven = bounds.radius(LI2021.data, "all-proposed")
    assert found["radius"].max() <= proven.value == 1.05
