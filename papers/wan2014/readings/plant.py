"""Section 2 and the data of section 4: the model, its factors, the mean motion, observability."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Approx, Identity, Result, Statement
from recontrol.spacecraft import orbit

from ..model import is_observable, rank


def _linearised(order: int) -> tuple[Any, Any]:
    """State matrix of the exact two-body equations at order 0 or 1 in e, and the printed one, as sympy matrices.

    Radius, radial rate and angular rate of the target are expanded from Kepler's equation: E = M + O(e).
    """
    import sympy as sp

    n, a, e, M = sp.symbols("n a e M", positive=True)
    state = sp.symbols("x y z vx vy vz", real=True)
    radius = a * (1 - e * sp.cos(M))
    h = n * a**2 * sp.sqrt(1 - e**2)
    motion = (radius, n * sp.diff(radius, M), h / radius**2)
    x, y, z = state[:3]
    cube = ((radius + x) ** 2 + y**2 + z**2) ** sp.Rational(3, 2)
    exact = orbit.relative_acceleration(state[:3], state[3:], *motion, n**2 * a**3, norm_cubed=cube)
    origin = dict.fromkeys(state, 0)
    jacobian = sp.Matrix(exact).jacobian(state).subs(origin)
    lower = jacobian.applyfunc(lambda f: sp.simplify(sp.diff(sp.simplify(f), e, order).subs(e, 0)))
    upper = sp.Matrix.hstack(sp.zeros(3), sp.eye(3) if order == 0 else sp.zeros(3))
    c, s = sp.cos(M), sp.sin(M)
    printed = orbit.clohessy_wiltshire(n) if order == 0 else orbit.near_circular(n, 1, c, s)
    return sp.Matrix.vstack(upper, lower), sp.Matrix(printed.tolist())


def eq2_A() -> Identity:
    """Linearised two-body motion at order 0 in the eccentricity, against A of (2)."""
    return Identity(*_linearised(0))


def eq2_dA() -> Identity:
    """The same at order 1, against Delta A of (2)."""
    return Identity(*_linearised(1))


def sec2_accuracy(simulation: Any) -> Result:
    """Distance to the two-body drift of the circular model less that of (1), at each time and mean motion [m]."""
    values = simulation["drift"]["values"]
    margins = {}
    for motion in ("n_orbit", "n_printed"):
        gain = np.asarray(values[f"{motion}_circular"]) - np.asarray(values[f"{motion}_near_circular"])
        for time, gap in zip(values["times"], gain, strict=True):
            # The integration is good to 1e-6 m.
            margins[f"{motion}, {time:.0f} s [m]"] = Approx(float(gap), 1e-3)
    return Result(Statement(margins), {k: v for k, v in values.items() if k != "times"})


def eq3_norm(data: Any) -> Result:
    """1 less the largest entry of Lambda'Lambda of (42), at M = 0 and pi/2."""
    margins, weak = {}, {}
    for name, (cosine, sine) in {"M = 0": (1, 0), "M = pi/2": (0, 1)}.items():
        entries = data["Lambda"] @ np.array([fmpq(cosine), fmpq(sine)], dtype=object)
        margins[name] = fmpq(1) - max(x * x for x in entries)
        weak[name] = bool(margins[name] >= 0)
    return Result(Statement(margins), {"holds with <=": weak})


def eq42_factor(data: Any) -> Identity:
    """E1 Lambda E2 of (42), against Delta A of (2), as functions of M and e."""
    import sympy as sp

    n, e, M = sp.symbols("n e M", real=True)
    c, s = sp.cos(M), sp.sin(M)
    E1, E2nn, E2n, entries = (_rational(data[k]) for k in ("E1_e", "E2_nn", "E2_n", "Lambda"))
    middle = sp.diag(*[row[0] * c + row[1] * s for row in entries.tolist()])
    product = (e * E1) * middle * (n**2 * E2nn + n * E2n)
    return Identity(product.applyfunc(sp.expand), sp.Matrix(orbit.near_circular(n, e, c, s).tolist()))


def _rational(M: np.ndarray) -> Any:
    import sympy as sp

    return sp.Matrix(M.shape[0], M.shape[1], [sp.Rational(int(x.p), int(x.q)) for x in M.flat])


def sec4_n(data: Any, model: Any) -> Result:
    """sqrt(gm (1 - e)^3 / r_p^3) [rad/s]; evidence: the other mean motions."""
    e = data["e"]
    value = arb(data["gm"] * (1 - e) ** 3 / data["r_p"] ** 3).sqrt()
    return Result(value, {name: n for name, n in model["n"].items() if name != "n_printed"})


def sec4_observable(model: Any) -> Result:
    """Number of output selections out of 64 with an observability matrix of rank 6."""
    found = model["observable"]
    return Result(
        fmpq(int(found["count"])),
        {
            "which": "exactly those that measure y and at least one of z, z'",
            "rule holds": bool(found["rule_y_and_z_or_vz"]),
            "same count with the eccentricity term frozen": dict(found["frozen"]),
        },
    )


def eq39_observable(model: Any) -> Statement:
    """Rank of [C; CA] less 5, exact; for these two it is 6 if and only if (A, C) is observable, which is asserted."""
    A, C = model["A"]["n_printed"], model["C"]
    short = rank(np.vstack([C, C @ A]))
    assert is_observable(A, C) == (short == 6)
    return Statement({"rank of the observability matrix minus 5": fmpq(short - 5)})
