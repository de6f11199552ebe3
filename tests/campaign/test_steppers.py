"""Exponentials of a stack of matrices against SciPy's, one at a time."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from recontrol.campaign import steppers


@pytest.mark.parametrize("scale", [1e-6, 0.3, 20.0, 300.0])
def test_batched_exponential_agrees_with_scipy(scale):
    stack = np.random.default_rng(3).standard_normal((40, 6, 6)) - 3 * np.eye(6)
    stack *= scale / np.max(np.sum(np.abs(stack), axis=1))
    for found, a in zip(steppers.batched_expm(stack), stack, strict=True):
        truth = expm(a)
        # Scaling and squaring: rounding grows with the norm that is squared away.
        assert np.max(np.abs(found - truth)) <= 1e-14 * (1 + scale) * max(np.max(np.abs(truth)), 1.0)


@pytest.mark.parametrize("stack", [np.zeros((3, 3)), np.zeros((2, 3, 4)), np.full((1, 2, 2), np.nan)])
def test_unusable_stacks_are_refused(stack):
    with pytest.raises(ValueError, match="stack"):
        steppers.batched_expm(stack)
