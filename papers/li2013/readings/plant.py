"""Section 2 and the orbit: rates, linearisation, sizes, delay, equilibrium."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Approx, Identity, Result, Size, Statement
from recontrol.exact import rational
from recontrol.exact.ball import precision

from .. import problems as pr
from ..model import slow_pairs


def s4_w_radius(model: Any) -> Any:
    """(gm / r^3)^(1/2) for r = 42241 km."""
    return model["rates"]["from_radius"]


def s4_w_period(model: Any) -> Any:
    """2 pi / 86400 s."""
    return model["rates"]["from_period"]


PAIR_ERROR = 1e-7
"""Error of a pole [1/s]: a nearly double pole of a matrix of order 1 moves by the root of the rounding, 1.5e-8."""


def _factors(data: Any) -> tuple[fmpq, int]:
    """The printed digits and the exponent in the second factor "10.3", which has lost its sign."""
    mantissa, power = data.printed("w-text").rows[0]
    return mantissa.real.value, int(power.text.split(".")[1])


def _radius(data: Any, rate: fmpq) -> arb:
    """Radius [km] of the circular orbit with this rate [rad/s]: w^2 r^3 = gm."""
    with precision(128):
        return (arb(data["gm_earth"]) / rate**2) ** (arb(1) / 3)


def s4_w_exponent(data: Any) -> Result:
    """The exponent with a minus sign: the orbit lies outside the Earth, with a plus sign inside [km].

    And the published gain shows the rate: its slow in-plane pole pairs have more nearly equal real parts [1/s] than at
    the neighbouring powers of ten and at the rate of the printed radius and period.
    """
    digits, exponent = _factors(data)
    rate, split = digits / 10**exponent, slow_pairs(data)
    gain = rational.to_float(pr.exact_data(data, "block=xy")["K"])
    found = split(float(rate), gain)
    margins: dict[str, Any] = {
        "radius less that of the Earth": _radius(data, rate) - data["earth_radius"],
        "radius of the Earth less that with the exponent 3": data["earth_radius"]
        - _radius(data, digits * 10**exponent),
    }
    others = {"ten times the rate": rate * 10, "a tenth of it": rate / 10, "24 h": data["w-geo"]}
    for name, other in others.items():
        margins[f"pole pairs apart, {name}"] = Approx(split(float(other), gain) - found, PAIR_ERROR)
    with precision(128):
        period = 2 * arb.pi() / rate
    return Result(Statement(margins), {"radius [km]": _radius(data, rate), "period [s]": period})


def s4_w_literal(data: Any) -> Result:
    """The product of the two factors as the text has them: radius of its orbit less that of the Earth [km]."""
    first, second = data["w-text"][0]
    radius = _radius(data, first * second)
    return Result(Statement({"radius less that of the Earth": radius - data["earth_radius"]}), {"radius [km]": radius})


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
    disturbance = sum((a * a for a in data["sine"].flat), fmpq(0)) / 2
    return Statement({"minus mean power of y_r": -reference, "minus mean power of d": -disturbance})


def eq54_weight(data: Any) -> Identity:
    """gamma of (54) against gamma^2 of (20), (55), (57)."""
    return Identity(data["gamma"], data["gamma"] ** 2)


def eq55_shape(data: Any) -> Size:
    """T_1' (9, 9) can be followed by B1_bar, not by its transpose."""
    return Size(*pr.exact_data(data, "")["B1"].shape)


def s4_V0_dim(data: Any) -> Size:
    """P_1 (9, 9) stands between columns of nine entries."""
    return Size(pr.exact_data(data, "")["xi0"].shape[0], 1)


def eq36_shape(data: Any) -> Size:
    """The factor of (36) holds A_bar xi, a column."""
    exact = pr.exact_data(data, "")
    return Size(*(exact["A_print"] @ exact["xi0"]).shape)


def eq46_shape(data: Any) -> Size:
    """xi'(t_k) (1, 9) is followed by the transpose of the gain."""
    return Size(*np.transpose(data["K_bar"]).shape)


def eq13_shape(data: Any) -> Size:
    """K_e is what K_bar has beyond the gain of x: as many rows as thrusts, as many columns as e has entries."""
    return Size(*data["K_bar"][:, data["x0"].shape[1] :].shape)


def cited(data: Any) -> Identity:
    """Numbers of the equations cited, against those of the equations that are what the text calls them."""
    return Identity(data["cited"], data["cited_meant"])
