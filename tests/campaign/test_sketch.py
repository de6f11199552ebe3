"""Distributions in bounded memory: merged in any order, quantiles bracketed around those of the full data."""

from __future__ import annotations

import numpy as np
import pytest

from recontrol.campaign.sketch import BINS_PER_OCTAVE, Sketch


def sketch(values, first=0, worst="max"):
    made = Sketch(worst)
    made.add(values, first)
    return made


@pytest.mark.parametrize("scale", [1.0, 1e-30, 1e30])
def test_quantiles_bracket_those_of_the_data(scale):
    values = scale * np.random.default_rng(1).standard_normal(5000)
    made = sketch(values)
    for level in (0.0, 0.01, 0.5, 0.95, 1.0):
        rank = min(max(int(np.ceil(level * values.size)), 1), values.size)
        truth = np.sort(values)[rank - 1]
        low, high = made.quantile(level)
        assert low <= truth <= high
        assert high - low <= 1.02 * (2 ** (1 / BINS_PER_OCTAVE) - 1) * max(abs(low), abs(high))


@pytest.mark.parametrize("worst", ["max", "min"])
def test_merging_in_any_order_equals_the_whole(worst):
    rng = np.random.default_rng(2)
    values = rng.standard_normal(999)
    values[[400, 700]] = values.max() + 1 if worst == "max" else values.min() - 1
    parts = [sketch(values[k : k + 111], k, worst) for k in range(0, 999, 111)]
    whole = sketch(values, 0, worst).to_json()
    assert whole["worst_index"] == 400
    for order in (range(9), reversed(range(9)), rng.permutation(9)):
        total = Sketch(worst)
        for k in order:
            total = total.merge(parts[k])
        assert total.to_json() == whole
        assert Sketch.from_json(total.to_json()).to_json() == whole


def test_a_diverged_trajectory_is_the_worst():
    values = np.array([1.0, np.inf, 3.0, np.nan])
    made = sketch(values, 10).merge(sketch(np.array([100.0]), 20))
    assert (made.diverged, made.worst_index, made.maximum) == (2, 11, 100.0)
    assert made.curve()[1][-1] == pytest.approx(3 / 5)


@pytest.mark.parametrize("worst", ["max", "min"])
def test_quantiles_count_what_diverged_at_the_bad_end(worst):
    made = sketch(np.array([1.0, 2.0, np.inf, np.nan]), 0, worst)
    quarters = [made.quantile(level) for level in (0.25, 0.5, 0.75, 1.0)]
    infinite = [ends is None for ends in quarters]
    assert infinite == ([False, False, True, True] if worst == "max" else [True, True, False, False])
    middles = [sum(ends) / 2 for ends in quarters if ends]
    assert middles == pytest.approx([1.0, 2.0], rel=0.01)


def test_zero_and_sign_have_bins_of_their_own():
    made = sketch(np.array([-2.0, 0.0, 0.0, 2.0]))
    assert made.quantile(0.25)[1] < 0 < made.quantile(1.0)[0]
    low, high = made.quantile(0.5)
    assert low <= 0.0 <= high < 1e-50


def test_nothing_has_no_quantile():
    with pytest.raises(ValueError, match="no outcome"):
        Sketch().quantile(0.5)
