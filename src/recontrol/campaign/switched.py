"""One quadratic norm in which every step of a sampled loop contracts, whatever the sequence of the intervals.

In: the transitions of all possible intervals as balls. Out: a rate and sizes that hold for every sequence of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, arb_mat

from recontrol.campaign.forms import mirrored, spectral_norm
from recontrol.exact.ball import midpoint, precision, to_ball
from recontrol.exact.linalg import inverse, is_positive_definite
from recontrol.exact.rational import from_float, zeros

Array = Any
BITS = 128
SLACKS = (1e-6, 1e-4, 1e-3, 1e-2, 1e-1)
"""Parts of a step's size, for each second of it, that the proof may give away."""


@dataclass(frozen=True)
class Contraction:
    """``abs(T x(t))`` falls at `rate` [1/s] or faster at the instants; T (n, n) exact."""

    T: Array
    rate: arb

    def size(self, row: Array, starts: Array) -> arb:
        """c with ``abs(row x(t)) <= c e^{-rate t}`` for x(0) = starts w, abs(w) <= 1; row, starts exact or balls."""
        with precision(BITS):
            return arb((spectral_norm(row @ inverse(self.T)) * spectral_norm(self.T @ starts)).upper())


def transitions(A: Array, B: Array, K: Array, periods: list[Any]) -> list[Array]:
    """``e^{A t} + int_0^t e^{A s} ds B K`` (n, n) as balls for exact periods t, A and B; K may be balls."""
    n, m = B.shape
    wide = np.vstack([np.hstack([A, B]), zeros(m, n + m)])
    found = []
    with precision(BITS):
        for period in periods:
            exponential = np.array((arb_mat(to_ball(wide * period).tolist())).exp().tolist(), dtype=object)
            found.append(exponential[:n, :n] + exponential[:n, n:] @ K)
    return found


def contraction(steps: list[Array], periods: list[Any]) -> Contraction | None:
    """A contraction of all steps, in the modes of the step in the middle; None if some step does not contract in it."""
    middle = midpoint(steps[len(steps) // 2])
    vectors = np.linalg.inv(np.linalg.eig(middle)[1])
    factor = np.linalg.cholesky((vectors.conj().T @ vectors).real).T
    T, back = from_float(factor), np.linalg.inv(factor)
    rates = []
    with precision(BITS):
        P = T.T @ T
        for step, period in zip(steps, periods, strict=True):
            size = float(np.linalg.norm(factor @ midpoint(step) @ back, 2))
            tried = (from_float(size * (1 + slack * float(period))) for slack in SLACKS)
            held = (x for x in tried if is_positive_definite(mirrored(x * x * P - step.T @ P @ step)))
            shrink = next(held, None)
            if shrink is None:
                return None
            rates.append(arb((-arb(shrink).log() / arb(period)).lower()))
        least = min(rates)
    return Contraction(T, least) if least > 0 else None
