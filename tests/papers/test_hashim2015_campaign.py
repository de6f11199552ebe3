"""Ensembles of hashim2015 against the single runs of its simulation, and against their proven bounds."""

from __future__ import annotations

import numpy as np
import pytest

from papers.hashim2015 import campaign, campaign_bounds
from recontrol import paper
from recontrol.campaign.draws import directions
from recontrol.pipeline.campaign import generator
from tests.conftest import ROOT
from tests.papers.hashim2015_artifacts import DATA, MODEL, SYNTHESIS, call

COUNT = 60


class Centre:
    """A generator whose uniform deviates are all zero: every member is the print itself."""

    def __init__(self):
        self.rng = np.random.default_rng(0)

    def uniform(self, low, high, shape):
        return np.zeros(shape)

    def standard_normal(self, shape):
        return self.rng.standard_normal(shape)


def outcomes_of(name):
    return call(getattr(campaign, name.replace("-", "_")), rng=generator(1, 0), count=COUNT)


UNPROVEN = {("reduced-x1", "settling"), ("plant-roll", "full-settling")}


@pytest.mark.parametrize("name", ["full-order", "reduced-x1", "reduced-y", "plant-yaw", "plant-roll"])
def test_no_member_exceeds_its_proven_bound(name):
    found = outcomes_of(name)
    described = paper.load(ROOT / "papers/hashim2015").file.campaigns[name].outcomes
    proven = call(getattr(campaign_bounds, name.replace("-", "_")))
    assert set(found) == set(described) == set(proven)
    assert {(name, outcome) for outcome, bound in proven.items() if bound.value is None} == {
        pair for pair in UNPROVEN if pair[0] == name
    }
    for outcome, bound in proven.items():
        assert not any(bound.contradicted_by(value, described[outcome].worst) for value in found[outcome]), outcome


def test_directions_that_show_least_settle_within_the_bound():
    # The starts whose output peaks lowest are the ones that the bound of the settling time is about.
    A, B, C = (DATA.float(name) for name in ("A_yaw", "B_yaw", "C_yaw"))
    K = A[:1] - DATA.float("A_c")[:1]
    loop = campaign.assembled([[(A - B @ K)[None], B @ K], [np.zeros((4, 4)), A - DATA.float("L") @ C]])
    grid = directions(np.random.default_rng(3), (4000, 4))
    x0 = np.hstack([grid, grid])
    row = np.append(C[0], np.zeros(4))
    found = campaign.outcomes(np.repeat(loop, 4000, axis=0), x0, row)
    proven = call(campaign_bounds.full_order)
    assert 0.5 * proven["settling"].value < found["settling"].max() < proven["settling"].value
    assert 0.9 * proven["ise"].value < found["ise"].max() < proven["ise"].value


def test_centre_of_the_box_is_the_printed_loop():
    from papers.hashim2015.simulation.published import published

    printed = call(published)[0]["loops"]
    for seen, measured in (("x1", np.eye(1, 4)), ("y", DATA.float("C_yaw"))):
        loop = campaign.reduced_members(Centre(), 2, DATA, measured)
        rate = np.linalg.eigvals(loop).real.max(axis=1)
        assert rate == pytest.approx([printed[seen]["spectral_abscissa"]] * 2, rel=1e-9)


def test_unrounded_plant_gives_the_regulator_experiment():
    from papers.hashim2015.simulation.regulator import one_axis

    found = campaign.rounded_plant(Centre(), 4000, MODEL, SYNTHESIS, "yaw")
    table = one_axis(MODEL, SYNTHESIS, "yaw")
    for ours, theirs in (("full", "full"), ("reduced", "corrected")):
        settling, ise = table[theirs]
        # Medians of 400 and of 4000 directions: five standard errors of the smaller sample are about a quarter.
        assert np.median(found[f"{ours}-ise"]) == pytest.approx(np.median(ise), rel=0.25)
        assert np.median(found[f"{ours}-settling"]) == pytest.approx(np.median(settling), rel=0.25)
