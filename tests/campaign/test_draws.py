"""Draws of ensembles: lengths and spread of directions, ends and zeros of rounding boxes."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from flint import fmpq

from recontrol.campaign.draws import boxed, directions

PRINT = np.array([[2.5, 0.0], [-1.0, 0.25]])
DATA = SimpleNamespace(
    float=lambda name: PRINT if name == "K" else 3.0,
    half=lambda name: np.full((2, 2), fmpq(1, 8)) if name == "K" else fmpq(1, 2),
)


@pytest.mark.parametrize("length", [1.0, 20.0])
def test_directions_have_the_length_and_no_preference(length):
    found = directions(np.random.default_rng(1), (2000, 2, 3), length)
    assert np.linalg.norm(found, axis=2) == pytest.approx(np.full((2000, 2), length), rel=1e-14)
    # The mean of 4000 directions has components of about length/sqrt(3 * 4000); four times that.
    assert np.abs(found.mean(axis=(0, 1))).max() < 4 * length / np.sqrt(12000)


def test_members_fill_the_box_of_the_print():
    found = boxed(np.random.default_rng(2), 4000, DATA, "K")
    assert found.shape == (4000, 2, 2)
    reach = np.abs(found - PRINT).max(axis=0)
    assert np.all((reach > 0.124) & (reach <= 0.125))
    assert boxed(np.random.default_rng(2), 5, DATA, "number").shape == (5, 1, 1)


def test_a_printed_zero_may_stand_for_zero():
    found = boxed(np.random.default_rng(2), 50, DATA, "K", zeros_exact=True)
    assert np.all(found[:, 0, 1] == 0)
    assert np.all(
        np.ptp(found, axis=0) == np.ptp(boxed(np.random.default_rng(2), 50, DATA, "K"), axis=0) * (PRINT != 0)
    )
