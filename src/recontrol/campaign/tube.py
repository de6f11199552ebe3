"""Bounds over time of what every member of a box of linear loops shows, from every start, proven in balls.

In: the modes of a box of loops, exact rows that are looked at, and exact starts. Out: upper bounds of the peak, of the
time after which a level is never exceeded, of the integral of the square, and of the spectral abscissa. The output at
the middle of the box is enclosed on a grid, between its instants by the second derivative; the comparison of
`recontrol.campaign.modes` covers the rest of the box.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from recontrol.campaign.forms import diagonal, largest_eigenvalue, row_norm
from recontrol.campaign.modes import BITS, Modes, growth_bound, supersolution, upper
from recontrol.campaign.proven import Bound, bounded, unproven
from recontrol.exact.ball import precision

Array = Any
NEAR = 1e-6
"""Distance [s] from an instant of the grid within which the bounds of both sides count; sums of steps are rounded."""
LONGEST = 40000
"""Steps of a grid at most."""
SMOOTH = 1e-5
"""The step is doubled where the output bends less than this part of its size between two instants."""
RESTING = 1e-3
"""Level that ends a tube where no level of settling is known."""
COMPARED = "comparison of the box with its middle, mode by mode"
TOO_WIDE = "the box is too wide for the comparison with its middle"
NO_PEAK = "it is measured against a trajectory's own peak, of which no positive lower bound is proven"


@dataclass(frozen=True)
class Tube:
    """Bounds for x(0) = sum of starts[j] w_j with abs(w_j) <= 1, over the box.

    times (m + 1,): instants [s]; reach, length (m + 1,): of the largest ``abs(row x)`` and of the length of ``rows x``
    between instants k and k + 1, and from the last one on; energy: of the integral of ``abs(rows x)^2`` over 0..inf;
    rate: of the spectral abscissa [1/s].
    """

    times: Array
    reach: Array
    length: Array
    energy: float
    rate: float

    @property
    def peak(self) -> float:
        """Of the largest ``abs(row x)`` over all times."""
        return float(self.reach.max())

    def settled(self, level: float) -> float:
        """Time [s] from which on ``abs(row x)`` stays below a level; inf if that is not proven."""
        return self._last(self.reach, level)

    def near(self, level: float) -> float:
        """Time [s] from which on the length of ``rows x`` stays below a level; inf if that is not proven."""
        return self._last(self.length, level)

    def length_at(self, time: float) -> float:
        """Of the length of ``rows x`` at one instant [s]."""
        first, last = (np.searchsorted(self.times, time + off, side="right") - 1 for off in (-NEAR, NEAR))
        return float(self.length[max(first, 0) : last + 1].max())

    def _last(self, sizes: Array, level: float) -> float:
        late = np.flatnonzero(sizes >= level)
        if not late.size:
            return 0.0
        return math.inf if late[-1] == len(sizes) - 1 else float(self.times[late[-1] + 1])


def tube(found: Modes, rows: Array, starts: list[Array], *, step: float, until: float) -> Tube | None:
    """Tube of the loops of `modes`; None if the comparison does not decay (the box is too wide, or not stable).

    rows: exact (k, n); starts: exact (n, m_j); step [s] of the grid at first, doubled where the output is smooth;
    until: level of ``abs(row x)`` that ends it.
    """
    with precision(BITS):
        rate = growth_bound(found)
        if not rate < 0:
            return None
        entered = [found.entered(block) for block in starts]
        sizes = [[row_norm(block, i) for i in range(found.order)] for block in entered]
        total = [upper(sum(column, arb(0)) + arb(2) ** -100) for column in zip(*sizes, strict=True)]
        shape = supersolution(found, total, rate / 2)
        if shape is None or not shape[1] < 0:
            return None
        walk = _Walk(found, found.seen(rows), entered, sizes, shape, step)
        return walk.go(until, rate)


def outcome_bounds(
    pieces: Sequence[Modes], rows: Array, starts: list[Array], *, step: float, level: float, peaks: str, integral: str
) -> dict[str, Bound]:
    """Bounds of `settling` [s], `peak`, `abscissa` [1/s] and ``integral`` (of ``abs(rows x)^2``) over pieces of a box.

    rows, starts, step: as for `tube`. level: a part of the least peak of any trajectory, below which each has settled,
    0 if none is proven; peaks: why every trajectory peaks so high. integral: the name of that outcome.
    """
    walked = [tube(found, rows, starts, step=step, until=level if level > 0 else RESTING) for found in pieces]
    tubes = [found for found in walked if found is not None]
    if len(tubes) < len(walked):
        return dict.fromkeys(("settling", "peak", integral, "abscissa"), unproven(TOO_WIDE))
    settling = bounded(max(found.settled(level) for found in tubes), f"{COMPARED}; {peaks}")
    return {
        "settling": settling if level > 0 else unproven(NO_PEAK),
        "peak": bounded(max(found.peak for found in tubes), COMPARED),
        integral: bounded(max(found.energy for found in tubes), COMPARED),
        "abscissa": bounded(max(found.rate for found in tubes), COMPARED),
    }


class _Walk:
    """The steps along the grid; everything in balls at the precision of the caller."""

    def __init__(
        self, found: Modes, seen: acb_mat, entered: list[acb_mat], sizes: list[list[arb]], shape: Any, step: float
    ):
        n, h = found.order, arb(step)
        self.seen, self.step, self.found = seen, step, found
        self.weights = arb_mat([[upper(abs(seen[r, i])) for i in range(n)] for r in range(seen.nrows())])
        self.p, self.fall = shape[0], -shape[1]
        self.turn = acb_mat(diagonal([(value * h).exp() for value in found.values]))
        self.fade = arb_mat(diagonal([(value.real * h).exp() for value in found.values]))
        self.grow = (found.metzler * h).exp()
        self.centre = self.first = entered
        self.bound = [arb_mat([[x] for x in size]) for size in sizes]
        self.free = [arb_mat([[x] for x in size]) for size in sizes]
        size2 = [[abs(found.metzler[i, j]) for j in range(n)] for i in range(n)]
        twice = arb_mat(size2) * arb_mat(size2)
        column = arb_mat([[x] for x in self.p])
        bend = twice * column
        square = [bend[i, 0] + 2 * abs(found.values[i]) ** 2 * self.p[i] for i in range(n)]
        self.curvature = [x[0] for x in (self.weights * arb_mat([[x] for x in square])).tolist()]
        self.shown = [x[0] for x in (self.weights * column).tolist()]

    def go(self, until: float, rate: float) -> Tube:
        """Walk until the tail is below a level."""
        times, reach, length, spread = [0.0], [], [], arb(0)
        before, off, share = self._now()
        while len(times) < LONGEST and not max(upper(x * share) for x in self.shown) < until:
            step = arb(self.step)
            sag = [upper(x * share * step**2 / 8) for x in self.curvature]
            self._advance()
            after, off_after, share = self._now()
            top = [max(upper(x), upper(y)) + s for x, y, s in zip(before, after, sag, strict=True)]
            beside = [max(upper(x), upper(y)) + s for x, y, s in zip(off, off_after, sag, strict=True)]
            reach.append(float(max(upper(x) for x in top)))
            length.append(float(_length(top)))
            spread += step * sum((x * x for x in beside), arb(0))
            times.append(times[-1] + self.step)
            before, off = after, off_after
            if max(sag) < SMOOTH * max(upper(x) for x in before):
                self._double()
        tail = [upper(x * share) for x in self.shown]
        spread += sum((x * x for x in tail), arb(0)) / (2 * self.fall)
        energy = float(upper((self._energy() + spread.sqrt()) ** 2))
        reach.append(float(max(tail)))
        length.append(float(_length(tail)))
        return Tube(np.array(times), _up(reach), _up(length), float(np.nextafter(energy, np.inf)), rate)

    def _now(self) -> tuple[list[arb], list[arb], arb]:
        """Of every row: bound of its size, of its distance from the middle; and the q of ``w <= q p``, all starts."""
        rows, n = self.seen.nrows(), self.found.order
        whole, beside, q = [arb(0)] * rows, [arb(0)] * rows, arb(0)
        for centre, bound, free in zip(self.centre, self.bound, self.free, strict=True):
            shown, apart = self.seen * centre, self.weights * (bound - free)
            for r in range(rows):
                away = upper(apart[r, 0])
                whole[r] += row_norm(shown, r) + away
                beside[r] += away
            q += max(upper(bound[i, 0] / self.p[i]) for i in range(n))
        return whole, beside, q

    def _advance(self) -> None:
        self.centre = [self.turn * x for x in self.centre]
        self.bound = [self.grow * x for x in self.bound]
        self.free = [self.fade * x for x in self.free]

    def _double(self) -> None:
        """Twice the step from now on."""
        self.step *= 2
        self.turn, self.grow, self.fade = self.turn * self.turn, self.grow * self.grow, self.fade * self.fade

    def _energy(self) -> arb:
        """Sum over the starts of the largest L2 norm of the rows at the middle of the box: a closed form."""
        total, values = arb(0), self.found.values
        for block in self.first:
            k = block.ncols()
            gramian = np.full((k, k), arb(0), dtype=object)
            for r in range(self.seen.nrows()):
                terms = [[self.seen[r, i] * block[i, c] for c in range(k)] for i in range(self.found.order)]
                for i, a in enumerate(terms):
                    for j, b in enumerate(terms):
                        factor = acb(-1) / (values[i].conjugate() + values[j])
                        for c in range(k):
                            for d in range(c + 1):
                                gramian[c, d] += (a[c].conjugate() * b[d] * factor).real
            for c in range(k):
                for d in range(c):
                    gramian[d, c] = gramian[c, d]
            total += largest_eigenvalue(gramian).sqrt()
        return total


def _length(sizes: list[arb]) -> arb:
    return upper(sum((x * x for x in sizes), arb(0))).sqrt().upper()


def _up(values: list[float]) -> Array:
    return np.nextafter(np.array(values), np.inf)
