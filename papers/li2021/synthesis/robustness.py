"""Vertices of gain drift and inertia error in floats, and scaled inequalities that stand for all of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.lmi.conditions import minimise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import diagonal, symmetric
from recontrol.systems.output_feedback import Controller, drifted
from recontrol.systems.regions import disk_radius
from recontrol.systems.vertices import sign_vertices, threshold, worst_each

from .. import conditions
from ..loops import flexible_loops, flexible_plants, gain, rigid_family
from ..plant import PRINTED, controller, float_controller, floats, plant
from ..problems import build, scalar
from .solving import point, relaxed

Array = np.ndarray
CORNERS = {"nominal": (0.0, 0.0, 0.0), "minus": (-1.0, -1.0, -1.0), "plus": (1.0, 1.0, 1.0)}


def vertices(data: Any) -> dict[str, Any]:
    """Worst cases over 2^15 vertices, limits of the drift, and 4000 interior points, for both controllers."""
    p = floats(plant(data))
    return {name: _worst_cases(data, p, float_controller(controller(data, name))) for name in PRINTED}


def _worst_cases(data: Any, p: dict[str, Array], c: Controller) -> dict[str, Any]:
    bound, a, b = data.float("drift_bound"), data.float("disk_a"), data.float("disk_b")
    corners = sign_vertices(15)
    plants, inputs = flexible_plants(data, sign_vertices(3))
    C = np.hstack([p["C"], np.zeros((3, 6))])

    def rigid(v: Array) -> tuple[Array, Array]:
        return rigid_family(p, drifted(c, bound * v[:, 3:]), v[:, :3])

    def flexible(v: Array) -> Array:
        which = ((v[:, :3] > 0) @ np.array([4, 2, 1])).astype(int)
        return np.linalg.eigvals(flexible_loops(plants[which], inputs[which], drifted(c, bound * v[:, 3:])))

    def all_of(v: Array) -> dict[str, Array]:
        A, B = rigid(v)
        poles = np.linalg.eigvals(A)
        return {"radius": disk_radius(poles, a), "abscissa": poles.real.max(axis=1), "static-gain": gain(A, B, C)}

    found = worst_each(all_of, corners)
    found |= worst_each(lambda v: {"flexible-abscissa": flexible(v).real.max(axis=1)}, corners)
    interior = np.random.default_rng(5).uniform(-1, 1, (4000, 15))
    found["interior-radius"] = worst_each(all_of, interior)["radius"]
    return {name: worst.value for name, worst in found.items()} | {"limits": _limits(p, c, a, b)}


def _limits(p: dict[str, Array], c: Controller, a: float, b: float) -> dict[str, Any]:
    """delta_m at which a gain vertex leaves the disk or stability, at three inertia corners (bracket to 1e-4)."""
    signs = sign_vertices(12)
    delta = np.repeat(np.array(list(CORNERS.values())), len(signs), axis=0)
    gains = np.tile(signs, (len(CORNERS), 1))

    def excess(which: Array, size: float, disk: bool) -> Array:
        poles = np.linalg.eigvals(rigid_family(p, drifted(c, size * gains[which]), delta[which])[0])
        return disk_radius(poles, a) - b if disk else poles.real.max(axis=1)

    def limit(disk: bool, high: float) -> list[float]:
        everything = np.arange(len(gains))
        low, high = threshold(lambda size: excess(everything, size, disk).max() >= 0, 0.0, high, 0.08)
        # The vertices that leave first are among the worst at the coarse end; all are asked again at the result.
        leading = np.argsort(excess(everything, high, disk))[-400:]
        low, high = threshold(lambda size: excess(leading, size, disk).max() >= 0, low, high, 1e-4)
        if excess(everything, low, disk).max() >= 0:
            raise RuntimeError("a vertex outside the leading ones leaves first: keep more of them")
        return [low, high]

    return {"disk": limit(True, 0.5), "stability": limit(False, 0.9)}


def channel_count(data: Any, case: str) -> int:
    """Number of uncertain scalars of a case."""
    from ..problems import problem_data

    return problem_data(data, case)["Bp"].shape[1]


def disk_problem(data: Any, case: str) -> Problem:
    """Scaled disk inequality of a case, as a feasibility problem in P and Lam."""
    variables = {"P": symmetric(12), "Lam": diagonal(channel_count(data, case))}
    return replace(build(data, "scaled-disk", case, [conditions.robust_disk], variables, balanced=False), units={})


def hinf_problem(data: Any, case: str) -> Problem:
    """Least gamma^2 of the scaled bounded-real inequality of a case."""
    variables = {"P": symmetric(12), "Lam": diagonal(channel_count(data, case)), "gamma2": scalar()}
    return replace(build(data, "scaled-hinf", case, [conditions.robust_hinf], variables, best=True), units={"P": "10"})


def below_one(P: Any) -> Any:
    """P - I, which normalises the homogeneous disk inequality."""
    from recontrol.lmi.blocks import eye

    return P - eye(12)


def disk_margin(data: Any, case: str) -> tuple[float, dict[str, Array]]:
    """Least t of ``scaled_disk <= t I, P <= I`` and its P, Lam. A negative t proves the disk up to rounding."""
    from recontrol.lmi.conditions import condition

    base = disk_problem(data, case)
    chosen = [condition(relaxed(conditions.robust_disk), "disk", sense="<"), condition(below_one, "unit", sense="<=")]
    problem = Problem(
        "scaled-disk", {**base.variables, "t": scalar()}, chosen, base.data, minimise(lambda t: t), balanced=False
    )
    x = point(problem.solve())
    return float(x["t"]), {"P": x["P"], "Lam": x["Lam"]}


def scaled(data: Any) -> dict[str, Any]:
    """Points of the scaled inequalities: disk for gain drift, how far with Delta J, least gamma at three drifts."""
    margin, found = disk_margin(data, "gains-proposed")
    reached, refused = threshold(
        lambda size: disk_margin(data, f"gains-J-proposed;delta_m={size:.6f}")[0] > -1e-7, 0.03, 0.045, 1e-3
    )
    gammas, points = {}, {}
    for drift in ("0", "0.02", "0.05"):
        solution = hinf_problem(data, f"all-proposed;delta_m={drift}").solve()
        x = point(solution)
        gammas[drift] = float(np.sqrt(x["gamma2"]))
        points[drift] = {"P": x["P"], "Lam": x["Lam"]}
    return {
        "disk": {"margin": margin, **found},
        "disk-with-inertia": {"reached": reached, "refused": refused},
        "hinf": {"gamma": gammas, "points": points},
    }
