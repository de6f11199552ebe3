"""Ellipsoids that no member of an uncertain loop leaves: peaks and decay from one start, proven in exact arithmetic.

In: a loop with diagonal uncertainty ``abs(delta) <= 1`` in the form of `recontrol.systems.robust`. Out: numbers proven
from one P and one diagonal multiplier, found by a solver and then checked exactly. What they prove also holds for
uncertainty that varies in time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from flint import arb, fmpq

from recontrol.exact.ball import precision
from recontrol.exact.rational import identity
from recontrol.lmi.blocks import block, eye, grid, he, negative, nonnegative
from recontrol.lmi.conditions import Condition, condition, minimise
from recontrol.lmi.enclosure import bound_by_point
from recontrol.lmi.loops import definite
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError
from recontrol.lmi.variables import diagonal, scalar, symmetric
from recontrol.systems.input_bound import covers, level
from recontrol.systems.robust import scaled_disk

Array = Any
SOLVERS = ("CLARABEL", "CVXOPT")
"""The second is asked where the first ends in an error."""
INSIDE = 1 + 1e-6
"""Covers touch at the optimum: P is enlarged by this factor before the proof, and the size once more."""


@negative
def scaled_decay(P: Any, Lam: Any, *, A: Any, Bp: Any, Cq: Any, Dq: Any, rate: Any) -> Any:
    """x'P x falls at twice `rate` for every Delta of the channels, at any speed; Lam (k, k) diagonal."""
    G = grid([[Cq, Dq]])
    return block([[he(P @ A) + 2 * rate * P, P @ Bp], [-Lam]]) + G.T @ Lam @ G


@dataclass(frozen=True)
class Ellipsoid:
    """For every member ``abs(row x(t)) <= size e^{-rate t}`` with each of the rows that it covers; rate [1/s]."""

    size: float
    rate: float

    def settled(self, band: float) -> float:
        """Time [s] from which on every covered row stays within ``band``; inf without a rate."""
        if self.size <= band:
            return 0.0
        with precision(80):
            return _up((arb(self.size) / arb(band)).log() / arb(self.rate)) if self.rate > 0 else math.inf


@negative
def scaled_energy(P: Any, Lam: Any, *, A: Any, Bp: Any, Cq: Any, Dq: Any, Y: Any) -> Any:
    """x'P x falls at least as fast as the integral of abs(Y x)^2 grows, for every Delta, at any speed."""
    G = grid([[Cq, Dq]])
    return block([[he(P @ A) + Y.T @ Y, P @ Bp], [-Lam]]) + G.T @ Lam @ G


@nonnegative
def holds_starts(P: Any, size2: Any, *, S: Any) -> Any:
    """w'S'P S w <= size2 for abs(w) <= 1: every start S w lies in the ellipsoid."""
    return size2 * eye(S.shape[1]) - S.T @ P @ S


def squared_size(size2: Any) -> Any:
    """Objective."""
    return size2


def ellipsoid(loop: Any, rows: Sequence[Array], starts: Array, rate: fmpq) -> Ellipsoid | None:
    """The least ellipsoid that holds every start and covers ``abs(row x)^2 <= x'P x``; None if none is proven.

    loop: mapping with exact A (n, n), Bp (n, k), Cq (k, n), Dq (k, k); rows: exact (m, n) each; starts: exact (n, j),
    x(0) = starts w with abs(w) <= 1.
    """
    named = {f"Y{number}": row for number, row in enumerate(rows)}
    more = [condition(covers, f"covers {name}", rename={"K": name}) for name in named]
    value = _least(loop, [condition(scaled_decay), *more], starts, {"rate": rate, **named})
    if value is None:
        return None
    with precision(80):
        return Ellipsoid(_up(arb(value).sqrt()), float(rate))


def energy(loop: Any, row: Array, starts: Array) -> float | None:
    """Proven upper bound of the integral of ``abs(row x)^2`` over 0..inf for every member and start."""
    value = _least(loop, [condition(scaled_energy), condition(definite)], starts, {"Y": row})
    return None if value is None else _up(arb(value))


def _least(loop: Any, conditions: Sequence[Condition], starts: Array, data: Any) -> fmpq | None:
    """Least proven ``size2`` of an ellipsoid under some conditions."""
    n, k = loop["Bp"].shape
    problem = Problem(
        "ellipsoid",
        {"P": symmetric(n), "Lam": diagonal(k), "size2": scalar()},
        [*conditions, condition(definite, "Lam > 0", rename={"P": "Lam"}), condition(holds_starts)],
        {**{name: loop[name] for name in ("A", "Bp", "Cq", "Dq")}, "S": starts, **data},
        objective=minimise(squared_size),
        units={"P": "10", "Lam": "10"},
    )
    return _proven(problem)


def in_disk(loop: Any, a: fmpq, b: fmpq) -> bool:
    """Whether all poles of every frozen member are proven to lie in the disk of radius ``b`` about ``-a`` [1/s].

    loop: as for `ellipsoid`.
    """
    n, k = loop["Bp"].shape
    first = identity(n)[:, :1]  # only normalises P
    problem = Problem(
        "disk",
        {"P": symmetric(n), "Lam": diagonal(k)},
        [condition(scaled_disk), condition(definite, "Lam > 0", rename={"P": "Lam"}), condition(covers)],
        {**{name: loop[name] for name in ("A", "Bp", "Cq", "Dq")}, "a": a, "b": b, "x0": first, "K": first.T},
        objective=minimise(level),
        units={"P": "10", "Lam": "10"},
    )
    return _proven(problem) is not None


def _proven(problem: Problem) -> fmpq | None:
    """Proven value of a problem at a point a little inside of what the first solver that can finds."""
    for solver in SOLVERS:
        solution = problem.solve(solver, margin="1e-7")
        point = {name: INSIDE * found for name, found in solution.point.items()}
        if "size2" in point:
            point["size2"] = INSIDE * point["size2"]
        if point:  # whatever the solver says of it: conditions touch at the optimum, and the proof decides
            with suppress(NotProvenError):
                return bound_by_point(problem, point)[0]
    return None


def _up(x: arb) -> float:
    return math.nextafter(float(arb(x.upper())), math.inf)
