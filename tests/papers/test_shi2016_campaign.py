"""Ensembles of shi2016 against its printed loop, its proven decay rates and a known threshold."""

from __future__ import annotations

import numpy as np
import pytest

from papers.shi2016 import campaign, campaign_bounds, plant
from recontrol import paper
from recontrol.pipeline.campaign import generator
from tests.conftest import ROOT

FOLDER = paper.load(ROOT / "papers/shi2016")
DATA = FOLDER.data
COUNT = 200


class Centre:
    """A generator whose uniform deviates are all zero: every member is the print itself."""

    def uniform(self, low, high, shape):
        return np.zeros(shape)

    def standard_normal(self, shape):
        return np.random.default_rng(0).standard_normal(shape)


@pytest.mark.parametrize("name", ["gain-ext", "gain-trad", "inertia-ext"])
def test_outcomes_are_those_of_paper_yaml(name):
    found = getattr(campaign, name.replace("-", "_"))(generator(1, 0), COUNT, DATA)
    assert set(found) == set(FOLDER.file.campaigns[name].outcomes)
    assert all(values.shape == (COUNT,) for values in found.values())


@pytest.mark.parametrize("name", ["gain-ext", "gain-trad", "inertia-ext"])
def test_no_member_exceeds_what_is_proven(name):
    proven = getattr(campaign_bounds, name.replace("-", "_"))(DATA)
    found = getattr(campaign, name.replace("-", "_"))(generator(2, 0), COUNT, DATA)
    assert set(proven) == set(found)
    for outcome, bound in proven.items():
        assert (bound.value is None) == (name == "gain-trad" and outcome != "abscissa")
        if bound.value is not None:
            assert found[outcome].max() <= bound.value, outcome


def test_bounds_of_the_changed_gain_are_near_what_is_found():
    proven = campaign_bounds.gain_ext(DATA)
    found = campaign.gain_ext(generator(2, 0), 2000, DATA)
    for outcome, share in (("peak", 0.9), ("energy", 0.7), ("settling", 0.6)):
        assert found[outcome].max() > share * proven[outcome].value
    assert campaign_bounds.gain_trad(DATA)["abscissa"].value == pytest.approx(0.093, abs=2e-4)


@pytest.mark.parametrize(("name", "gain"), [("gain_ext", "ext"), ("gain_trad", "trad"), ("inertia_ext", "ext")])
def test_centre_is_the_printed_loop(name, gain):
    nominal = plant.float_plant(DATA)
    truth = np.linalg.eigvals(nominal["A"] + nominal["B1"] @ nominal[f"K_{gain}"]).real.max()
    found = getattr(campaign, name)(Centre(), 3, DATA)["abscissa"]
    assert found == pytest.approx([truth] * 3, rel=1e-9)


def test_starts_keep_the_printed_lengths():
    found = campaign.starts(generator(3, 0), 50, DATA).reshape(50, 2, 3)
    assert np.linalg.norm(found, axis=2) == pytest.approx(np.tile(np.sqrt(3) * np.array([0.1, 0.02]), (50, 1)))


def test_unstable_members_have_no_peak():
    found = campaign.gain_trad(generator(4, 0), COUNT, DATA)
    unstable = found["abscissa"] >= 0
    assert unstable.any()
    assert np.isinf(found["peak"]).tolist() == unstable.tolist()
