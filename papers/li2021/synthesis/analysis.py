"""Analysis of the printed controllers: poles, modes, norms, rounding boxes, coordinates of [39], structure."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.claims.printed import Printed
from recontrol.exact.ball import box
from recontrol.exact.rational import to_float
from recontrol.spacecraft.flexible import rigid_part
from recontrol.systems.generic import inverse
from recontrol.systems.norms import hinf_norm_float
from recontrol.systems.output_feedback import Controller, closed_loop, structured_coordinates
from recontrol.systems.regions import disk_radius, prove_in_disk

from ..plant import PRINTED, controller, controller_box, float_controller, floats, loop, plant
from ..problems import lemma
from .solving import least_gamma

Array = np.ndarray
RADII = ("1", "0.9", "0.8")
ROUNDED = ("J0", "F", "orbital_rate")


def analysis(data: Any, model: Any) -> dict[str, Any]:
    """Artifact: ``loops`` by controller, ``open`` loop, ``ref39-structured`` coordinates, ``structure``."""
    p = floats(plant(data))
    return {
        "loops": {name: _loop(data, p, name) for name in PRINTED},
        "open": {
            "rigid": np.linalg.eigvals(p["A"]),
            "flexible": np.linalg.eigvals(np.asarray(model["flexible"]["A"])),
            "mode": slow_mode(np.linalg.eigvals(np.asarray(model["flexible"]["A"]))),
            "mode-zeta3": slow_mode(np.linalg.eigvals(_flexible(data, 0.0064)[0])),
        },
        "ref39-structured": _reference_coordinates(data),
        "structure": _structure(data, p),
    }


def _flexible(data: Any, zeta3: float | None = None) -> tuple[Array, Array]:
    from recontrol.spacecraft.flexible import linear_model

    zeta = np.ravel(data.float("damping_ratio"))
    if zeta3 is not None:
        zeta[2] = zeta3
    inertia, frequency = np.ravel(data.float("J0")), np.ravel(data.float("modal_frequency"))
    return linear_model(inertia, data.float("F"), frequency, zeta, data.float("orbital_rate"))


def slow_mode(poles: Array) -> complex:
    """Least damped pole that oscillates faster than 0.1 rad/s, the member with positive imaginary part."""
    fast = poles[poles.imag > 0.1]
    return complex(fast[np.argmax(fast.real)])


def _loop(data: Any, p: dict[str, Array], name: str) -> dict[str, Any]:
    """Everything about one printed controller."""
    c = float_controller(controller(data, name))
    a = data.float("disk_a")
    m = floats(loop(plant(data), controller(data, name)))
    A, B, C = m["A"], m["B"], m["C"]
    flexible = {k: _flexible_loop(*_flexible(data, zeta), c) for k, zeta in (("printed", None), ("zeta3", 0.0064))}
    F, inputs = flexible["printed"]
    poles, modes = np.linalg.eigvals(A), np.linalg.eigvals(F)
    outputs = np.hstack([np.eye(3), np.zeros((3, len(F) - 3))])
    zero = np.zeros((3, 3))
    sweep = np.concatenate([[0.0], np.logspace(-4, 2, 3000)])
    return {
        "poles": poles,
        "radius": float(disk_radius(poles, a)),
        "abscissa": float(poles.real.max()),
        "flexible-poles": modes,
        "flexible-radius": float(disk_radius(modes, a)),
        "flexible-abscissa": float(modes.real.max()),
        "mode": slow_mode(modes),
        "mode-zeta3": slow_mode(np.linalg.eigvals(flexible["zeta3"][0])),
        "static-gain": float(np.linalg.norm(C @ np.linalg.solve(A, B), 2)),
        "hinf": hinf_norm_float(A, B, C, zero),
        "hinf-sweep": _sweep(A, B, C, sweep),
        "hinf-flexible": hinf_norm_float(F, inputs, outputs, zero),
        "hinf-flexible-sweep": _sweep(F, inputs, outputs, sweep),
        "reversed-abscissa": float(np.linalg.eigvals(closed_loop(p["A"], p["B"], p["C"], c, sign=-1)).real.max()),
        "rounding": _rounding(data, name, a),
    }


def _flexible_loop(A: Array, B: Array, c: Controller) -> tuple[Array, Array]:
    """Flexible loop (20, 20) and its torque input (20, 3)."""
    C = np.hstack([np.eye(3), np.zeros((3, len(A) - 3))])
    return closed_loop(A, B, C, c), np.vstack([B, np.zeros((6, 3))])


def _sweep(A: Array, B: Array, C: Array, omega: Array) -> float:
    s = 1j * omega[:, None, None] * np.eye(len(A)) - A
    return float(np.linalg.norm(C @ np.linalg.solve(s, B[None].astype(complex)), 2, axis=(1, 2)).max())


def halves(data: Any, name: str) -> Array:
    """Half units of the last printed places, also of exact data."""
    return Printed.parse(data.text(name)).halves


def boxed_loop(data: Any, name: str) -> Array:
    """Ball matrix (12, 12): every rigid loop whose controller and plant round to the print."""
    parts = [box(np.atleast_2d(np.array(data[k], dtype=object)), halves(data, k)) for k in ROUNDED]
    A, B, _ = rigid_part(parts[0], parts[1], parts[2][0, 0])
    C = plant(data)["C"]
    return closed_loop(A, B, C, controller_box(data, name))


def _rounding(data: Any, name: str, a: float) -> dict[str, Any]:
    """Worst pole distance over the rounding box: linearised, 500 random draws, and radii proven for all of it."""
    names = [*ROUNDED, *(f"{k}_f{'' if name == 'proposed' else '39'}" for k in "ABC")]
    values = [np.atleast_2d(data.float(k)).astype(float) for k in names]
    half = [to_float(halves(data, k)) for k in names]
    draws = np.random.default_rng(0)
    found = [_radius([v + h * draws.uniform(-1, 1, v.shape) for v, h in zip(values, half, strict=True)], a)
             for _ in range(500)]  # fmt: skip
    A = boxed_loop(data, name)
    return {
        "linearised": _linearised(values, half, a),
        "random": float(max(found)),
        "proven": {r: prove_in_disk(A, data["disk_a"], r) is not None for r in RADII},
    }


def _assemble(values: list[Array]) -> Array:
    """Rigid loop of float J0, F, n, A_f, B_f, C_f."""
    A, B, _ = rigid_part(values[0], values[1], values[2][0, 0])
    return closed_loop(A, B, np.hstack([np.eye(3), np.zeros((3, 3))]), Controller(*values[3:]))


def _radius(values: list[Array], a: float) -> float:
    return float(disk_radius(np.linalg.eigvals(_assemble(values)), a))


def _linearised(values: list[Array], half: list[Array], a: float) -> float:
    """Largest distance plus the sum of the moduli of its first-order changes over the box, over all poles."""
    A = _assemble(values)
    poles, V = np.linalg.eig(A)
    W = np.linalg.inv(V)
    growth = np.zeros(len(poles))
    for k, h in enumerate(half):
        for index in np.ndindex(h.shape):
            moved = [v.copy() for v in values]
            moved[k][index] += h[index]
            change = np.diagonal(W @ (_assemble(moved) - A) @ V)
            growth += np.abs((np.conj(poles + a) / np.abs(poles + a) * change).real)
    return float((np.abs(poles + a) + growth).max())


def _reference_coordinates(data: Any) -> dict[str, Array]:
    """[39] in coordinates where the P of (12), lambda = 1, least gamma, reads [[Y, N], [N, -N]]."""
    _, solution = least_gamma(lemma(data, "loop-ref39", structured=False, best=True))
    c = structured_coordinates(np.asarray(solution.point["P"]), float_controller(controller(data, "ref39")))
    return c._asdict()


def _structure(data: Any, p: dict[str, Array]) -> dict[str, Any]:
    """Residual of A_f against the observer form A0 - B_f C + B C_f, and M0^-1 C_f."""
    c = float_controller(controller(data, "proposed"))
    observer = p["A"] - c.B @ p["C"] + p["B"] @ c.C
    return {
        "observer-residual": float(np.linalg.norm(c.A - observer) / np.linalg.norm(c.A)),
        "acceleration-gain": inverse(p["M0"]) @ c.C,
    }
