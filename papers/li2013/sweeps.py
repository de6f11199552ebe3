"""Light solver runs for tables and searches: the paper's conditions called with CVXPY variables, block by block.

Nothing here is a proof. The conditions are the functions of `conditions`, the solver is CLARABEL unless one is named,
and the margin that counts is recomputed from the returned arrays. Proofs and named optima go through `problems`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from recontrol.exact import ball, rational
from recontrol.lmi import solvers

from . import conditions as c
from . import problems as pr

DECOMPOSED = ("xy", "z")


class SweepError(RuntimeError):
    """A solver run that a table or a search rests on gave no point."""


def floats(data: Any, case: str) -> dict[str, Any]:
    """Data of a case as floats, with exp(-2 alpha h) to full precision."""
    exact = pr.exact_data(data, case)
    out = {name: _float(value) for name, value in exact.items()}
    return {**out, "decay": float(np.exp(-2 * out["alpha"] * out["h"]))}


def _float(value: Any) -> Any:
    return ball.midpoint(value) if isinstance(value, np.ndarray) else float(rational.to_float(value))


def cvxpy_unknowns(n: int) -> dict[str, Any]:
    """CVXPY variables P_1 ... S_3 (n, n)."""
    import cvxpy

    return {
        name: cvxpy.Variable((n, n), symmetric=True) if name.startswith("P") else cvxpy.Variable((n, n))
        for name in c.UNKNOWNS
    }


def call(function: Callable[..., Any], values: Mapping[str, Any], **given: Any) -> Any:
    """`function` with its arguments taken from `values` and `given` by name."""
    import inspect

    names = inspect.signature(function).parameters
    return function(**{name: given.get(name, values.get(name)) for name in names})


@dataclass(frozen=True)
class Margin:
    """Largest t found, recomputed from the arrays, and the solver's word."""

    value: float
    words: str


def run(model: Any, solver: str = "CLARABEL") -> solvers.Run:
    """One guarded run; raises SweepError without values."""
    found = solvers.run(model, solvers.profile(solver, fast=True))
    if found.outcome not in (solvers.OPTIMAL, solvers.INACCURATE) or any(v is None for v in found.values):
        raise SweepError(f"{solver}: {found.words}")
    return found


def values_of(model: Any, found: solvers.Run) -> dict[int, np.ndarray]:
    """Values by CVXPY variable id."""
    return {v.id: np.asarray(x) for v, x in zip(model.variables(), found.values, strict=True)}


def margin(
    data: Any, case: str, orbit: str, faults: str, *, blocks: Sequence[str] = DECOMPOSED, drop_P3: bool = False,
    capped: bool = True,
) -> Margin:  # fmt: skip
    """Largest t with Phi, Phi_hat <= -t I, P_i >= t I, tr P_1 = number of states, t <= 1 (SI units).

    The state blocks share t and the trace; together they are the full problem (see `problems.unknowns`). With
    `drop_P3` the third term of the functional is left out (P_3 = 0).
    """
    import cvxpy

    t = cvxpy.Variable()
    constraints, traces, sets = ([t <= 1] if capped else []), [], []
    for block in blocks:
        values = floats(data, f"{case} block={block}")
        n = values["B"].shape[0]
        unknown = cvxpy_unknowns(n)
        if drop_P3:
            unknown["P3"] = np.zeros((n, n))
        bound = {**values, **unknown, "A": values[pr.ORBITS[orbit]], "faults": faults}
        sets.append(bound)
        traces.append(cvxpy.trace(unknown["P1"]))
        for M in (call(c.phi, bound), call(c.phi_hat, bound)):
            constraints.append((M + M.T) / 2 + t * np.eye(M.shape[0]) << 0)
        names = ("P1", "P2") if drop_P3 else ("P1", "P2", "P3")
        constraints += [unknown[name] - t * np.eye(n) >> 0 for name in names]
    size = sum(bound["B"].shape[0] for bound in sets)
    model = cvxpy.Problem(cvxpy.Maximize(t), [*constraints, sum(traces) == size])
    found = run(model)
    return Margin(_recomputed(sets, values_of(model, found), size, drop_P3), found.words)


def _recomputed(sets: list[dict[str, Any]], values: dict[int, np.ndarray], size: int, drop_P3: bool) -> float:
    points = [{**bound, **{k: values[bound[k].id] for k in c.UNKNOWNS if hasattr(bound[k], "id")}} for bound in sets]
    scale = size / sum(float(np.trace(point["P1"])) for point in points)
    ends = []
    for point in points:
        point = {**point, **{k: scale * point[k] for k in c.UNKNOWNS}}
        ends += [-float(np.linalg.eigvalsh(_sym(call(f, point)))[-1]) for f in (c.phi, c.phi_hat)]
        names = ("P1", "P2") if drop_P3 else ("P1", "P2", "P3")
        ends += [float(np.linalg.eigvalsh(_sym(point[k]))[0]) for k in names]
    return min(ends)


def _sym(M: np.ndarray) -> np.ndarray:
    return (M + M.T) / 2


def search(good: Callable[[float], float], low: float, high: float, width: float) -> dict[str, float]:
    """Bracket of the sign change of `good` (positive at low, negative at high), of at most `width`.

    Secant steps kept inside the middle of the bracket, so that it shrinks by a tenth of its length at least; the first
    bracket and the number of evaluations are part of the result. Raises SweepError without a sign change.
    """
    first, f_low, f_high, count = (low, high), good(low), good(high), 2
    if not (f_low > 0 > f_high):
        raise SweepError(f"no sign change between {low} ({f_low:.3g}) and {high} ({f_high:.3g})")
    while high - low > width:
        guess = low + (high - low) * f_low / (f_low - f_high)
        step = max(0.1 * (high - low), 0.4 * width)
        point = min(max(guess, low + step), high - step)
        value, count = good(point), count + 1
        if value > 0:
            low, f_low, f_high = point, value, f_high / 2
        else:
            high, f_high, f_low = point, value, f_low / 2
    return {"low": low, "high": high, "start": first[0], "stop": first[1], "evaluations": count}
