"""The picture of a campaign shows what the artifact says, diverged trajectories included."""

from __future__ import annotations

import numpy as np
import pytest

from recontrol import plotting
from recontrol.campaign.figure import draw
from recontrol.campaign.proven import Bound, unproven
from recontrol.campaign.sketch import Sketch
from recontrol.pipeline.campaign import describe


def content(values, bound=None, worst="max"):
    made = Sketch(worst)
    made.add(np.array(values, dtype=float), 0)
    row = describe(made, unproven("a test") if bound is None else Bound(bound, "a test", "ball")) | {
        "unit": "s",
        "what": "time",
    }
    return {"campaign": "one", "outcomes": {"time": row}}


def test_curves_hold_worst_and_bound():
    _, curves = draw(content([1.0, 2.0, 3.0, 4.0], bound=5.0))
    assert curves["time: worst"] == ([4.0], [1.0])
    assert curves["time: bound"][0] == [5.0, 5.0]
    assert curves["time: distribution"][1][-1] == pytest.approx(1.0)


def test_quantiles_lie_on_the_distribution():
    _, curves = draw(content([*range(1, 61), *[np.inf] * 40]))
    x, y = curves["time: distribution"]
    levels = curves["time: quantiles"][1]
    assert levels == [0.05, 0.5]
    for at, level in zip(*curves["time: quantiles"], strict=True):
        assert np.interp(at, x, y) == pytest.approx(level, abs=0.02)
    assert "time: worst" not in curves


def test_an_ensemble_that_diverged_altogether_is_drawn():
    _, curves = draw(content([np.inf, np.nan]))
    assert list(curves) == ["time: diverged"]


def test_equal_content_gives_equal_bytes(tmp_path):
    for name in ("a", "b"):
        plotting.save(draw(content([1.0, 2.0, 4.0]))[0], tmp_path / name)
    for kind in ("svg", "pdf", "png"):
        assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()


def test_a_bound_far_away_does_not_squeeze_the_distribution():
    near, far = (draw(content([1.0, 2.0], bound=bound))[0] for bound in (2.5, 2000.0))
    assert near.axes[0].get_xlim()[1] > 2.5
    assert far.axes[0].get_xlim()[1] < 3
    assert "proven bound 2e+03" in [text.get_text() for text in far.axes[0].texts]


def test_a_power_of_ten_stands_in_the_label_and_not_in_the_corner(tmp_path):
    figure, _ = draw(content([1.0e9, 2.0e9, 3.0e9]))
    figure.savefig(tmp_path / "large.png")
    ax = figure.axes[0]
    assert "10^{9}" in ax.get_xlabel()
    assert not ax.xaxis.get_offset_text().get_visible()
    figure, _ = draw(content([1.0, 2.0]))
    assert figure.axes[0].get_xlabel() == plotting.axis_label("time", "s")
