"""Balls in artifacts: what is read back is as narrow as what was stored."""

import numpy as np
from flint import arb, ctx

from recontrol.pipeline import encode


def wide(value):
    with ctx.workprec(256):
        return arb(value).sqrt()


def test_a_ball_of_256_bits_keeps_its_radius():
    stored = wide(2)
    found = encode.loads(encode.dumps({"x": stored}))["x"]
    assert found.contains(stored)
    with ctx.workprec(256):
        assert found.rad() < stored.rad() * 2  # at the default precision it would be 1e-16, not 1e-77


def test_an_array_of_balls_keeps_shape_and_radius():
    stored = np.array([[wide(2), wide(3)], [arb(0), wide(5)]], dtype=object)
    found = encode.loads(encode.dumps({"x": stored}))["x"]
    assert found.shape == (2, 2)
    for a, b in zip(found.ravel(), stored.ravel(), strict=True):
        assert a.contains(b)
        assert float(a.rad()) <= 1e-70
