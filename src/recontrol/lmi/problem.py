"""A matrix-inequality problem: variables, named conditions, objective, exact data, units; solving and checking it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi import scaling, solvers
from recontrol.lmi.affine import AffineMatrix, lift, magnitudes
from recontrol.lmi.conditions import Condition, Objective, condition
from recontrol.lmi.solution import Solution
from recontrol.lmi.solvers import FAILED, INACCURATE, INFEASIBLE, OPTIMAL
from recontrol.lmi.variables import Variable, offsets

# Violation of a condition, relative to the size of its (scaled) matrix: below the first figure a point may keep the
# word "optimal" (interior-point solvers end near 1e-8), above the second it is no solution at all.
ACCEPTED, TOLERATED = 1e-6, 1e-3
# A common margin of scaled strict conditions below this is not distinguished from none.
SEEN = 1e-8


class ProblemError(ValueError):
    """A problem that is not well posed as stated: names that clash or are missing, an objective that is not scalar."""


@dataclass(frozen=True)
class Problem:
    """Variables, conditions, data and objective, each function bound by the names of its arguments.

    variables: name -> Variable.
    conditions: functions marked @positive, ..., or `Condition` objects.
    data: name -> exact matrix or scalar (object array of fmpq or arb, fmpq, arb); the solver gets the midpoints.
    objective: `minimise(f)`, `maximise(f)` or None for a feasibility problem.
    units: variable name -> unit (see `scaling.variable_weights`): V = unit * V_s, the solver sees V_s.
    boxes: variable name -> (low, high), exact matrices: closed intervals that its entries must lie in.
    rows: condition name -> row units (n,): M_s = diag(rows) M diag(rows); absent: balanced by powers of two from the
    data, or not at all with ``balanced=False``.
    paper, case, source: for certificates; ``source`` is "module:function" that rebuilds the data from paper.yaml.
    """

    name: str
    variables: Mapping[str, Variable]
    conditions: Sequence[Condition | Callable[..., Any]]
    data: Mapping[str, Any] = field(default_factory=dict)
    objective: Objective | None = None
    units: Mapping[str, Any] = field(default_factory=dict)
    boxes: Mapping[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    rows: Mapping[str, Any] = field(default_factory=dict)
    balanced: bool = True
    paper: str = ""
    case: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        named = [c if isinstance(c, Condition) else condition(c) for c in self.conditions]
        object.__setattr__(self, "conditions", tuple(named))
        names = [c.name for c in named]
        if len(set(names)) != len(names):
            raise ProblemError(f"{self.name}: conditions need different names, found {names}")
        if clash := set(self.variables) & set(self.data):
            raise ProblemError(f"{self.name}: both a variable and a datum are called {', '.join(sorted(clash))}")
        unknown = [n for names in (self.units, self.boxes) for n in names if n not in self.variables]
        if unknown:
            raise ProblemError(f"{self.name}: units or boxes for {', '.join(unknown)}, which are no variables")
        for c in named:
            for argument in getattr(c.function, "diagonal", ()):
                if not self._is_diagonal(c.rename.get(argument, argument)):
                    raise ProblemError(f"{self.name}: {c.name} proves nothing unless {argument} is diagonal")
        for name, value in self.data.items():
            ball.assert_rigorous(value, f"{self.name}, datum {name}")

    def _is_diagonal(self, name: str) -> bool:
        if name in self.variables:
            return all(i == j for i, j, _, _ in self.variables[name].entries)
        entries = np.atleast_2d(np.asarray(self.data.get(name), dtype=object))
        return all(i == j or entry == 0 for (i, j), entry in np.ndenumerate(entries))

    # -- the problem in exact form ---------------------------------------------------------------------------------

    @cached_property
    def offsets(self) -> dict[str, int]:
        """First scalar of each variable in the vector of unknowns."""
        return offsets(self.variables)

    @property
    def size(self) -> int:
        """Number of scalar unknowns."""
        return sum(v.size for v in self.variables.values())

    @cached_property
    def unknowns(self) -> list[str]:
        """Names of the scalar unknowns."""
        return [n for name, v in self.variables.items() for n in v.names(name)]

    @cached_property
    def forms(self) -> dict[str, AffineMatrix]:
        """Exact affine form of every condition, sign turned so that it reads > 0 (= 0). Raises NotAffineError."""
        values = {**self.data, **{n: v.affine(self.offsets[n]) for n, v in self.variables.items()}}
        return {c.name: _lifted(c.matrix(values)) for c in self.named}

    @cached_property
    def costs(self) -> tuple[Any, dict[int, Any]]:
        """Constant and coefficients of the objective as a minimisation (a maximum has its sign turned)."""
        if self.objective is None:
            return fmpq(0), {}
        values = {**self.data, **{n: v.affine(self.offsets[n]) for n, v in self.variables.items()}}
        constant, costs = self.objective.affine(values)
        sign = 1 if self.objective.sense == "min" else -1
        return sign * constant, {i: sign * c for i, c in costs.items()}

    @property
    def named(self) -> tuple[Condition, ...]:
        """The conditions."""
        return tuple(c for c in self.conditions if isinstance(c, Condition))

    @cached_property
    def weights(self) -> dict[str, np.ndarray]:
        """Exact unit of every entry of every variable, V = weight * V_s."""
        return {
            name: scaling.variable_weights(self.units.get(name, 1), v.matrix_shape, name)
            for name, v in self.variables.items()
        }

    @cached_property
    def unknown_units(self) -> list[fmpq]:
        """Unit of each scalar unknown; raises ProblemError if the places of one unknown have different units."""
        out: list[fmpq | None] = [None] * self.size
        for name, v in self.variables.items():
            for i, j, k, _ in v.entries:
                unit, at = self.weights[name][i, j], self.offsets[name] + k
                if out[at] not in (None, unit):
                    raise ProblemError(f"{self.name}: unit of {name} breaks its structure at ({i + 1},{j + 1})")
                out[at] = unit
        return [u if u is not None else fmpq(1) for u in out]

    @cached_property
    def unknown_boxes(self) -> dict[int, tuple[fmpq, fmpq]]:
        """Box of every scalar unknown whose variable has one, in original units."""
        out: dict[int, tuple[fmpq, fmpq]] = {}
        for name, (low, high) in self.boxes.items():
            v, first = self.variables[name], self.offsets[name]
            for k, ends in enumerate(zip(v.exact_vector(low), v.exact_vector(high), strict=True)):
                out[first + k] = ends
        return out

    @cached_property
    def row_units(self) -> dict[str, list[fmpq]]:
        """Exact congruence of each condition: M_s = diag(s) M diag(s)."""
        out = {}
        for c in self.named:
            n = self.forms[c.name].shape[0]
            if c.name in self.rows:
                out[c.name] = scaling.as_factors(self.rows[c.name], n, f"{self.name}, rows of {c.name}")
            elif self.balanced and not c.is_equality:
                out[c.name] = scaling.balance(magnitudes(self.forms[c.name], self.unknown_units))
            else:
                out[c.name] = [fmpq(1)] * n
        return out

    # -- float side ------------------------------------------------------------------------------------------------

    @cached_property
    def float_data(self) -> dict[str, Any]:
        """The data as floats (midpoints of balls)."""
        return {name: _to_float(value) for name, value in self.data.items()}

    def values(self, point: Mapping[str, Any]) -> dict[str, Any]:
        """Data and point together, as floats."""
        return {**self.float_data, **{n: _to_float(v) for n, v in point.items()}}

    def margins(self, point: Mapping[str, Any]) -> dict[str, float]:
        """Least eigenvalue of every scaled condition at a float point; minus the largest residual of an equality."""
        return {name: margin for name, (margin, _) in self._margins(point).items()}

    def _margins(self, point: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
        """Margin and size (largest modulus of the scaled data and value) of every condition and box."""
        values, out = self.values(point), {}
        for c in self.named:
            M = np.asarray(c.matrix(values), dtype=float)
            if not np.isfinite(M).all():
                out[c.name] = (-np.inf, 1.0)
            elif c.is_equality:
                out[c.name] = (-float(np.abs(M).max()), 1.0 + self._constant_size(c.name, None))
            else:
                s = rational.to_float(np.array(self.row_units[c.name], dtype=object))
                scaled = s[:, None] * (M + M.T) / 2 * s[None, :]
                size = max(float(np.abs(scaled).max()), self._constant_size(c.name, s), 1e-300)
                out[c.name] = (float(np.linalg.eigvalsh(scaled)[0]), size)
        for name, (low, high) in self.boxes.items():
            w = rational.to_float(self.weights[name])
            V, lo, hi = (np.reshape(_to_float(x), w.shape) / w for x in (point[name], low, high))
            out[f"box of {name}"] = (float(np.min([V - lo, hi - V])), float(max(np.abs(V).max(), 1e-300)))
        return out

    def _constant_size(self, name: str, s: np.ndarray | None) -> float:
        M = np.abs(ball.midpoint(self.forms[name].constant))
        return float((M if s is None else s[:, None] * M * s[None, :]).max(initial=0.0))

    def value(self, point: Mapping[str, Any]) -> float | None:
        """Objective at a float point, recomputed."""
        return None if self.objective is None else float(self.objective.value(self.values(point)))

    def solve(
        self,
        solver: str | solvers.Profile | None = None,
        *,
        margin: str | int | None = None,
        time_limit: float = solvers.DEFAULT_TIME_LIMIT,
        fast: bool = False,
        **options: Any,
    ) -> Solution:
        """Solve in scaled units and check the returned point.

        Without a ``solver`` the run's own choice counts (:func:`solvers.default`); where that one fails,
        ``solvers.BACKUP`` is asked with its own options, and the solution names it. ``fast`` takes the options that the
        profile has for searches.
        ``margin`` (decimal text) holds every strict condition off: M_s - margin I >= 0. Without an objective and a
        margin the largest common margin (at most 1) is sought, and "infeasible" means that it is not positive as far as
        the solver sees. ``time_limit`` [s] binds every solver. Further keywords are options of the solver. Raises
        SolverMissingError; everything else is an outcome.
        """
        if solver is None:
            found = self.solve(solvers.default(), margin=margin, time_limit=time_limit, fast=fast, **options)
            if found.outcome != FAILED or solvers.default() == solvers.BACKUP:
                return found
            return self.solve(solvers.BACKUP, margin=margin, time_limit=time_limit, fast=fast)
        return self._solved(solvers.profile(solver, fast=fast, **options), margin, time_limit)

    def _solved(self, chosen: solvers.Profile, margin: str | int | None, time_limit: float) -> Solution:
        from recontrol.lmi.model import build

        sought = margin is None and self.objective is None
        model = build(self, None if sought else rational.rational(margin or 0))
        run = solvers.run(model.problem, chosen, time_limit)
        if not sought:
            return self._checked(run, model, chosen.name, str(margin or 0))
        largest = run.reported if run.outcome in (OPTIMAL, INACCURATE) else None
        solution = self._checked(replace(run, reported=None), model, chosen.name, f"{largest or 0:.6g}")
        if largest is None or largest > SEEN:
            return solution
        reason = f"the largest common margin that was found is {largest:.3g}; this is no proof"
        return replace(solution, outcome=INFEASIBLE, reason=reason, point={}, duals={})

    def _checked(self, run: solvers.Run, model: Any, solver: str, margin: str) -> Solution:
        common: dict[str, Any] = {"problem": self.name, "solver": solver, "words": run.words, "margin": margin}
        common |= {"iterations": run.iterations, "seconds": run.seconds}
        x = model.point_of(run) if run.outcome in (OPTIMAL, INACCURATE) else None
        if x is None:
            return Solution(**common, outcome=run.outcome)
        if any(not np.isfinite(v).all() for v in x.values()):
            return Solution(**common, outcome=FAILED, reason="the point has entries that are not finite")
        found = self._margins(x)
        worst, (margin_found, size) = min(found.items(), key=lambda item: item[1][0] / item[1][1])
        relative = margin_found / size
        value, outcome, reason = self.value(x), run.outcome, ""
        if relative < -ACCEPTED:
            outcome = FAILED if relative < -TOLERATED else INACCURATE
            reason = f"{worst} is violated: margin {margin_found:.3g} at size {size:.3g}"
        elif value is not None and run.reported is not None and not _close(value, model.unscaled(run.reported)):
            outcome = INACCURATE
            reason = (
                f"the objective at the point is {value:.9g}, the solver reported {model.unscaled(run.reported):.9g}"
            )
        return Solution(
            **common,
            outcome=outcome,
            reason=reason,
            value=value,
            reported=None if run.reported is None else model.unscaled(run.reported),
            point=x,
            margins={name: m for name, (m, _) in found.items()},
            duals=model.duals_of(run),
        )


def agreement(solutions: Sequence[Solution], *, relative: float = 1e-5) -> dict[str, Any]:
    """Whether solvers agree on the optimal value, as a finding: values by solver, spread, and who takes part.

    Only outcomes "optimal" count; ``agrees`` is None if fewer than two did. First-order solvers are recorded without
    a vote.
    """
    table = {s.solver: s.record() for s in solutions}
    voters = [s for s in solutions if s.outcome == OPTIMAL and s.value is not None]
    voters = [s for s in voters if getattr(solvers.PROFILES.get(s.solver), "kind", "interior point") != "first order"]
    values = [s.value for s in voters if s.value is not None]
    spread = (max(values) - min(values)) / max(max(map(abs, values)), 1e-300) if values else None
    agrees = None if len(values) < 2 or spread is None else spread <= relative
    return {"agrees": agrees, "spread": spread, "voters": [s.solver for s in voters], "solvers": table}


def _close(a: float, b: float) -> bool:
    return abs(a - b) <= 1e-5 * max(1e-9, abs(a), abs(b)) + 1e-9


def _lifted(M: Any) -> AffineMatrix:
    return M if isinstance(M, AffineMatrix) else lift(M)


def _to_float(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return ball.midpoint(value) if value.dtype == object else np.asarray(value, dtype=float)
    return value if isinstance(value, float) else float(ball.midpoint(value))
