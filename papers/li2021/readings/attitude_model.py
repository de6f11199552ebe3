"""Sections II.A and II.B: orbit, direction cosines, linear model, uncertainty factors, elimination of the modes."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Identity, Result, Statement
from recontrol.exact.ball import precision
from recontrol.exact.rational import identity, zeros
from recontrol.spacecraft.flexible import linear_model, orbital_matrices
from recontrol.systems.generic import diag, inverse

from ..plant import DELTA_D, DELTA_G, factors, inertia_envelope, plant


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


def _rotations() -> tuple[Any, Any]:
    """R1(phi) R2(theta) R3(psi) in sympy, and the angles."""
    import sympy as sp

    phi, theta, psi = sp.symbols("phi theta psi", real=True)
    s, c = sp.sin, sp.cos
    R1 = sp.Matrix([[1, 0, 0], [0, c(phi), s(phi)], [0, -s(phi), c(phi)]])
    R2 = sp.Matrix([[c(theta), 0, -s(theta)], [0, 1, 0], [s(theta), 0, c(theta)]])
    R3 = sp.Matrix([[c(psi), s(psi), 0], [-s(psi), c(psi), 0], [0, 0, 1]])
    return R1 * R2 * R3, (phi, theta, psi)


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
    import sympy as sp

    phi, theta, psi = sp.symbols("phi theta psi", real=True)
    return Identity(_printed_entry("cos"), sp.cos(phi) * sp.sin(theta) * sp.sin(psi) - sp.sin(phi) * sp.cos(psi))


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
    """(4) against the rates of (3) minus n times the second column of the direction cosines."""
    import sympy as sp

    relative, _, n = _rates()
    phi, theta, psi = sp.symbols("phi theta psi", real=True)
    s, c = sp.sin, sp.cos
    printed = sp.Matrix(
        [
            c(theta) * s(psi),
            s(phi) * s(theta) * s(psi) + c(phi) * c(psi),
            c(phi) * s(theta) * s(psi) - s(phi) * c(psi),
        ]
    )
    R, _ = _rotations()
    return Identity(relative - n * printed, relative - n * R[:, 1])


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


def g0_printed() -> Identity:
    """n^2 J20 - J10, as the text after (6) has it, against entry (3,3) of G in (6)."""
    import sympy as sp

    n, J1, J2 = sp.symbols("n J10 J20", positive=True)
    return Identity(n**2 * J2 - J1, n**2 * (J2 - J1))


def g0_parenthesis() -> Identity:
    """With a parenthesis around the difference of the inertias."""
    import sympy as sp

    n, J1, J2 = sp.symbols("n J10 J20", positive=True)
    return Identity(n**2 * (J2 - J1), sp.expand(n**2 * J2 - n**2 * J1))


def _corners() -> list[tuple[int, int, int]]:
    return [(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]


def sec2_factors(data: Any) -> Identity:
    """Delta J, Delta D, Delta G from their factors, and Delta A = L Delta H K, exactly at the eight vertices."""
    p, f, left, right = plant(data), factors(data), [], []
    J0, n = np.ravel(data["J0"]), data["orbital_rate"]
    Mi = inverse(p["M0"])
    for corner in _corners():
        d = np.array([fmpq(v) for v in corner], dtype=object)
        J = J0 + d * inertia_envelope(data)
        D, G, _ = orbital_matrices(J, n)
        left += [f["Xi_J"] @ diag(d), f["Xi_D"] @ diag(d[list(DELTA_D)]) @ f["Gamma_D"]]
        left += [f["Xi_G"] @ diag(d[list(DELTA_G)]) @ f["Gamma_G"]]
        right += [diag(J) - diag(J0), D - p["D"], G - p["G"]]
        H = diag(np.concatenate([d[list(DELTA_G)], d[list(DELTA_D)]]))
        left.append(p["L"] @ H @ p["K"])
        right.append(np.vstack([zeros(3, 6), np.hstack([-Mi @ (G - p["G"]), -Mi @ (D - p["D"])])]))
    return Identity(left, right)


def sec2_bounds(data: Any) -> Result:
    """Delta_H' Delta_H <= I and |e| <= |W0 x'|: both are sums of squares with weights 1 - delta_i^2 >= 0."""
    margins = {}
    for corner in _corners():
        gap = [(1 - fmpq(v) ** 2) * s**2 for v, s in zip(corner, inertia_envelope(data), strict=True)]
        margins |= {f"{corner}, axis {k + 1}": value for k, value in enumerate(gap)}
    return Result(Statement(margins, strict=False), evidence={"vertices": len(_corners())})


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


def _stiffness_term(symbol: str) -> Any:
    import sympy as sp

    return (
        sp.Symbol("F'", commutative=False) * sp.Symbol(symbol, commutative=False) * sp.Symbol("eta", commutative=False)
    )


def eq7_delta(data: Any) -> Identity:
    """Stiffness term of d~ with a Delta, against that with the stiffness matrix of (1)."""
    return Identity(_stiffness_term("Delta"), _stiffness_term("Lambda"))


def eq7_lambda(data: Any) -> Result:
    """With Lambda: the stiffness term that the elimination leaves, exactly."""
    A, _, p = _eliminated(data)
    w, F = np.ravel(data["modal_frequency"]), data["F"]
    return Result(Identity(A[:, [3, 4, 5, 6]], p["B"][3:] @ F.T @ diag(w * w)), evidence={"order": len(identity(4))})
