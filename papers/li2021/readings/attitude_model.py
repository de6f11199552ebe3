"""Sections II.A and II.B: orbit, direction cosines, linear model, uncertainty factors, elimination of the modes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import product
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Identity, Result, Statement
from recontrol.exact.ball import precision
from recontrol.exact.rational import identity, zeros
from recontrol.spacecraft.flexible import linear_model, orbital_matrices
from recontrol.systems.generic import diag, inverse

from ..plant import DELTA_D, DELTA_G, controller, factors, inertia_envelope, plant
from .support import lacking

Array = np.ndarray


def n_from_day(data: Any) -> arb:
    """2 pi / 24 h [rad/s]."""
    with precision(128):
        return 2 * arb.pi() / (data["orbit_period"] * 3600)


def n_from_radius(data: Any) -> arb:
    """sqrt(GM / r^3) [rad/s]."""
    with precision(128):
        return arb(data["gm_earth"] / data["orbit_radius"] ** 3).sqrt()


def period(data: Any) -> arb:
    """Kepler's period of the radius [h]."""
    with precision(128):
        return 2 * arb.pi() / n_from_radius(data) / 3600


def _sequence() -> tuple[tuple[Any, Any, Any], Any]:
    """R1(phi), R2(theta), R3(psi) in sympy, and the angles."""
    import sympy as sp

    phi, theta, psi = sp.symbols("phi theta psi", real=True)
    s, c = sp.sin, sp.cos
    R1 = sp.Matrix([[1, 0, 0], [0, c(phi), s(phi)], [0, -s(phi), c(phi)]])
    R2 = sp.Matrix([[c(theta), 0, -s(theta)], [0, 1, 0], [s(theta), 0, c(theta)]])
    R3 = sp.Matrix([[c(psi), s(psi), 0], [-s(psi), c(psi), 0], [0, 0, 1]])
    return (R1, R2, R3), (phi, theta, psi)


def _rotations() -> tuple[Any, Any]:
    """R1(phi) R2(theta) R3(psi) in sympy, and the angles."""
    (R1, R2, R3), angles = _sequence()
    return R1 * R2 * R3, angles


def _printed_column() -> Any:
    """Vector behind n in (4): the second column of the direction cosines, as printed there."""
    import sympy as sp

    phi, theta, psi = sp.symbols("phi theta psi", real=True)
    s, c = sp.sin, sp.cos
    return sp.Matrix(
        [
            c(theta) * s(psi),
            s(phi) * s(theta) * s(psi) + c(phi) * c(psi),
            c(phi) * s(theta) * s(psi) - s(phi) * c(psi),
        ]
    )


def _printed_entry(last: str) -> Any:
    """Entry (3,2) of (2): -s(phi) c(psi) + c(phi) s(theta) times the last factor."""
    import sympy as sp

    phi, theta, psi = sp.symbols("phi theta psi", real=True)
    factor = sp.cos(psi) if last == "cos" else sp.sin(psi)
    return -sp.sin(phi) * sp.cos(psi) + sp.cos(phi) * sp.sin(theta) * factor


def eq2_rotations() -> Identity:
    """(2) against the product of the three rotations."""
    R, _ = _rotations()
    return Identity(_printed_entry("cos"), R[2, 1])


def eq2_vector() -> Identity:
    """(2) against the vector in (4), whose last entry is the same direction cosine."""
    return Identity(_printed_entry("cos"), _printed_column()[2])


def eq2_sine() -> Identity:
    """With the sine of psi in the place of its cosine."""
    R, _ = _rotations()
    return Identity(_printed_entry("sin"), R[2, 1])


def _rates() -> tuple[Any, Any, Any]:
    """(3): body rates relative to LVLH, the angle rates, and n."""
    import sympy as sp

    phi, theta, _ = sp.symbols("phi theta psi", real=True)
    rates = sp.Matrix(sp.symbols("dphi dtheta dpsi", real=True))
    s, c = sp.sin, sp.cos
    T = sp.Matrix([[1, 0, -s(theta)], [0, c(phi), s(phi) * c(theta)], [0, -s(phi), c(phi) * c(theta)]])
    return T * rates, rates, sp.Symbol("n", positive=True)


def eq4_w() -> Identity:
    """(4) and its T(q) of (3), against rates about the axes of the rotation sequence and the orbit's turn seen in it.

    Each rotation adds its rate about its own axis, turned by those that follow: dphi e1 + R1 (dtheta e2 + R2 dpsi e3).
    """
    import sympy as sp

    (R1, R2, R3), _ = _sequence()
    relative, rates, n = _rates()
    e1, e2, e3 = (sp.eye(3)[:, k] for k in range(3))
    due = rates[0] * e1 + R1 * (rates[1] * e2 + R2 * (rates[2] * e3))
    return Identity(relative - n * _printed_column(), due - n * (R1 * R2 * R3 * e2))


def eq5() -> Identity:
    """First-order expansion of (4) in angles and rates."""
    import sympy as sp

    R, angles = _rotations()
    relative, rates, n = _rates()
    w = relative - n * R[:, 1]
    unknowns = [*angles, *rates]
    rest = dict.fromkeys(unknowns, 0)
    linear = w.subs(rest) + w.jacobian(unknowns).subs(rest) * sp.Matrix(unknowns)
    phi, _, psi = angles
    return Identity(linear, sp.Matrix([rates[0] - n * psi, rates[1] - n, rates[2] + n * phi]))


def eq6() -> Identity:
    """D, G and N of (6) against the Jacobian of the nonlinear equations; the modal terms are linear as they stand."""
    import sympy as sp

    from recontrol.spacecraft.attitude import body_rate, linearised_attitude, lvlh_symbols

    s = lvlh_symbols()
    _, rate_matrix, stiffness = linearised_attitude()
    J, n = s["inertia"], s["orbital_rate"]
    D, G, N = orbital_matrices(np.array(J, dtype=object), n)
    w = sp.Matrix(body_rate(s["angles"], s["rates"], n, sp))
    rest = dict.fromkeys([*s["angles"], *s["rates"]], 0)
    transport = w.jacobian(sp.Matrix(s["angles"])).subs(rest)
    return Identity([rate_matrix, stiffness, transport], [sp.Matrix(D), sp.Matrix(G), sp.Matrix(N)])


def _g0(printed: Callable[[Any, Any, Any], Any]) -> Identity:
    """A form of entry (3,3) in n, J1, J2, against G of (6) and against the Jacobian of the nonlinear model."""
    from recontrol.spacecraft.attitude import linearised_attitude, lvlh_symbols

    s = lvlh_symbols()
    J, n = s["inertia"], s["orbital_rate"]
    _, G, _ = orbital_matrices(np.array(J, dtype=object), n)
    _, _, stiffness = linearised_attitude()
    form = printed(n, J[0], J[1])
    return Identity([form, form], [G[2, 2], stiffness[2, 2]])


def g0_printed() -> Identity:
    """n^2 J20 - J10, as the text after (6) has it."""
    return _g0(lambda n, J1, J2: n**2 * J2 - J1)


def g0_parenthesis() -> Identity:
    """With a parenthesis around the difference of the inertias."""
    return _g0(lambda n, J1, J2: n**2 * (J2 - J1))


def _corners() -> list[Array]:
    """The vertices of |delta_i| <= 1, each (3,)."""
    return [np.array([fmpq(v) for v in corner], dtype=object) for corner in product((-1, 1), repeat=3)]


def sec2_factors(data: Any) -> Result:
    """Delta J, Delta D, Delta G from their factors, Delta A = L Delta_H K, and both norm bounds, at the eight vertices.

    The factors are multilinear in delta; Delta_H'Delta_H and e'e are convex in it: the vertices stand for the box. A
    bound counts by what its matrix, I - Delta_H'Delta_H or W0'W0 - (Delta J)^2 in q'', lacks to be >= 0: nothing.
    """
    p, f, left, right = plant(data), factors(data), [], []
    Mi, attained = inverse(p["M0"]), 0
    for d in _corners():
        J = np.ravel(data["J0"]) + d * inertia_envelope(data)
        D, G, _ = orbital_matrices(J, data["orbital_rate"])
        dJ, dD, dG = diag(J) - diag(data["J0"]), D - p["D"], G - p["G"]
        H_G, H_D = d[list(DELTA_G)], d[list(DELTA_D)]
        H = diag(np.concatenate([H_G, H_D]))
        left += [f["Xi_J"] @ diag(d), f["Xi_D"] @ diag(H_D) @ f["Gamma_D"], f["Xi_G"] @ diag(H_G) @ f["Gamma_G"]]
        right += [dJ, dD, dG]
        left.append(p["L"] @ H @ p["K"])
        right.append(np.vstack([zeros(3, 6), np.hstack([-Mi @ dG, -Mi @ dD])]))
        e = np.hstack([zeros(3, 3), dJ])
        room = p["W"].T @ p["W"] - e.T @ e
        left += [lacking(identity(len(H)) - H.T @ H), lacking(room)]
        right += [fmpq(0), fmpq(0)]
        attained += bool((room == 0).all())
    return Result(Identity(left, right), evidence={"vertices where the norm of e reaches its bound": attained})


def _eliminated(data: Any) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Rows of q'' of the full linear model (exact) and its input matrix, found through the 7 x 7 mass matrix."""
    args = (np.ravel(data["J0"]), data["F"], np.ravel(data["modal_frequency"]), np.ravel(data["damping_ratio"]))
    A, B = linear_model(*args, data["orbital_rate"])
    return A[7:10], B[7:10], plant(data)


def eq7_elim(data: Any) -> Identity:
    """A0 and B1 of (7) by elimination of eta'' from (6)."""
    A, B, p = _eliminated(data)
    angles, rates = [0, 1, 2], [7, 8, 9]
    return Identity([A[:, [*angles, *rates]], B], [p["A"][3:], p["B"][3:]])


def eq7_d_printed(data: Any) -> Identity:
    """ "B2 d": nothing of the modes may remain in q''."""
    A, _, _ = _eliminated(data)
    return Identity(A[:, [3, 4, 5, 6, 10, 11, 12, 13]], zeros(3, 8))


def eq7_d_tilde(data: Any) -> Identity:
    """ "B2 d~" with d~ = F' Cm eta' + F' Lambda eta + d."""
    A, _, p = _eliminated(data)
    w, z, F = np.ravel(data["modal_frequency"]), np.ravel(data["damping_ratio"]), data["F"]
    Mi = p["B"][3:]
    due = np.hstack([Mi @ F.T @ diag(w * w), Mi @ F.T @ diag(2 * z * w)])
    return Identity(A[:, [3, 4, 5, 6, 10, 11, 12, 13]], due)


def _deltas(data: Any) -> dict[str, Array]:
    """Every matrix that sections II and III write with a Delta, at delta_i = 1 and the full drift of the gains."""
    p, gains, drift = plant(data), controller(data, "proposed"), data["drift_bound"]
    J = np.ravel(data["J0"]) + inertia_envelope(data)
    D, G, _ = orbital_matrices(J, data["orbital_rate"])
    return {
        "Delta_J": identity(len(J)),
        "Delta_D": identity(len(DELTA_D)),
        "Delta_G": identity(len(DELTA_G)),
        "Delta H": identity(len(DELTA_G) + len(DELTA_D)),
        "Delta J": diag(J) - diag(data["J0"]),
        "Delta D": D - p["D"],
        "Delta G": G - p["G"],
        "Delta A": p["L"] @ p["K"],
        "Delta A_f": gains.A * drift,
        "Delta B_f": gains.B * drift,
        "Delta C_f": gains.C * drift,
    }


def _left_by_elimination(data: Any) -> Array:
    """What F'X has to be (3, modes) for the stiffness term F'X eta of d~: M0 times the part of q'' in eta."""
    A, _, p = _eliminated(data)
    return p["M0"] @ A[:, 3 : 3 + len(data["F"])]


def _stiffness(data: Any, candidates: Mapping[str, Array]) -> Statement:
    """Whether one of the matrices can stand in F'X eta.

    The margin is minus what the best of them is off: rows and columns if none has the order of eta, else entries.
    """
    F, due = data["F"], _left_by_elimination(data)
    off = {name: sum(abs(size - len(F)) for size in X.shape) for name, X in candidates.items()}
    fitting = [candidates[name] for name in candidates if off[name] == 0]
    if not fitting:
        return Statement({"rows and columns off, at best": fmpq(-min(off.values()))}, strict=False)
    return Statement({"entries of F'X off, at best": max(-abs(F.T @ X - due).max() for X in fitting)}, strict=False)


def eq7_delta(data: Any) -> Result:
    """The stiffness term of d~ with any Delta of the paper: none is of the order of eta."""
    deltas = _deltas(data)
    sizes = {name: " x ".join(map(str, X.shape)) for name, X in deltas.items()}
    return Result(_stiffness(data, deltas), evidence={"number of modes": len(data["F"]), "sizes": sizes})


def eq7_lambda(data: Any) -> Result:
    """With the stiffness matrix Lambda of (1): the term that the elimination leaves, exactly."""
    w, F, due = np.ravel(data["modal_frequency"]), data["F"], _left_by_elimination(data)
    needed = (F * due.T).sum(axis=1) / (F * F).sum(axis=1)
    return Result(_stiffness(data, {"Lambda": diag(w * w)}), evidence={"diagonal X that F'X eta needs [1/s^2]": needed})
