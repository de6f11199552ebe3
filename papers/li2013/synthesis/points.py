"""Rational points of the condition sets, all with the printed V(0) where the set allows it."""

from __future__ import annotations

from typing import Any

from recontrol.lmi.conditions import condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError

from .. import conditions as c
from .. import problems as pr
from ..points import exact_point

BOTH = ("w-print", "w-geo")


def _by_margin(data: Any, case: str, orbits: tuple[str, ...], faults: str) -> dict[str, Any]:
    problem = pr.point_problem(data, case, orbits, faults)
    solution = problem.solve(fast=True)
    if not solution.has_point or not solution.point["t"] > 0:
        raise NotProvenError(
            f"{case}, faults {faults!r}: no point with a margin ({solution.outcome}: {solution.words})"
        )
    point = exact_point(problem, solution.point, V0=data["V0"])
    return {"point": point, "margin": solution.point["t"], "case": case, "solver": solution.record()}


def performance_problem(
    data: Any, case: str, orbits: tuple[str, ...], faults: str, *, start: bool, value: str = "10000"
) -> Problem:
    """(21), (22), (55) and, with `start`, V(0) equal to the print; V in units of `value` [m^2 s^3]."""
    listed = [
        *pr.decay_conditions(orbits, faults),
        *pr.performance_conditions(orbits, faults, schur=True),
        *pr.definite_conditions(),
        *pr.thrust_conditions(pr.tokens(case)["block"]),
    ]
    if start:
        listed.append(condition(c.initial_value))
    return pr.problem(data, "performance", case, listed, value=value)


def _by_back_off(
    data: Any, case: str, faults: str, *, start: bool, margin: str, value: str = "10000"
) -> dict[str, Any]:
    problem = performance_problem(data, case, ("w-print",), faults, start=start, value=value)
    solution = problem.solve(margin=margin, fast=True)
    if not solution.has_point:
        raise NotProvenError(f"{case}, faults {faults!r}: no point ({solution.outcome}: {solution.words})")
    point = exact_point(problem, solution.point, V0=data["V0"] if start else None, decimals=14)
    return {"point": point, "case": case, "solver": solution.record()}


def points(data: Any) -> dict[str, Any]:
    """Exact points by name, each with its case:

    All are found for w-print; the certificates prove them for both orbits.

    decay: derived (21), (22), natural units. functional: the same in isotropic units.
    print-K, print-minus: printed (21), (22). d-only: derived (21), (55) without y_r. linear-K, linear-minus: printed
    (21), (22), (55) with the weight of (54).
    """
    linear = "weight=linear channel=both"
    return {
        "decay": _by_margin(data, "units=nat", ("w-print",), c.DERIVED),
        "functional": _by_margin(data, "units=iso", ("w-print",), c.DERIVED),
        "print-K": _by_margin(data, "units=nat", ("w-print",), c.PRINTED),
        "print-minus": _by_margin(data, "units=nat gain=minus", ("w-print",), c.PRINTED),
        "d-only": _by_back_off(data, "channel=d-only", c.DERIVED, start=False, margin="1e-6"),
        "linear-K": _by_back_off(data, linear, c.PRINTED, start=True, margin="1e-5", value="100"),
        "linear-minus": _by_back_off(data, f"gain=minus {linear}", c.PRINTED, start=True, margin="1e-5", value="100"),
    }
