r"""Attitude of a rigid spacecraft on a circular orbit: Euler's equations, gravity gradient, LVLH linearisation.

Frames: the LVLH frame has x along the velocity, y against the orbit normal and z to the Earth's centre, so it turns at
``(0, -orbital_rate, 0)``. The body attitude is the 3-2-1 sequence yaw, pitch, roll; ``angles = (roll, pitch, yaw)``.
The principal axes are the body axes; ``inertia = (Ix, Iy, Iz)`` [kg m^2].

Every function of the nonlinear model works on floats and on sympy expressions alike (argument ``trig`` chooses the
module that supplies ``sin`` and ``cos``), so the symbolic linearisation and the simulation share one model.

Source: Wie, Space Vehicle Dynamics and Control, 2nd ed., sections 5.1, 6.10; Hughes, Spacecraft Attitude Dynamics, 9.1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

Vector = Sequence[Any]


def cross(a: Vector, b: Vector) -> list[Any]:
    """Cross product of two 3-vectors of any scalar type."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def euler_torque(inertia: Vector, rate: Vector, acceleration: Vector) -> list[Any]:
    """Torque ``J w' + w x J w`` that principal inertias need for a given motion [N m].

    Parameters: ``rate`` [rad/s] and ``acceleration`` [rad/s^2] in body axes, three entries each.
    """
    gyroscopic = cross(rate, [j * w for j, w in zip(inertia, rate, strict=True)])
    return [j * a + g for j, a, g in zip(inertia, acceleration, gyroscopic, strict=True)]


def euler_acceleration(inertia: Vector, rate: Vector, torque: Vector) -> list[Any]:
    """Angular acceleration of Euler's equations under a body torque [rad/s^2]; inverse of `euler_torque`."""
    gyroscopic = cross(rate, [j * w for j, w in zip(inertia, rate, strict=True)])
    return [(t - g) / j for j, t, g in zip(inertia, torque, gyroscopic, strict=True)]


def lvlh_to_body(angles: Vector, trig: ModuleType = math) -> list[list[Any]]:
    """Direction cosine matrix of the 3-2-1 sequence, LVLH to body, as three rows."""
    s, c = trig.sin, trig.cos
    roll, pitch, yaw = angles
    return [
        [c(pitch) * c(yaw), c(pitch) * s(yaw), -s(pitch)],
        [s(roll) * s(pitch) * c(yaw) - c(roll) * s(yaw), s(roll) * s(pitch) * s(yaw) + c(roll) * c(yaw),
         s(roll) * c(pitch)],
        [c(roll) * s(pitch) * c(yaw) + s(roll) * s(yaw), c(roll) * s(pitch) * s(yaw) - s(roll) * c(yaw),
         c(roll) * c(pitch)],
    ]  # fmt: skip


def body_rate(angles: Vector, angle_rates: Vector, orbital_rate: Any, trig: ModuleType = math) -> list[Any]:
    """Inertial angular rate in body axes [rad/s] of 3-2-1 angles relative to the LVLH frame."""
    s, c = trig.sin, trig.cos
    roll, pitch, _ = angles
    p, q, r = angle_rates
    relative = [
        p - s(pitch) * r,
        c(roll) * q + s(roll) * c(pitch) * r,
        -s(roll) * q + c(roll) * c(pitch) * r,
    ]
    dcm = lvlh_to_body(angles, trig)
    return [w - orbital_rate * row[1] for w, row in zip(relative, dcm, strict=True)]


def angle_rates(angles: Vector, rate: Vector, orbital_rate: Any, trig: ModuleType = math) -> list[Any]:
    """Time derivatives of the 3-2-1 angles from the body rate [rad/s]; inverse of `body_rate`.

    Singular at a pitch of 90 degrees: callers stop before it.
    """
    s, c = trig.sin, trig.cos
    roll, pitch, _ = angles
    dcm = lvlh_to_body(angles, trig)
    p, q, r = [w + orbital_rate * row[1] for w, row in zip(rate, dcm, strict=True)]
    yaw_rate = (s(roll) * q + c(roll) * r) / c(pitch)
    return [p + s(pitch) * yaw_rate, c(roll) * q - s(roll) * r, yaw_rate]


def gravity_gradient(inertia: Vector, angles: Vector, orbital_rate: Any, trig: ModuleType = math) -> list[Any]:
    """Gravity-gradient torque ``3 w0^2 c x J c`` in body axes [N m], ``c`` the direction of the Earth's centre."""
    c = [row[2] for row in lvlh_to_body(angles, trig)]
    arm = cross(c, [j * component for j, component in zip(inertia, c, strict=True)])
    return [3 * orbital_rate**2 * component for component in arm]


def rigid_attitude(inertia: Vector, orbital_rate: float) -> Callable[[Vector, Vector], list[float]]:
    """Nonlinear equations of motion as ``rhs(state, torque)``.

    The state is ``(roll, pitch, yaw, wx, wy, wz)`` with the inertial body rate [rad, rad/s]; ``torque`` is control plus
    disturbance [N m]; the gravity gradient is added inside. `body_rate` converts initial angle rates.
    """

    def rhs(state: Vector, torque: Vector) -> list[float]:
        angles, rate = state[:3], state[3:]
        total = [t + g for t, g in zip(torque, gravity_gradient(inertia, angles, orbital_rate), strict=True)]
        return [*angle_rates(angles, rate, orbital_rate), *euler_acceleration(inertia, rate, total)]

    return rhs


def lvlh_symbols() -> dict[str, Any]:
    """Symbols of the linearised model: ``inertia`` (3), ``orbital_rate``, ``angles`` (3) and ``rates`` (3)."""
    import sympy as sp

    return {
        "inertia": sp.symbols("Ix Iy Iz", positive=True),
        "orbital_rate": sp.Symbol("omega0", positive=True),
        "angles": sp.symbols("phi theta psi", real=True),
        "rates": sp.symbols("dphi dtheta dpsi", real=True),
    }


def linearised_gravity_gradient() -> Any:
    """First-order gravity-gradient torque, a 3x1 sympy matrix in the symbols of `lvlh_symbols`."""
    import sympy as sp

    s = lvlh_symbols()
    torque = sp.Matrix(gravity_gradient(s["inertia"], s["angles"], s["orbital_rate"], sp))  # type: ignore[arg-type]
    return _first_order(torque, list(s["angles"]))


def linearised_attitude() -> tuple[Any, Any, Any]:
    r"""Linear model about LVLH rest, derived from the nonlinear one: ``J q'' + G q' + S q = torque``.

    Returns ``(J, G, S)``, sympy 3x3 matrices in the symbols of `lvlh_symbols` with ``q = (roll, pitch, yaw)``.
    The derivation is Euler's equations along ``body_rate`` minus the full gravity gradient, expanded to first order.
    """
    import sympy as sp

    s = lvlh_symbols()
    time = sp.Symbol("t")
    functions = [sp.Function(f"q{i}")(time) for i in range(3)]
    accelerations = sp.symbols("ddphi ddtheta ddpsi", real=True)
    velocities = [sp.diff(f, time) for f in functions]
    rate = body_rate(functions, velocities, s["orbital_rate"], sp)  # type: ignore[arg-type]
    torque = sp.Matrix(euler_torque(s["inertia"], rate, [sp.diff(w, time) for w in rate])) - sp.Matrix(
        gravity_gradient(s["inertia"], functions, s["orbital_rate"], sp)  # type: ignore[arg-type]
    )
    for v, a in zip(velocities, accelerations, strict=True):
        torque = torque.subs(sp.diff(v, time), a)
    for v, dq in zip(velocities, s["rates"], strict=True):
        torque = torque.subs(v, dq)
    for f, q in zip(functions, s["angles"], strict=True):
        torque = torque.subs(f, q)
    unknowns = [*accelerations, *s["rates"], *s["angles"]]
    linear = torque.jacobian(unknowns).subs(dict.fromkeys(unknowns, 0)).applyfunc(sp.expand)
    return linear[:, 0:3], linear[:, 3:6], linear[:, 6:9]


def lvlh_state_matrix() -> Any:
    """State matrix (6x6, sympy) of ``x = (q, q')`` for the linear model of `linearised_attitude`."""
    import sympy as sp

    mass, gyroscopic, stiffness = linearised_attitude()
    inverse = mass.inv()
    top = sp.Matrix.hstack(sp.zeros(3), sp.eye(3))
    return sp.Matrix.vstack(top, sp.Matrix.hstack(-inverse * stiffness, -inverse * gyroscopic)).applyfunc(sp.factor)


def _first_order(expression: Any, unknowns: list[Any]) -> Any:
    import sympy as sp

    origin = dict.fromkeys(unknowns, 0)
    return (expression.jacobian(unknowns).subs(origin) * sp.Matrix(unknowns)).applyfunc(sp.expand)
