"""Four solvers on five problems, in scaled units and in naive SI units: optimal values, and what each solver says."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from recontrol.exact.rational import decimal
from recontrol.lmi.problem import Problem, agreement

from .. import plant, problems
from .designs import effort_of, scaled_effort

SOLVERS = ("CLARABEL", "CVXOPT", "SDPA", "SCS")
TIME_LIMIT = 10.0


def solvers(data: Any) -> dict[str, Any]:
    """Per problem: ``scaled`` and ``SI`` tables of `recontrol.lmi.problem.agreement`; SI runs without balancing."""
    return {
        name: {units: _table(build(units)) for units in ("scaled", "SI")} for name, build in _problems(data).items()
    }


def _table(problem: Problem) -> dict[str, Any]:
    options = {"SCS": {"max_iters": 10_000}}
    return agreement([problem.solve(s, time_limit=TIME_LIMIT, **options.get(s, {})) for s in SOLVERS])


def _problems(data: Any) -> dict[str, Callable[[str], Problem]]:
    effort = effort_of(data, "ext")

    def bound(units: str) -> Any:
        return scaled_effort(data, effort, "ext") if units == "scaled" else effort**2

    def plain(units: str) -> dict[str, Any]:
        return {"balanced": units == "scaled"}

    return {
        "h2_effort": lambda u: problems.h2_effort(data, "ext", bound(u), u, **plain(u)),
        "rho_trad-ext": lambda u: problems.fixed(data, "ext", "trad", decimal("1.01"), u, **plain(u)),
        "rho_trad-trad": lambda u: problems.fixed(data, "trad", "trad", decimal("1.01"), u, **plain(u)),
        "single_std": lambda u: problems.single(data, "std", decimal("1.1"), bound(u), u, **plain(u)),
        "thm1_iii-ext": lambda u: problems.thm1_iii(data, "ext", u, **plain(u)),
    }


def unit_of(data: Any, name: str, units: str) -> Any:
    """Factor from the optimal value of a problem to SI units."""
    if units == "SI":
        return 1
    gain = "trad" if name.endswith("-trad") else "ext"
    return plant.scale_factors(data, gain)["h8" if name.startswith("rho_trad") else "h"]
