"""Stability over the rounding boxes, and designs that no gain can satisfy."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact.ball import exact_midpoint
from recontrol.exact.linalg import inverse, lyapunov
from recontrol.exact.rational import decimal, diagonal, identity, rounded
from recontrol.lmi import enclosure
from recontrol.lmi.conditions import condition
from recontrol.lmi.proof import prove_feasible, prove_infeasible
from recontrol.lmi.variables import symmetric
from recontrol.systems.riccati import minimal_solution

from .. import conditions as c
from .. import plant, problems
from ..synthesis.designs import effort_of, scaled_effort

WEIGHTS = {"ext": ("1", "1", "1", "0.1", "0.1", "0.1"), "trad": ("1e-3", "1e-3", "1e-3", "1", "1", "1")}
"""Right-hand side of the Lyapunov equation that gives the common P, SI units."""


def _hurwitz(data: Any, gain: str) -> dict[str, Any]:
    case = f"box:{gain}"
    loop = problems.source(data, case)["A"]
    P = rounded(lyapunov(exact_midpoint(loop).T, diagonal(WEIGHTS[gain])), 12)
    conditions = [condition(c.definite, rename={"X": "P"}), c.decay]
    given = {"A": loop, "rate": fmpq(0)}
    problem = problems.problem(f"hurwitz-{gain}", case, {"P": symmetric(6)}, conditions, given)
    says = f"one P proves the loop with K_{gain} stable over its rounding box and for both Earth radii"
    return prove_feasible(problem, {"P": P}, says=says)


def hurwitz_ext(data: Any) -> dict[str, Any]:
    """The loop with K_ext is stable, whole box."""
    return _hurwitz(data, "ext")


def hurwitz_trad(data: Any) -> dict[str, Any]:
    """The loop with K_trad is stable, whole box."""
    return _hurwitz(data, "trad")


DECAY_RATE = "0.15"


def decay_ext(data: Any) -> dict[str, Any]:
    """Every measurable abs(F) <= 1 leaves K_ext a decay rate of 0.15 1/s, whole box, both N: one P at F = -1 and F = 1.

    The loop is affine in F, so the two ends carry the rest. P = X^{-1}, X from a Riccati equation (small gain).

    """
    case = "box:ext"
    loops = problems.source(data, case)
    rate = decimal(DECAY_RATE)
    ends = {name: loop for name, loop in loops.items() if name != "A"}
    conditions = [
        condition(c.definite, rename={"X": "P"}),
        *(condition(c.decay, f"decay_{name[2:]}", rename={"A": name}) for name in sorted(ends)),
    ]
    problem = problems.problem("decay-ext", case, {"P": symmetric(6)}, conditions, ends | {"rate": rate})
    says = "x'Px falls at twice 0.15 1/s for every measurable F with abs(F) <= 1, both N, K_ext anywhere in its box"
    return prove_feasible(problem, {"P": _decay_matrix(data, rate)}, says=says)


def _decay_matrix(data: Any, rate: fmpq) -> np.ndarray:
    scaled, K = problems.source(data, "scaled:ext"), plant.scaled_gain(data, "ext")
    A = plant.closed_loop(scaled, K) + identity(6) * (rate / plant.scale_factors(data, "ext")["ws"])
    push = scaled["B1"] @ scaled["M"]
    X = minimal_solution(A.T, push @ push.T + identity(6), scaled["N"].T @ scaled["N"])
    return plant.units(data, "ext").quadratic(rounded(inverse(rounded(X, 12)), 10), back=True)


def single_print(data: Any) -> dict[str, Any]:
    """Least squared effort that (8) as printed certifies for any gain at g = 2, from below (units ``orbit``).

    It exceeds the squared effort of K_ext. (8) at g implies (8) at every larger g, so the same holds at each g <= 2.
    """
    says = "Tr(W X^{-1} W') of every solution of (8) at g = 2 is above this bound, which exceeds the effort of K_ext"
    return enclosure.enclose(problems.least_effort(data, decimal("2")), says=says).lower_certificate


X_LIMIT = "1e6"


def nonfragile_trad(data: Any) -> dict[str, Any]:
    """No non-fragile design has a certified effort as small as that of K_trad, if Tr X stays below 1e6 scaled units.

    The limit stands for a guaranteed H2 norm of 700 rad/(N m)/s^(1/2), 2000 times that of K_ext. Without it the
    multipliers have next to no interior: the infimum is not attained, loops get ever slower.
    """
    effort = scaled_effort(data, effort_of(data, "trad"), "nonfragile")
    plain = problems.nonfragile(data, effort)
    limit = condition(c.trace_below, "x_limit", rename={"Z": "X", "rho": "x_max"})
    given = {name: value for name, value in plain.data.items() if name != "C2"} | {"x_max": decimal(X_LIMIT)}
    problem = replace(plain, objective=None, conditions=[*plain.named, limit], data=given)
    says = "no non-fragile design with Tr X below 1e6 has a certified effort as small as that of K_trad"
    return prove_infeasible(problem, says=says)
