"""How fast every member of a box of loops grows at least."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat, fmpq

from recontrol.campaign.modes import BITS, upper
from recontrol.exact.ball import exact_midpoint, exact_radius, precision, to_ball
from recontrol.exact.spectrum import spectral_abscissa

Array = Any
NARROW = 2.0**-20
"""Pieces of the line are not cut smaller than this part of its length."""


def least_growth(M: Array, candidates: Iterable[fmpq]) -> fmpq | None:
    """Largest of some numbers a [1/s] that the spectral abscissa of every member of the box ``M`` (n, n) exceeds.

    The middle has an eigenvalue right of the line Re s = a, and no member has one on it, so that none can have crossed.
    """
    middle, half = exact_midpoint(M), exact_radius(M)
    with precision(BITS):
        abscissa = spectral_abscissa(middle)
        radii = arb_mat(to_ball(half).tolist())
        far = upper(max(upper(sum((abs(arb(x)) for x in row), arb(0))) for row in np.abs(middle) + half))
        for a in sorted(candidates, reverse=True):
            if abscissa > arb(a) and _free(to_ball(middle), radii, a, arb(0), far, float(far) * NARROW):
                return a
    return None


def _free(middle: Array, radii: arb_mat, a: fmpq, low: arb, high: arb, narrow: float) -> bool:
    """Whether no member has an eigenvalue ``a + i w`` with w in low..high; the line is cut where that is not seen.

    s I - M is regular for all members if ``abs((s I - C)^{-1}) R q < q`` with some q > 0.
    """
    n = len(middle)
    centre, reach = (low + high) / 2, (high - low) / 2
    s = acb(arb(a), arb(centre, reach.upper()))
    shifted = acb_mat([[(s if i == j else acb(0)) - middle[i, j] for j in range(n)] for i in range(n)])
    try:
        inverse = shifted.inv()
    except ZeroDivisionError:
        inverse = None
    if inverse is not None:
        factor = arb_mat([[upper(abs(inverse[i, j])) for j in range(n)] for i in range(n)]) * radii
        if _contracts(factor):
            return True
    if float(reach) < narrow:
        return False
    middle_of = arb(centre.mid())
    return _free(middle, radii, a, low, middle_of, narrow) and _free(middle, radii, a, middle_of, high, narrow)


def _contracts(factor: arb_mat) -> bool:
    """Whether some q > 0 has ``factor q < q``; q from ``(I - factor) q = 1`` in floats."""
    n = factor.nrows()
    floats = np.array([[float(factor[i, j].mid()) for j in range(n)] for i in range(n)])
    if not np.all(np.isfinite(floats)):
        return False
    try:
        q = np.linalg.solve(np.eye(n) - floats, np.ones(n))
    except np.linalg.LinAlgError:
        return False
    if not np.all(q > 0):
        return False
    weights = arb_mat([[arb(float(x))] for x in q])
    image = factor * weights
    return all(image[i, 0] < weights[i, 0] for i in range(n))
