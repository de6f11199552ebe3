"""Infimum of gamma in (55): per channel, with (21) at alpha = 0.02 or 0, for the derived and the printed blocks."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.exact import rational
from recontrol.lmi.conditions import minimise
from recontrol.lmi.enclosure import bound_by_point
from recontrol.lmi.problem import Problem, Solution, agreement
from recontrol.lmi.variables import scalar

from .. import conditions as c
from .. import problems as pr
from ..sweeps import DECOMPOSED

CHANNELS = ("both", "d-only", "yr-only")
PERIODS = ("0.25", "0.5", "0.75", "1.0", "1.5")


def gamma_problem(
    data: Any, case: str, orbit: str, faults: str, *, with_decay: bool = True, value: str = "10000"
) -> Problem:
    """Least gamma^2 with (55) and, if asked, (21); V in units of `value` [m^2 s^3]."""
    listed = [*pr.performance_conditions((orbit,), faults, schur=True), *pr.definite_conditions()]
    if with_decay:
        listed = [*pr.decay_conditions((orbit,), faults), *listed]
    problem = pr.problem(
        data, "gamma", case, listed, value=value, objective=minimise(c.weight), extra={"gamma2": scalar()}
    )
    return replace(problem, units={**problem.units, "gamma2": 1})


def infimum(solution: Solution) -> float | None:
    """gamma of a solved problem, None without a point."""
    return float(np.sqrt(max(solution.value, 0.0))) if solution.has_point and solution.value is not None else None


def _by_block(data: Any, case: str, orbit: str, faults: str, alpha: str, value: str = "10000") -> dict[str, Any]:
    """gamma of each block and the larger one; with alpha = 0, (55) implies (21), which is left out."""
    out: dict[str, Any] = {}
    for block in DECOMPOSED:
        full = f"{case} block={block} alpha={alpha}"
        problem = gamma_problem(data, full, orbit, faults, with_decay=alpha != "0", value=value)
        out[block] = infimum(problem.solve(fast=True))
    found = [out[block] for block in DECOMPOSED if out[block] is not None]
    return {**out, "gamma": max(found) if len(found) == len(DECOMPOSED) else None}


def _second_opinion(data: Any, alpha: str) -> dict[str, Any]:
    """d-only, w-print, both blocks by solvers of different kind, and a proven upper bound."""
    out = {}
    for block in DECOMPOSED:
        case = f"channel=d-only block={block} alpha={alpha}"
        problem = gamma_problem(data, case, "w-print", c.DERIVED, with_decay=alpha != "0")
        solutions = [problem.solve("CLARABEL", fast=True), problem.solve("CVXOPT"), problem.solve("SDPA")]
        upper, _ = bound_by_point(problem, problem.solve(margin="1e-8", fast=True).point)
        out[block] = {"solvers": agreement(solutions), "upper": float(np.sqrt(rational.to_float(upper)))}
    return out


def gamma(data: Any) -> dict[str, Any]:
    """derived: orbit -> channel -> alpha -> {xy, z, gamma}; printed: orbit -> channel -> {...}; law: h -> {...};
    full: one solve of all nine states; second: other solvers and enclosures of the d-only optimum.
    """
    derived: dict[str, Any] = {"w-print": {}, "w-geo": {}}
    for orbit in derived:
        for channel in CHANNELS:
            alphas = ("0.02", "0") if orbit == "w-print" or channel == "d-only" else ("0.02",)
            derived[orbit][channel] = {
                f"a{alpha.removeprefix('0.')}": _by_block(data, f"channel={channel}", orbit, c.DERIVED, alpha)
                for alpha in alphas
            }
    # The printed values with y_r converge slowly in SI units: integrals are counted in 5 m s and V in 100 m^2 s^3.
    printed = {
        orbit: {
            channel: _by_block(data, f"channel={channel} units=fine", orbit, c.PRINTED, "0", "100")
            for channel in CHANNELS
        }
        for orbit in ("w-print", "w-geo")
    }
    law = {h: _by_block(data, f"channel=yr-only units=fine h={h}", "w-print", c.PRINTED, "0", "100") for h in PERIODS}
    full = gamma_problem(data, "channel=d-only", "w-print", c.DERIVED).solve(fast=True)
    return {
        "derived": derived,
        "printed": printed,
        "law": law,
        "full": {"gamma": infimum(full), "solver": full.record()},
        "second": {"a02": _second_opinion(data, "0.02"), "a0": _second_opinion(data, "0")},
    }
