"""Section 2 and the orbit: rates, linearisation, sizes, delay, equilibrium."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.values import Identity, Result, Size, Statement

from .. import problems as pr


def s4_w_radius(model: Any) -> Any:
    """(gm / r^3)^(1/2) for r = 42241 km."""
    return model["rates"]["from_radius"]


def s4_w_period(model: Any) -> Any:
    """2 pi / 86400 s."""
    return model["rates"]["from_period"]


def s4_w_exponent(data: Any, model: Any) -> Result:
    """The digits with the exponent -3, and the orbit they belong to."""
    rates = model["rates"]
    return Result(data["w-print"], {"radius [km]": rates["radius_of_print"], "period [s]": rates["period_of_print"]})


def s4_w_literal() -> fmpq:
    """1.117 times 10.3."""
    return fmpq(1117, 1000) * fmpq(103, 10)


def s4_r_period(model: Any) -> Result:
    """Radius [km] of a 24 h orbit; a stellar day beside it."""
    rates = model["rates"]
    return Result(rates["radius_24h"], {"radius for 86164.1 s [km]": rates["radius_stellar"]})


def _jacobian(third: str) -> Any:
    """Jacobian (3, 6) at the origin of (1) without thrust; `third` is the coordinate in the third line."""
    import sympy as sp

    x, y, z, vx, vy, vz, w, r = sp.symbols("x y z vx vy vz w r", positive=True)
    gm = w**2 * r**3
    cube = ((r + x) ** 2 + y**2 + z**2) ** sp.Rational(3, 2)
    lines = [
        2 * w * vy + w**2 * (r + x) - gm * (r + x) / cube,
        -2 * w * vx + w**2 * y - gm * y / cube,
        -gm * {"y": y, "z": z}[third] / cube,
    ]
    states = (x, y, z, vx, vy, vz)
    origin = dict.fromkeys(states, 0)
    return sp.simplify(sp.Matrix(lines).jacobian(states).subs(origin))


def _linear() -> Any:
    """Right-hand sides of (2) without forces, as a matrix (3, 6)."""
    import sympy as sp

    w = sp.symbols("w", positive=True)
    return sp.Matrix([[3 * w**2, 0, 0, 0, 2 * w, 0], [0, 0, 0, -2 * w, 0, 0], [0, 0, -(w**2), 0, 0, 0]])


def eq1_print() -> Identity:
    """Third line of (1) as printed (y_c) against the third line of (2)."""
    return Identity(_jacobian("y")[2, :], _linear()[2, :])


def eq1_z() -> Identity:
    """The same with z_c."""
    return Identity(_jacobian("z")[2, :], _linear()[2, :])


def eq2() -> Identity:
    """All of (2) against the linearisation of the repaired (1)."""
    return Identity(_jacobian("z"), _linear())


def eq3_states(data: Any) -> Size:
    """A acts on x in R^6."""
    return Size(data["x0"].shape[1], data["x0"].shape[1])


def eq3_doubled(data: Any) -> Size:
    """One row more: the third is printed twice."""
    return Size(data["x0"].shape[1] + 1, data["x0"].shape[1])


def _instants() -> tuple[Any, Any, Any]:
    import sympy as sp

    return sp.symbols("t t_k t_next", real=True)


def eq15_print() -> Identity:
    """t - tau with the printed tau, against t_k."""
    t, t_k, t_next = _instants()
    return Identity(t - (t_next - t_k), t_k)


def eq15_age() -> Identity:
    """t - tau with tau = t - t_k, against t_k."""
    t, t_k, _ = _instants()
    return Identity(t - (t - t_k), t_k)


def eq14_e0(model: Any, case: str) -> Identity:
    """Integral part of the equilibrium for y_r, exact, against zero."""
    e = model["orbits"][case]["equilibrium"][6:, :]
    return Identity(e, e * 0)


def eq9_track(data: Any, model: Any, simulation: Any, case: str) -> Result:
    """Position part of the equilibrium, exact, against y_r."""
    residual = simulation["loops"]["values"]["metrics"][f"{case} hold none"]["residual"]
    found = model["orbits"][case]["equilibrium"][:3, :]
    return Result(Identity(found, data["y_r"].T), {f"|{axis} - y_r| after 150 s [m]": residual[axis] for axis in "xyz"})


def eq20_data(data: Any) -> Statement:
    """(20) needs d_bar of finite energy: minus the mean power of y_r and of the sines of sec. 4."""
    reference = sum((y * y for y in data["y_r"].flat), fmpq(0))
    return Statement({"minus mean power of y_r": -reference, "minus mean power of d": -3 * fmpq(2) ** 2 / 2})


def eq54_weight(data: Any) -> Identity:
    """gamma of (54) against gamma^2 of (20), (55), (57)."""
    return Identity(data["gamma"], data["gamma"] ** 2)


def eq55_shape(data: Any) -> Size:
    """T_1' (9, 9) can be followed by B1_bar, not by its transpose."""
    return Size(*pr.exact_data(data, "")["B1"].shape)


def s4_V0_dim(data: Any) -> Size:
    """P_1 (9, 9) stands between columns of nine entries."""
    return Size(pr.exact_data(data, "")["xi0"].shape[0], 1)


def eq36_shape() -> Size:
    """xi' and A_bar xi are columns."""
    return Size(9, 1)


def eq46_shape(data: Any) -> Size:
    """xi'(t_k) (1, 9) is followed by the transpose of the gain."""
    return Size(*np.transpose(data["K_bar"]).shape)


def eq13_shape() -> Size:
    """K_e acts on e in R^3 and gives three thrusts."""
    return Size(3, 3)


def cited() -> Identity:
    """Equations meant, against the numbers cited: the functional, the control law, the zero terms."""
    return Identity(_column([3, 2, 37]), _column([24, 7, 36]))


def _column(values: list[int]) -> np.ndarray:
    out = np.empty((len(values), 1), dtype=object)
    out[:, 0] = [fmpq(value) for value in values]
    return out
