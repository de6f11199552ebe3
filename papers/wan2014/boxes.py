"""What the rounding boxes of the printed X, Y, K admit: margins, witnesses and refutations.

Everything is solved in half widths, X = X0 + hX o z with abs(z) <= 1, since the boxes are 1e-5 of their values and the
widths of K differ by five orders of magnitude. The conditions are those of the problem; Y = K X is either relaxed over
the whole box (a negative margin then refutes the box) or linearised at a point (a search from below).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi import proof, solvers
from recontrol.lmi.problem import Problem

from .problems import Scale, boxed, linked, source

Array = np.ndarray
RANK = 3


@dataclass(frozen=True)
class Print:
    """Printed midpoints and half widths of X, Y, K as floats."""

    X: Array
    Y: Array
    K: Array
    hX: Array
    hY: Array
    hK: Array

    @classmethod
    def of(cls, data: Any) -> Print:
        mids = [data.float(name) for name in "XYK"]
        return cls(*mids, *[rational.to_float(data.half(name)) for name in "XYK"])


@dataclass(frozen=True)
class Found:
    """Answer of one solve: margin [1/s] (None if the solver gave none), the point in SI units, scaled multipliers."""

    margin: float | None
    words: str
    point: dict[str, Any]
    multipliers: dict[str, Array]


@dataclass(frozen=True)
class Link:
    """How K enters: relaxed over its box (`point` None), or linearised at (X, K) within `trust` half widths."""

    point: tuple[Array, Array] | None = None
    trust: float = 2.0


def solve(problem: Problem, data: Any, link: Link | None, *, shrink: float = 1.0, solver: str = "CLARABEL") -> Found:
    """Maximise the objective of `problem` over the boxes of X and Y, and of K if linked; boxes shrunk by `shrink`."""
    import cvxpy as cp

    p = Print.of(data)
    z, y = cp.Variable((6, 6), symmetric=True), cp.Variable((3, 6))
    X, Y = p.X + cp.multiply(p.hX, z), p.Y + cp.multiply(p.hY, y)
    units = {name: float(rational.to_float(problem.weights[name]).flat[0]) for name in problem.variables}
    scaled = {name: cp.Variable(v.size) for name, v in problem.variables.items() if name not in "XY"}
    values: dict[str, Any] = {**problem.float_data, "X": X, "Y": Y}
    for name, x in scaled.items():
        values[name] = units[name] * (x[0] if problem.variables[name].shape == () else x[0] * np.eye(6))
    constraints: list[Any] = [cp.abs(z) <= shrink, cp.abs(y) <= shrink]
    first = len(constraints)
    for c in problem.named:
        s = rational.to_float(np.array(problem.row_units[c.name], dtype=object))
        M = c.matrix(values)
        constraints.append(cp.multiply(np.outer(s, s), (M + M.T) / 2) >> 0)
    linked = _linked(cp, p, link, z, Y, shrink) if link else ([], None, None)
    constraints += linked[0]
    assert problem.objective is not None
    model = cp.Problem(cp.Maximize(problem.objective.value(values)), constraints)
    run = _run(model, solver)
    by_id = {v.id: value for v, value in zip(model.variables(), run.values, strict=False)}
    if run.outcome not in (solvers.OPTIMAL, solvers.INACCURATE) or by_id.get(z.id) is None:
        return Found(None, run.words, {}, {})
    point = {"X": p.X + p.hX * by_id[z.id], "Y": p.Y + p.hY * by_id[y.id]}
    point |= {name: float(by_id[x.id][0]) * units[name] for name, x in scaled.items()}
    if linked[1] is not None:
        point["K"] = p.K + p.hK * by_id[linked[1].id]
    duals = {c.name: np.asarray(d) for c, d in zip(problem.named, run.duals[first:], strict=False)}
    if linked[2] is not None:
        duals["product_gap"] = linked[2](run.duals)
    reported = float(run.reported) if run.reported is not None else None
    return Found(reported, run.words, point, duals)


def _run(model: Any, solver: str) -> solvers.Run:
    """One run; CLARABEL again without its equilibration, which is capped at 1e4 and may undo the half widths."""
    if solver != "CLARABEL":
        return solvers.run(model, solvers.profile(solver))
    run = solvers.run(model, solvers.profile(solver, fast=True))
    if run.outcome == solvers.OPTIMAL:
        return run
    plain = solvers.profile(solver, fast=True, chordal_decomposition_enable=False, equilibrate_enable=False)
    return solvers.run(model, plain)


def _linked(cp: Any, p: Print, link: Link, z: Any, Y: Any, shrink: float) -> tuple[list[Any], Any, Any]:
    """Constraints that tie Y to K X, the half widths of K, and how to read the multiplier of the tie (SI, scaled)."""
    w = cp.Variable((3, 6))
    unit = _link_unit(p)
    if link.point is None:
        s = cp.Variable((3, 6))
        KX = p.K @ p.X + p.K @ cp.multiply(p.hX, z) + cp.multiply(p.hK, w) @ p.X + cp.multiply(p.hK @ p.hX, s)
        tie = cp.multiply(1 / unit, Y - KX) == 0
        bounds = [cp.abs(w) <= shrink, cp.abs(s) <= 1]
    else:
        X0, K0 = link.point
        z0, w0 = (X0 - p.X) / p.hX, (K0 - p.K) / p.hK
        KX = K0 @ p.X + K0 @ cp.multiply(p.hX, z) + cp.multiply(p.hK, w - w0) @ X0
        tie = cp.multiply(1 / unit, Y - KX) == 0
        bounds = [cp.abs(w) <= shrink, cp.abs(z - z0) <= link.trust, cp.abs(w - w0) <= link.trust]
    constraints = [*bounds, tie]
    return constraints, w, lambda duals: np.asarray(duals[-1]) / unit


def _link_unit(p: Print) -> Array:
    """Scale of each entry of Y - K X: the printed Y, or what the box of X moves it by."""
    return np.maximum(np.abs(p.Y), np.abs(p.K) @ p.hX)


def margin(problem: Problem, data: Any, *, with_gain: bool, solver: str = "CLARABEL") -> Found:
    """Largest margin [1/s] of (14) over the boxes; with_gain: relaxed in K, so that a negative one refutes the box."""
    found = solve(problem, data, Link() if with_gain else None, solver=solver)
    if found.margin is None:
        return found
    return Found(found.margin * float(rational.to_float(Scale.rate)), found.words, found.point, found.multipliers)


def refutation(held: Problem, data: Any, *, with_gain: bool) -> dict[str, Any] | None:
    """Vectors v (scaled rows) with sum v' (14) v >= 0 over the boxes, and the multiplier of Y = K X; else None.

    The multiplier of the margin problem is a sum of few v v', mostly one; those of (30), (31) vanish.
    """
    found = margin(held, data, with_gain=with_gain)
    if found.margin is None or found.margin >= 0:
        return None
    Z = found.multipliers[held.named[0].name]
    sizes, vectors = np.linalg.eigh((Z + Z.T) / 2)
    leading = np.sqrt(np.maximum(sizes[-RANK:], 0) / sizes[-1])
    answer = {"margin": found.margin, "vectors": (vectors[:, -RANK:] * leading).T}
    if with_gain:
        left, right = (rational.to_float(source(data, held.case)[k]).diagonal() for k in ("left", "right"))
        answer["tie"] = found.multipliers["product_gap"] / sizes[-1] / left[:, None] / right[None, :]
    return answer


def refute(plain: Problem, data: Any, found: Mapping[str, Any], says: str = "") -> dict[str, Any]:
    """Exclusion certificate for `plain` over the boxes from a `refutation`; NotProvenError if rounding spoils it."""
    with_gain = "tie" in found
    target = boxed(data, plain, with_gain=with_gain)
    first = target.named[0].name
    Z = _vector_multiplier(target, np.asarray(found["vectors"]))
    failure = ""
    for sign in (1, -1):  # solvers differ in the sign of an equality's multiplier
        multipliers = {first: Z}
        if with_gain:
            multipliers["product_gap"] = rational.rounded(sign * np.asarray(found["tie"]), 14)
        try:
            return proof.prove_infeasible(target, multipliers=multipliers, says=says)
        except proof.NotProvenError as error:
            failure = str(error)
    raise proof.NotProvenError(failure)


def _vector_multiplier(target: Problem, vectors: Array) -> Array:
    """Exact Z = sum v v' + D, free of eps: D >= 0 sits on the block of eps, where the v are shrunk first."""
    name = target.named[0].name
    v = rational.rounded(vectors, 10) * np.array(target.row_units[name], dtype=object)
    start = 12 if name == "eq14" else 6
    part = np.zeros(v.shape[1], dtype=bool)
    part[start : start + 6] = True
    own = sum(x * x for x in v[:, part].flat)
    spread = own - eps_weight(target, v.T @ v)
    shrink = min(1.0, float(rational.to_float(spread / own)) ** 0.5) * (1 - 1e-6)
    v = np.where(part, v * rational.rounded(shrink, 9), v)
    Z = v.T @ v
    excess = eps_weight(target, Z)
    for k in np.flatnonzero(part):
        Z[k, k] -= excess / 6
    return Z


def eps_weight(target: Problem, Z: Array) -> fmpq:
    """Coefficient of eps in <Z, M>, M the first condition of `target`."""
    entries = target.forms[target.named[0].name].coefficients[target.offsets["eps"]]
    return sum((x * Z[place] for place, x in entries.items()), fmpq(0))


def gain_point(data: Any, sweeps: int = 8) -> tuple[float, Array, Array]:
    """Smallest common multiple of all half widths that admits K X = Y, by linear programs; and X, K there."""
    import cvxpy as cp

    p = Print.of(data)
    X, K, multiple = p.X, p.K, np.inf
    for _ in range(sweeps):
        z, w, t = cp.Variable((6, 6), symmetric=True), cp.Variable((3, 6)), cp.Variable()
        excess = K @ p.X - p.Y + K @ cp.multiply(p.hX, z) + cp.multiply(p.hK, w - (K - p.K) / p.hK) @ X
        tie = cp.abs(cp.multiply(1 / p.hY, excess)) <= t
        model = cp.Problem(cp.Minimize(t), [tie, cp.abs(z) <= t, cp.abs(w) <= t])
        run = solvers.run(model, solvers.profile("CLARABEL"))
        by_id = {v.id: value for v, value in zip(model.variables(), run.values, strict=True)}
        X, K, multiple = p.X + p.hX * by_id[z.id], p.K + p.hK * by_id[w.id], float(by_id[t.id])
        X = (X + X.T) / 2
    return multiple, X, K


def rounded_print(X: Array, K: Array) -> tuple[Array, Array]:
    """X and K as rationals: 18 and 14 decimals."""
    upper = np.triu(X)
    return rational.rounded(upper + np.triu(X, 1).T, 18), rational.rounded(K, 14)


def inside(M: Array, mid: Array, half: Array) -> bool:
    """Whether the exact matrix lies in the closed box."""
    return all(abs(a - b) <= h for a, b, h in zip(M.flat, mid.flat, half.flat, strict=True))


def witness(
    held: Problem, plain: Problem, data: Any, *, steps: int = 25, start: Mapping[str, Any] | None = None
) -> dict[str, Any] | None:
    """Point X, K, eps, r whose rounding satisfies `plain` with X, Y = K X and K in all boxes; None if not found.

    Successive linearisation of Y = K X, every step tried exactly: from the point of `gain_point` with boxes shrunk to
    0.98 and long steps first, or from a nearby witness `start` with short steps and hardly shrunk boxes.
    """
    X, K = (start["X"], start["K"]) if start else gain_point(data)[1:]
    for step in range(steps):
        trust, shrink = (0.3, 0.998) if start else (2.0 if step < steps // 2 else 0.3, 0.98)
        found = solve(held, data, Link((X, K), trust), shrink=shrink)
        if found.margin is None:
            return None
        X, K = found.point["X"], found.point["K"]
        point = {name: found.point[name] for name in ("X", "K", "eps", "r")}
        if found.margin > 0 and certify(plain, data, point) is not None:
            return point
    return None


def certify(plain: Problem, data: Any, point: Mapping[str, Any], says: str = "") -> dict[str, Any] | None:
    """Membership certificate at the rounded point with Y := K X exactly, or None if it leaves a box or a condition."""
    X, K = rounded_print((point["X"] + point["X"].T) / 2, point["K"])
    Y = K @ X
    if not all(inside(M, data[name], data.half(name)) for name, M in (("X", X), ("Y", Y), ("K", K))):
        return None
    target = linked(plain, data)
    for factor in (1.0, 0.9997, 1.0003, 0.999, 1.001):
        eps = rational.rounded(point["eps"] * factor, 17)
        exact = {"X": X, "Y": Y, "K": K, "eps": eps * rational.identity(6), "r": rational.rounded(point["r"], 24)}
        try:
            return proof.prove_feasible(target, exact, statement="membership", says=says)
        except proof.NotProvenError:
            continue
    return None
