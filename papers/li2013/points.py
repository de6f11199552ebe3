"""From a solver's point to a rational one with the printed V(0), and its certificate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi.conditions import Condition, condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import prove_feasible, rounded_point

from . import conditions as c
from . import problems as pr


def exact_point(problem: Problem, found: Mapping[str, Any], *, decimals: int = 12, V0: fmpq | None = None) -> dict:
    """P_1 ... S_3 rounded in scaled units; with `V0` all multiplied so that xi0'P_1 xi0 is exactly that."""
    exact = {name: rounded_point(problem, found, decimals)[name] for name in c.UNKNOWNS}
    if V0 is None:
        return exact
    factor = V0 / c.value_at_start(exact["P1"], problem.data["xi0"])[0, 0]
    return {name: matrix * factor for name, matrix in exact.items()}


def prove(
    data: Any, name: str, case: str, listed: Sequence[Condition], point: Mapping[str, Any], says: str,
    more: Mapping[str, Any] | None = None, **options: Any,
) -> dict[str, Any]:  # fmt: skip
    """Certificate that the listed conditions hold at an exact point, with the data of the case."""
    problem = pr.problem(data, name, case, listed, more=more)
    return prove_feasible(problem, {key: point[key] for key in problem.variables}, says=says, **options)


def with_start(orbits: Sequence[str], faults: str, block: str = "all") -> list[Condition]:
    """(21) of each orbit, (22), P_i > 0, V(0) equal to the print and (47)."""
    return [
        *pr.decay_conditions(orbits, faults),
        *pr.definite_conditions(),
        *pr.thrust_conditions(block),
        condition(c.initial_value),
        condition(c.initial_bound),
    ]


def preconditioner(M: np.ndarray, decimals: int = 9) -> np.ndarray:
    """Rational R with R' M R close to the identity, from the float Cholesky factor of a positive definite M."""
    factor = np.linalg.cholesky(rational.to_float(M))
    return rational.rounded(np.linalg.inv(factor).T, decimals)


def box_conditions(data: Any, case: str, orbits: Sequence[str], point: Mapping[str, Any]) -> tuple[list, dict]:
    """(21) by congruence for each orbit, and the matrices R that the conditions name; the gains are the case's box."""
    exact = pr.exact_data(data, case)
    values = {**exact, "K": ball.exact_midpoint(exact["K"]), **point}
    listed, more = [], {}
    for orbit in orbits:
        pairs = ((c.phi, c.congruent_phi, "phi"), (c.phi_hat, c.congruent_phi_hat, "phi_hat"))
        for plain, congruent, name in pairs:
            key = f"R_{name}_{orbit.removeprefix('w-')}"
            rename = {"A": pr.ORBITS[orbit]}
            more[key] = preconditioner(condition(plain, rename=rename, faults=c.DERIVED).matrix(values))
            listed.append(condition(congruent, f"{name}[{orbit}]", rename={**rename, "R": key}, faults=c.DERIVED))
    return listed, more
