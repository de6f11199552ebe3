"""Optimal values from both sides: a proven point on one, proven multipliers on the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi import duality, proof
from recontrol.lmi.duality import Multipliers, NotProvenError
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import PRECISION
from recontrol.lmi.solvers import DEFAULT_TIME_LIMIT

__all__ = ["Enclosure", "NotProvenError", "bound_by_multipliers", "bound_by_point", "enclose"]

# Held off by less, a point fails at the solver's own accuracy; by more, the enclosure is wide for nothing.
BACK_OFFS = ("1e-9", "1e-8", "1e-7", "1e-6", "1e-5")


@dataclass(frozen=True)
class Enclosure:
    """Proven bounds of an optimal value, exact, with their certificates and the rational point of one of them."""

    lower: fmpq
    upper: fmpq
    lower_certificate: dict[str, Any]
    upper_certificate: dict[str, Any]
    point: dict[str, Any]

    @property
    def relative_width(self) -> float:
        """Width over the larger modulus of the ends."""
        size = max(abs(self.lower), abs(self.upper), fmpq(1, 10**300))
        return float(rational.to_float((self.upper - self.lower) / size))


def bound_by_point(
    problem: Problem,
    point: Mapping[str, Any],
    *,
    decimals: int = 14,
    digits: int = 9,
    precision: int = PRECISION,
    says: str = "",
    notes: Mapping[str, str] | None = None,
) -> tuple[fmpq, dict[str, Any]]:
    """Upper bound of a minimum (lower bound of a maximum) from a point that is proven feasible, and its certificate.

    ``point`` as in `proof.prove_feasible`. The bound is rounded outwards to ``digits`` significant digits. Raises
    NotProvenError.
    """
    exact = proof.rounded_point(problem, point, decimals)
    unknowns = [u for n, v in problem.variables.items() for u in v.exact_vector(exact[n])]
    constant, costs = problem.costs
    value = _outwards(_end(constant + sum((c * unknowns[i] for i, c in costs.items()), fmpq(0)), 1), digits, 1)
    side, stated = ("upper", value) if proof.objective_sense(problem) == "min" else ("lower", -value)
    bound = {"side": side, "value": rational.text(stated)}
    says = says or f"{problem.name}: {side} bound of the optimal value"
    return stated, proof.point_certificate(problem, exact, "bound", says, precision, notes or {}, bound)


def bound_by_multipliers(
    problem: Problem,
    multipliers: Mapping[str, Any] | Multipliers,
    *,
    digits: int = 9,
    precision: int = PRECISION,
    says: str = "",
    notes: Mapping[str, str] | None = None,
) -> tuple[fmpq, dict[str, Any]]:
    """Lower bound of a minimum (upper bound of a maximum) from exact multipliers, and its certificate.

    ``multipliers`` as in `proof.prove_infeasible`, here with sum <Z_c, M_ci> = c_i for the objective's coefficients (of
    the minimisation: a maximum has its sign turned). Raises NotProvenError.
    """
    exact = multipliers if isinstance(multipliers, Multipliers) else proof.given_multipliers(problem, multipliers)
    value = _outwards(_end(_dual_value(problem, exact), -1), digits, -1)
    side, stated = ("lower", value) if proof.objective_sense(problem) == "min" else ("upper", -value)
    bound = {"side": side, "value": rational.text(stated)}
    says = says or f"{problem.name}: {side} bound of the optimal value"
    return stated, proof.multiplier_certificate(problem, exact, "bound", says, precision, notes or {}, bound)


def enclose(
    problem: Problem,
    *,
    margin: str | None = None,
    decimals: int = 14,
    dual_decimals: int = 14,
    digits: int = 9,
    precision: int = PRECISION,
    solver: str = "CLARABEL",
    time_limit: float = DEFAULT_TIME_LIMIT,
    says: str = "",
) -> Enclosure:
    """Rigorous lower and upper bound of the optimal value of ``problem``.

    One solve of a perturbed problem gives a point that holds every condition by ``margin`` and multipliers held
    off zero by as much, both in scaled units; they are rounded, repaired exactly and proven. Without ``margin`` the
    back-off grows tenfold from 1e-9 to 1e-5 until both sides are proven. The stated bounds are rounded outwards to
    ``digits`` significant digits. Raises NotProvenError with what failed at the last back-off.
    """
    if problem.objective is None:
        raise NotProvenError(f"{problem.name}: an enclosure needs an objective")
    by_point: tuple[fmpq, dict[str, Any]] | None = None
    by_multipliers: tuple[fmpq, dict[str, Any]] | None = None
    point: dict[str, Any] = {}
    failures: list[str] = []
    for back_off in BACK_OFFS if margin is None else (margin,):
        notes = {"solver": solver, "back_off": back_off}
        common: dict[str, Any] = {"digits": digits, "precision": precision, "says": says, "notes": notes}
        failures = []
        try:
            x, floats = duality.held_off_bound(problem, float(back_off), float(back_off), solver, time_limit)
        except NotProvenError as error:
            failures.append(str(error))
            continue
        if by_point is None:
            try:
                point = proof.rounded_point(problem, _point_of(problem, x), decimals)
                by_point = bound_by_point(problem, point, **common)
            except NotProvenError as error:
                failures.append(str(error))
        if by_multipliers is None:
            try:
                by_multipliers = bound_by_multipliers(
                    problem, duality.rationalise(problem, floats, dual_decimals), **common
                )
            except NotProvenError as error:
                failures.append(str(error))
        if by_point and by_multipliers:
            first, second = by_multipliers, by_point
            if proof.objective_sense(problem) == "max":
                first, second = second, first
            return Enclosure(first[0], second[0], first[1], second[1], point)
    raise NotProvenError(f"{problem.name}: no enclosure: {'; '.join(failures)}")


def _dual_value(problem: Problem, exact: Multipliers) -> Any:
    """The bound that exact multipliers give, c0 - sum <Z, M_0> + the least contribution of boxed unknowns."""
    constant, costs = problem.costs
    value, residual = constant, dict(costs)
    for name, Z in exact.matrices.items():
        form = problem.forms[name]
        value = value - rational.trace_product(form.constant(), Z)
        for i, M in form.coefficients().items():
            residual[i] = residual.get(i, fmpq(0)) - rational.trace_product(M, Z)
    for i, (low, high) in duality.unknown_boxes(problem).items():
        r = residual.get(i, fmpq(0))
        value = value + (min(r * low, r * high) if ball.has_balls(r) is False else ball.to_ball(r * low).min(r * high))
    return value


def _end(value: Any, direction: int) -> fmpq:
    if isinstance(value, fmpq):
        return value
    return (value.upper() if direction > 0 else value.lower()).fmpq()


def _outwards(value: fmpq, digits: int, direction: int) -> fmpq:
    """``value`` rounded up (direction 1) or down (-1) to ``digits`` significant digits."""
    if value == 0:
        return value
    exponent = digits - 1 - int(np.floor(np.log10(abs(float(rational.to_float(value))))))
    scale = fmpq(10) ** exponent
    scaled = value * scale
    return fmpq(scaled.ceil() if direction > 0 else scaled.floor()) / scale


def _point_of(problem: Problem, x: np.ndarray) -> dict[str, Any]:
    """Float point in original units from the scaled vector of unknowns."""
    out = {}
    for name, v in problem.variables.items():
        first = problem.offsets[name]
        scaled = np.reshape(v.matrix(x[first : first + v.size]), v.matrix_shape)
        out[name] = scaled * rational.to_float(problem.weights[name])
    return out
