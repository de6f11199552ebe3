"""Ensembles of shi2016 against its printed loop, its proven decay rates and a known threshold."""

from __future__ import annotations

import numpy as np
import pytest

from papers.shi2016 import campaign, plant
from papers.shi2016.certificates.bounds import decay_ext
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


def test_no_changed_gain_decays_slower_than_is_proven():
    bound = campaign.gain_ext_bounds({"decay-ext": decay_ext(DATA)})["abscissa"]
    assert bound == -0.15
    assert np.all(campaign.gain_ext(generator(2, 0), COUNT, DATA)["abscissa"] < bound)


def test_no_rounded_inertia_decays_slower_than_is_proven():
    bound = campaign.inertia_ext_bounds(DATA)["abscissa"]
    assert bound < 0
    assert np.all(campaign.inertia_ext(generator(2, 0), COUNT, DATA)["abscissa"] < bound)


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
