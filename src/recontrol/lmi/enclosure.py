"""Optimal values from both sides: a proven point on one, proven multipliers on the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi import central, duality, proof
from recontrol.lmi.duality import NotProvenError
from recontrol.lmi.faces import Faced, given_faces
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import PRECISION
from recontrol.lmi.repair import Multipliers, projected, rationalise
from recontrol.lmi.solvers import DEFAULT_TIME_LIMIT

__all__ = ["Enclosure", "NotProvenError", "bound_by_multipliers", "bound_by_point", "enclose"]

# Nearest point of the central path, relative; how many of its points are tried; unknowns times entries it is worth.
NEAREST, TRIES, WORK = 1e-7, 4, 2_000_000
# Least eigenvalue of interior multipliers (of unit total trace) that is more than a solver's noise.
INSIDE = 1e-9
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
    faces: Mapping[str, Any] | None = None,
    decimals: int = 14,
    dual_decimals: int = 14,
    digits: int = 9,
    precision: int = PRECISION,
    solver: str = "CLARABEL",
    time_limit: float = DEFAULT_TIME_LIMIT,
    says: str = "",
) -> Enclosure:
    """Rigorous lower and upper bound of the optimal value of ``problem``.

    A first solve shows the size of everything near the optimum. In units of that size, one solve of a perturbed problem
    gives a point that holds every condition by ``margin`` and multipliers held off zero by as much; they are rounded,
    repaired exactly and proven. Without ``margin`` the back-off grows tenfold from 1e-9 to 1e-5 until both sides are
    proven. The stated bounds are rounded outwards to ``digits`` significant digits. ``faces`` as in
    `proof.prove_infeasible`. Raises NotProvenError.
    """
    if problem.objective is None:
        raise NotProvenError(f"{problem.name}: an enclosure needs an objective")
    search = _Search(
        problem, Faced(problem, given_faces(problem, faces)), solver, time_limit, (decimals, dual_decimals)
    )
    for back_off in BACK_OFFS if margin is None else (margin,):
        notes = {"solver": solver, "back_off": back_off}
        search.step(back_off, {"digits": digits, "precision": precision, "says": says, "notes": notes})
        if search.by_point and search.by_multipliers:
            ends = [search.by_multipliers, search.by_point]
            if proof.objective_sense(problem) == "max":
                ends.reverse()
            return Enclosure(ends[0][0], ends[1][0], ends[0][1], ends[1][1], search.point)
    raise NotProvenError(f"{problem.name}: no enclosure: {'; '.join(search.failures)}")


@dataclass
class _Search:
    """Both sides of an enclosure while the back-off grows; a side that is proven is kept."""

    problem: Problem
    faced: Faced
    solver: str
    time_limit: float
    decimals: tuple[int, int]
    by_point: tuple[fmpq, dict[str, Any]] | None = None
    by_multipliers: tuple[fmpq, dict[str, Any]] | None = None
    point: dict[str, Any] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)
    tried: bool = False

    def step(self, back_off: str, common: dict[str, Any]) -> None:
        """Try the sides that are still open at this back-off; one solve gives both where the multipliers are easy."""
        self.failures, off, whole = [], float(back_off), Faced(self.problem, {}, self.near)
        if not self.faced.faces and (found := self._solved(whole, off, off)):
            self._point(found[0], common)
            self._multipliers(whole, found[1], common)
        if self.by_point is None and (found := self._solved(whole, off, 0.0)):
            self._point(found[0], common)
        if self.by_multipliers is None and not self.tried:
            self.tried = True
            self._on_central_paths(common)

    def _central(self, faced: Faced, interior: Mapping[str, np.ndarray], common: dict[str, Any]) -> None:
        """Multipliers from the central path: the nearest point of it that can be proven."""
        form = duality.float_form(faced)
        work = self.problem.size * sum(M.size for M in form.constants.values())
        if form.boxes or work > WORK or (found := self._solved(faced, 0.0, 0.0)) is None:
            return
        unknowns = list(range(self.problem.size))
        start = projected(form, central.blend(form, found[1], interior), unknowns)
        size = max(abs(central.value(form, found[1])), 1e-12)
        points = list(central.path(form, start, unknowns, NEAREST * size, size))
        for width, Z in reversed(points[-TRIES:]):
            if self.by_multipliers is not None:
                break
            conditioned = faced.conditioned(Z)
            notes = {**common["notes"], "back_off": f"central path, gap {width:.1e}"}
            self._multipliers(conditioned, conditioned.in_bases(Z), {**common, "notes": notes})

    def _on_central_paths(self, common: dict[str, Any]) -> None:
        """Follow the path on the given faces, or on those that are found, until one gives a proof."""
        start = Faced(self.problem, self.faced.faces, self.near)
        try:
            for faced, interior in duality.candidates(start, None, self.solver, self.time_limit):
                if interior.least > INSIDE:
                    self._central(faced, interior.multipliers, common)
                if self.by_multipliers is not None:
                    return
        except NotProvenError as error:
            self.failures.append(str(error))

    @cached_property
    def near(self) -> tuple[float, ...] | None:
        """Unknowns near the optimum, for units in which both sides can be held off by little."""
        found = self._solved(Faced(self.problem, {}), 0.0, 0.0)
        return tuple(found[0]) if found and np.isfinite(found[0]).all() else None

    def _solved(self, faced: Faced, margin: float, dual: float) -> tuple[np.ndarray, dict[str, np.ndarray]] | None:
        try:
            return duality.held_off_bound(faced, margin, dual, self.solver, self.time_limit)
        except NotProvenError as error:
            self.failures.append(str(error))
            return None

    def _point(self, x: np.ndarray, common: dict[str, Any]) -> None:
        if self.by_point is None:
            try:
                point = proof.rounded_point(self.problem, _point_of(self.problem, x), self.decimals[0])
                self.by_point, self.point = bound_by_point(self.problem, point, **common), point
            except NotProvenError as error:
                self.failures.append(str(error))

    def _multipliers(self, faced: Faced, floats: dict[str, np.ndarray], common: dict[str, Any]) -> None:
        if self.by_multipliers is None:
            try:
                exact = rationalise(faced, floats, self.decimals[1])
                self.by_multipliers = bound_by_multipliers(self.problem, exact, **common)
            except NotProvenError as error:
                self.failures.append(str(error))


def _dual_value(problem: Problem, exact: Multipliers) -> Any:
    """The bound that exact multipliers give, c0 - sum <Z, M_0> + the least contribution of boxed unknowns."""
    constant, costs = problem.costs
    value, residual = constant, dict(costs)
    for name, Z in exact.matrices.items():
        form = problem.forms[name]
        value = value - rational.trace_product(form.constant, Z)
        for i, M in form.coefficients.items():
            residual[i] = residual.get(i, fmpq(0)) - sum((x * Z[place] for place, x in M.items()), fmpq(0))
    for i, (low, high) in problem.unknown_boxes.items():
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
    """Float point from the vector of unknowns in original units."""
    out = {}
    for name, v in problem.variables.items():
        first = problem.offsets[name]
        out[name] = np.reshape(v.matrix(x[first : first + v.size]), v.matrix_shape)
    return out
