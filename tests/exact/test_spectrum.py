"""Enclosed eigenvalues against floats and known spectra."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq, fmpq_poly

from recontrol.exact import ball, rational, spectrum
from recontrol.exact.polynomial import charpoly


@pytest.mark.parametrize("seed", range(5))
def test_eigenvalues_of_points_and_boxes_hold_the_floats(seed):
    entries = np.random.default_rng(seed).integers(-9, 10, size=(4, 4))
    M = rational.matrix(entries.tolist())
    half = rational.matrix([["1e-6"] * 4] * 4)
    expected = sorted(np.linalg.eigvals(entries.astype(float)), key=lambda z: (round(z.real, 9), -z.imag))
    for found in (spectrum.eigenvalues(M), spectrum.eigenvalues(ball.box(M, half))):
        for z, w in zip(found, expected, strict=True):
            # numpy's eigenvalues of small integer matrices are good to 1e-9; the box allows its own radius.
            assert abs(float(z.real.mid()) - w.real) < 1e-9 + float(z.real.rad())
            assert abs(float(z.imag.mid()) - w.imag) < 1e-9 + float(z.imag.rad())


def test_a_box_encloses_the_eigenvalues_of_its_corners():
    centre, half = rational.matrix("-1 2\n0 -3"), rational.matrix("0.01 0.01\n0.01 0.01")
    found = spectrum.eigenvalues(ball.box(centre, half))
    rng = np.random.default_rng(1)
    for _ in range(20):
        corner = rational.to_float(centre) + 0.01 * rng.choice([-1, 1], size=(2, 2))
        for z, w in zip(found, np.sort(np.linalg.eigvals(corner).real), strict=True):
            assert abs(w - float(z.real.mid())) <= float(z.real.rad())


def test_stability_and_abscissa_of_a_companion_matrix():
    M = spectrum.companion([fmpq(2), fmpq(3)])  # (s + 1)(s + 2)
    assert charpoly(M) == fmpq_poly([2, 3, 1])
    assert spectrum.is_stable(M) is True
    assert abs(spectrum.spectral_abscissa(M) + 1) < 1e-60
    assert spectrum.is_stable(spectrum.companion([fmpq(-2), fmpq(3)])) is False
    wide = ball.box(rational.matrix("0 1\n-1 0"), rational.matrix("0.1 0\n0 0.1"))
    assert spectrum.is_stable(wide) is None


def test_a_lone_eigenvalue_of_a_box_is_real_and_a_pair_is_not():
    centre, half = rational.matrix("-1 3 0\n-3 -1 0\n1 0 2"), rational.matrix([["1e-6"] * 3] * 3)
    fast, slow, lone = spectrum.eigenvalues(ball.box(centre, half))
    assert lone.imag == 0
    assert fast.imag > 0 > slow.imag
