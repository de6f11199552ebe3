"""The CVXPY side of a problem: scaled unknowns, the conditions called with CVXPY variables, and the way back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi.problem import Problem
from recontrol.lmi.solvers import Run


@dataclass(frozen=True)
class Model:
    """A CVXPY problem and the maps between its positions and the names of the original problem."""

    source: Problem
    problem: Any
    unknowns: Mapping[str, Any]
    constraints: Mapping[str, int]
    objective_unit: float

    def point_of(self, run: Run) -> dict[str, Any] | None:
        """Matrices in original units from the scaled vectors of unknowns; None if a value is missing."""
        by_id = {v.id: value for v, value in zip(self.problem.variables(), run.values, strict=True)}
        out: dict[str, Any] = {}
        for name, v in self.source.variables.items():
            x = by_id.get(self.unknowns[name].id, np.zeros(v.size))
            if x is None:
                return None
            scaled = np.reshape(v.matrix(np.asarray(x, dtype=float)), v.matrix_shape)
            V = scaled * rational.to_float(self.source.weights[name])
            out[name] = V if v.shape else float(V[0, 0])
        return out

    def duals_of(self, run: Run) -> dict[str, np.ndarray]:
        """Multiplier of each condition in original units, Z = S Z_s S, so that <Z, M> = <Z_s, M_s>."""
        out = {}
        for name, position in self.constraints.items():
            if position < len(run.duals) and run.duals[position] is not None:
                s = rational.to_float(np.array(self.source.row_units[name], dtype=object))
                Z = np.reshape(run.duals[position], (len(s), -1))
                if Z.shape == (len(s), len(s)):
                    out[name] = s[:, None] * Z * s[None, :]
        return out

    def unscaled(self, reported: float) -> float:
        """The solver's objective in original units and sense."""
        return reported * self.objective_unit


def build(problem: Problem, margin: fmpq | None) -> Model:
    """The problem with CVXPY variables, in scaled units, strict conditions held off by ``margin``.

    None: the largest common margin up to 1 is the objective.
    """
    import cvxpy

    unknowns, values = {}, dict(problem.float_data)
    for name, v in problem.variables.items():
        unknowns[name] = cvxpy.Variable(v.size, name=name)
        values[name] = _expression(v, unknowns[name], rational.to_float(problem.weights[name]))
    off = cvxpy.Variable() if margin is None else float(rational.to_float(margin))
    constraints: list[Any] = []
    positions: dict[str, int] = {}
    for c in problem.named:
        M = c.matrix(values)
        positions[c.name] = len(constraints)
        if c.is_equality:
            constraints.append(M == 0)
            continue
        s = rational.to_float(np.array(problem.row_units[c.name], dtype=object))
        n = M.shape[0]
        scaled = cvxpy.multiply(np.outer(s, s), (M + M.T) / 2)
        held = scaled - off * np.eye(n) if c.is_strict else scaled
        constraints.append(held >> 0 if n > 1 else held[0, 0] >= 0)
    for name, (low, high) in problem.boxes.items():
        v = problem.variables[name]
        w = v.vector(rational.to_float(problem.weights[name]))
        lo, hi = (v.vector(rational.to_float(bound)) / w for bound in (low, high))
        constraints += [unknowns[name] >= lo, unknowns[name] <= hi]
    objective, unit = _objective(problem, values)
    if margin is None:
        objective = cvxpy.Maximize(off)
        constraints.append(off <= 1)
    return Model(problem, cvxpy.Problem(objective, constraints), unknowns, positions, unit)


def _expression(v: Any, x: Any, weights: np.ndarray) -> Any:
    import cvxpy

    if not v.shape:
        return float(weights[0, 0]) * x[0]
    basis = v.basis().multiply(weights.reshape(-1, 1)).tocsc()
    return cvxpy.reshape(basis @ x, v.shape, order="C")


def _objective(problem: Problem, values: Mapping[str, Any]) -> tuple[Any, float]:
    """CVXPY objective divided by the size of its scaled coefficients, and that size."""
    import cvxpy

    if problem.objective is None:
        return cvxpy.Minimize(0), 1.0
    expression = problem.objective.value(values)
    _, costs = problem.costs
    sizes = [abs(float(rational.to_float(c * problem.unknown_units[i]))) for i, c in costs.items()]
    unit = float(rational.to_float(_power(max(sizes)))) if sizes and max(sizes) > 0 else 1.0
    wrapper = cvxpy.Minimize if problem.objective.sense == "min" else cvxpy.Maximize
    return wrapper(expression / unit), unit


def _power(size: float) -> fmpq:
    from recontrol.lmi.scaling import power_of_two

    return power_of_two(size)
