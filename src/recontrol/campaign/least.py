"""How much every trajectory of a box of loops shows at least: settling times are measured against it."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import acb_mat, arb, arb_mat

from recontrol.campaign.forms import diagonal, least_eigenvalue, mirrored, row_norm
from recontrol.campaign.modes import BITS, Modes, upper
from recontrol.exact.ball import precision
from recontrol.exact.rational import from_float

Array = Any


def least_peak(found: Modes, row: Array, starts: Array, times: list[float]) -> float:
    """Proven lower bound of the largest ``abs(row x)`` at some instants, for the loops of `modes` and every start.

    x(0) = starts w with abs(w) = 1; row: exact (1, n), starts: exact (n, m). A mean of the squares at the instants is a
    quadratic form of w, and the largest square is no less than its least eigenvalue. Zero if nothing is proven.
    """
    with precision(BITS):
        seen, entered = found.seen(row), found.entered(starts)
        size = arb_mat([[row_norm(entered, i)] for i in range(found.order)])
        weights = arb_mat([[upper(abs(seen[0, i])) for i in range(found.order)]])
        outputs, apart = [], arb(0)
        for time in times:
            t = arb(time)
            turned = seen * acb_mat(diagonal([(value * t).exp() for value in found.values])) * entered
            outputs.append([turned[0, c].real for c in range(turned.ncols())])
            faded = arb_mat(diagonal([(value.real * t).exp() for value in found.values]))
            apart = max(apart, upper((weights * ((found.metzler * t).exp() - faded) * size)[0, 0]))
        least = _least_mean(outputs)
        return max(0.0, float(np.nextafter(float((arb(least).sqrt() - apart).lower()), -np.inf)))


def _least_mean(outputs: list[list[arb]], rounds: int = 400) -> arb:
    """Proven lower bound of the least eigenvalue of a mean of f'f over the rows f, for weights that make it large."""
    f = np.array([[float(x.mid()) for x in row] for row in outputs])
    share = np.full(len(f), 1 / len(f))
    for round_number in range(rounds):
        direction = np.linalg.eigh((f.T * share) @ f)[1][:, 0]
        gain = (f @ direction) ** 2
        share = share * np.exp(gain / max(gain.max(), 1e-300) / np.sqrt(1 + round_number))
        share /= share.sum()
    kept = [(from_float(float(x)), row) for x, row in zip(share, outputs, strict=True) if x > 1e-9]
    total = sum((x for x, _ in kept), from_float(0.0))
    m = f.shape[1]
    form = np.array([[sum((x / total * r[c] * r[d] for x, r in kept), arb(0)) for d in range(m)] for c in range(m)])
    return least_eigenvalue(mirrored(form))
