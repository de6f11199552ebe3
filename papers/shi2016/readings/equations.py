"""Section 2: Euler's equations, gravity gradient, the linear model and its matrices, against the nonlinear model."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Identity, Result, Statement
from recontrol.spacecraft import attitude

from .. import plant


def _s() -> dict[str, Any]:
    return attitude.lvlh_symbols()


def euler() -> Identity:
    """(1): left sides against J w' + w x J w."""
    import sympy as sp

    ix, iy, iz = _s()["inertia"]
    wx, wy, wz, ax, ay, az = sp.symbols("wx wy wz ax ay az")
    printed = (ix * ax + (iz - iy) * wy * wz, iy * ay + (ix - iz) * wz * wx, iz * az + (iy - ix) * wx * wy)
    return Identity(printed, tuple(attitude.euler_torque((ix, iy, iz), (wx, wy, wz), (ax, ay, az))))


def gravity_x() -> Identity:
    """First component of the printed gravity-gradient torque."""
    s = _s()
    _, iy, iz = s["inertia"]
    return Identity(-3 * s["orbital_rate"] ** 2 * (iy - iz) * s["angles"][0], attitude.linearised_gravity_gradient()[0])


def _gravity_y(angle: int) -> Identity:
    s = _s()
    ix, _, iz = s["inertia"]
    printed = -3 * s["orbital_rate"] ** 2 * (ix - iz) * s["angles"][angle]
    return Identity(printed, attitude.linearised_gravity_gradient()[1])


def gravity_y_printed() -> Identity:
    """Second component with phi, as printed."""
    return _gravity_y(0)


def gravity_y_theta() -> Identity:
    """Second component with theta."""
    return _gravity_y(1)


def gravity_z() -> Identity:
    """Third component: zero."""
    import sympy as sp

    return Identity(sp.Integer(0), attitude.linearised_gravity_gradient()[2])


def _row(axis: int) -> tuple[Any, Any, Any, Any]:
    """(acceleration, rates, angles, left side) of one line of J q'' + G q' + S q from the nonlinear model."""
    import sympy as sp

    s = _s()
    acceleration = sp.symbols("ddphi ddtheta ddpsi", real=True)
    mass, gyroscopic, stiffness = attitude.linearised_attitude()
    rates, angles = sp.Matrix(s["rates"]), sp.Matrix(s["angles"])
    left = mass * sp.Matrix(acceleration) + gyroscopic * rates + stiffness * angles
    return acceleration, s["rates"], s["angles"], left[axis]


def roll() -> Identity:
    """First line of (2)."""
    s = _s()
    (ix, iy, iz), w = s["inertia"], s["orbital_rate"]
    acc, rates, angles, left = _row(0)
    return Identity(ix * acc[0] + 4 * (iy - iz) * w**2 * angles[0] + (iy - iz - ix) * w * rates[2], left)


def pitch() -> Identity:
    """Second line of (2)."""
    s = _s()
    (ix, iy, iz), w = s["inertia"], s["orbital_rate"]
    acc, _, angles, left = _row(1)
    return Identity(iy * acc[1] + 3 * w**2 * (ix - iz) * angles[1], left)


def _coefficient(line: Any, variable: Any) -> Any:
    import sympy as sp

    return sp.expand(line).coeff(variable)


def _yaw(inertia: Any, stiffness: Any, which: str) -> Identity:
    import sympy as sp

    acc, _, angles, left = _row(2)
    if which == "inertia":
        return Identity(inertia, _coefficient(left, acc[2]))
    return Identity(sp.expand(stiffness), _coefficient(left, angles[2]))


def yaw_inertia_printed() -> Identity:
    """Third line of (2): Ix before the acceleration."""
    return _yaw(_s()["inertia"][0], None, "inertia")


def yaw_inertia_iz() -> Identity:
    """The same with Iz."""
    return _yaw(_s()["inertia"][2], None, "inertia")


def yaw_stiffness_printed(data: Any) -> Result:
    """Third line of (2): (Iy - Iz) omega0^2; evidence: what A(6,3) and A(6,4) would be with the line as printed."""
    s = _s()
    _, iy, iz = s["inertia"]
    ix0, iy0, iz0 = plant.inertias(data)
    rate = plant.orbital_rate(data)
    evidence = {
        "A(6,3) of the matrix A": -(iy0 - ix0) * rate**2 / iz0,
        "A(6,3) from (2) as printed": -(iy0 - iz0) * rate**2 / ix0,
        "A(6,3) from (2) with Iz psi'' only": -(iy0 - iz0) * rate**2 / iz0,
        "A(6,4) of the matrix A": (iy0 - ix0 - iz0) * rate / iz0,
        "A(6,4) from (2) as printed": (iy0 - ix0 - iz0) * rate / ix0,
    }
    return Result(_yaw(None, (iy - iz) * s["orbital_rate"] ** 2, "stiffness"), evidence)


def yaw_stiffness_ix() -> Identity:
    """The same with (Iy - Ix)."""
    s = _s()
    ix, iy, _ = s["inertia"]
    return _yaw(None, (iy - ix) * s["orbital_rate"] ** 2, "stiffness")


def _printed_rows() -> Any:
    """The rows that A and C1 of (3) share, times J: as printed."""
    import sympy as sp

    s = _s()
    (ix, iy, iz), w = s["inertia"], s["orbital_rate"]
    return sp.Matrix(
        [
            [-4 * w**2 * (iy - iz), 0, 0, 0, 0, -w * (iy - ix - iz)],
            [0, -3 * w**2 * (ix - iz), 0, 0, 0, 0],
            [0, 0, -(w**2) * (iy - ix), w * (iy - ix - iz), 0, 0],
        ]
    )


def state_matrix() -> Identity:
    """A of (3), B1 = B2 being [0; J^{-1}]."""
    import sympy as sp

    inertia = sp.diag(*_s()["inertia"])
    printed = sp.Matrix.vstack(sp.Matrix.hstack(sp.zeros(3), sp.eye(3)), inertia.inv() * _printed_rows())
    return Identity(printed, attitude.lvlh_state_matrix())


def output_matrix(data: Any) -> Identity:
    """C1 x + D1 u + D2 d of (3) equals z_weight J q'' along the linear model."""
    import sympy as sp

    s = _s()
    state = sp.Matrix([*s["angles"], *s["rates"]])
    torque, disturbance = sp.Matrix(sp.symbols("u1:4")), sp.Matrix(sp.symbols("d1:4"))
    weight = sp.Rational(int(data["z_weight"].p), int(data["z_weight"].q))
    printed = weight * (_printed_rows() * state + torque + disturbance)
    inertia = sp.diag(*s["inertia"])
    acceleration = attitude.lvlh_state_matrix()[3:, :] * state + inertia.inv() * (torque + disturbance)
    return Identity(printed, weight * inertia * acceleration)


def least_gamma(data: Any, synthesis: Any) -> Result:
    """No gamma is printed; the gain at infinite frequency is that of D2, so gamma_inf > z_weight is necessary for (8).

    For any X and W, (8) contains [-gamma, D2; D2', -gamma] on each axis; at gamma = z_weight its determinant vanishes.
    """
    from recontrol.exact.rational import identity

    from .. import conditions

    si = plant.matrices(data, plant.exact_rate(data))
    level, zero = data["z_weight"], 0 * data["K_ext"]
    plants = {name: si[name] for name in ("A", "B1", "B2", "C1", "D1", "D2")}
    pair = conditions.brl(identity(6), zero, **plants, gamma=level)[np.ix_([6, 9], [6, 9])]
    found = {
        f"H-infinity norm, K_{gain}, lower bound": synthesis["norms"][plant.DEFAULT][gain]["hinf"]["lower"]
        for gain in plant.GAINS
    }
    determinant = pair[0, 0] * pair[1, 1] - pair[0, 1] * pair[1, 0]
    found["determinant of the block of d and z of (8) at 1e-3 (must be positive)"] = determinant
    return Result(level, {"gamma_inf must exceed": level} | found)


def definition2(synthesis: Any) -> Result:
    """Definition 2 literally, the trace of the matrix root, must equal the norm that Lemma 2 computes."""
    margins, evidence = {}, {}
    for gain in plant.GAINS:
        norms = synthesis["norms"][plant.DEFAULT][gain]
        margins[f"K_{gain}"] = -abs(norms["trace_of_root"] - norms["h2"])
        evidence |= {f"trace of the root, K_{gain}": norms["trace_of_root"], f"H2 norm, K_{gain}": norms["h2"]}
    return Result(Statement(margins, strict=False), evidence)


def definition2_root(synthesis: Any) -> Statement:
    """The root of the trace, from the observability equation, against Lemma 2's norm from the controllability
    equation."""
    return Statement(
        {
            f"K_{gain}": arb(fmpq(1, 10**12)) - abs(found["h2_dual"] - found["h2"])
            for gain, found in synthesis["norms"][plant.DEFAULT].items()
        }
    )
