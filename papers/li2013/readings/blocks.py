"""Blocks of (23) and (41) against the form (35) with the zero terms (36), for random rational P, T, S; exact."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from flint import fmpq, fmpq_poly

from recontrol.claims.proofs import accepted
from recontrol.claims.values import Identity, Result, Statement
from recontrol.exact import rational
from recontrol.exact.ball import precision
from recontrol.systems import sampled

from .. import conditions as c
from .. import problems as pr
from ..derivation import quadratic_form, some_point, summands, trajectory_gap
from .support import loop

DIFFERENCE: dict[str, tuple[str, Callable[..., np.ndarray]]] = {
    "12": ("-2 (h - tau) P3 + A'T2 + S2", lambda x, A, h, tau: A.T @ x["T2"] + x["S2"] - 2 * (h - tau) * x["P3"]),
    "13": ("S3", lambda x, A, h, tau: x["S3"]),
    "23": ("S2", lambda x, A, h, tau: x["S2"]),
    "24": ("-tau S2'", lambda x, A, h, tau: -tau * x["S2"].T),
}
"""Printed minus derived block: in words, and as a function that each reading compares exactly."""


def _pair(data: Any, faults: str, tau: fmpq, point: dict[str, np.ndarray]) -> tuple[list[list[Any]], np.ndarray]:
    """Printed (or derived) rows of blocks and the form, at one age."""
    exact = pr.exact_data(data, "")
    A, G, h = exact["A_print"], exact["B"] @ exact["K"], exact["h"]
    # Any number may stand for exp(-2 alpha tau): both sides are affine in it.
    common = {"h": h, "alpha": exact["alpha"], "tau": tau, "decay": fmpq(49, 50)}
    rows = c.functional(**point, A=A, B=exact["B"], K=exact["K"], faults=faults, **common)
    return rows, quadratic_form(point, A, G, **common)


def _identity(data: Any, name: str, ages: tuple[fmpq, ...]) -> Result:
    i, j = int(name[0]) - 1, int(name[1]) - 1
    point, left, right = some_point(9), [], []
    for tau in ages:
        rows, form = _pair(data, c.PRINTED, tau, point)
        block = rows[i][j - i]
        left.append(rational.zeros(9) if isinstance(block, int) else block)
        right.append(form[9 * i : 9 * i + 9, 9 * j : 9 * j + 9])
    printed, derived = np.vstack(left), np.vstack(right)
    if name not in DIFFERENCE:
        return Result(Identity(printed, derived), {})
    words, formula = DIFFERENCE[name]
    exact = pr.exact_data(data, "")
    stated = np.vstack([formula(point, exact["A_print"], exact["h"], tau) for tau in ages])
    if not np.all(printed - derived == stated):
        raise ValueError(f"block {name}: printed minus derived is not {words}")
    return Result(Identity(printed, derived), {"printed minus derived": words})


def _reading(name: str, ages: str) -> Callable[[Any], Result]:
    def block(data: Any) -> Result:
        taus = {"zero": (fmpq(0),), "h": (data["h"],), "any": (fmpq(1, 5), fmpq(1, 3))}[ages]
        return _identity(data, name, taus)

    block.__doc__ = f"Block {name} at the age {ages}."
    return block


eq23_11 = _reading("11", "zero")
eq23_12 = _reading("12", "zero")
eq23_13 = _reading("13", "zero")
eq23_22 = _reading("22", "zero")
eq23_23 = _reading("23", "zero")
eq23_33 = _reading("33", "zero")
eq23_h11 = _reading("11", "h")
eq23_h12 = _reading("12", "h")
eq23_h13 = _reading("13", "h")
eq23_h14 = _reading("14", "h")
eq23_h22 = _reading("22", "h")
eq23_h23 = _reading("23", "h")
eq23_h24 = _reading("24", "h")
eq23_h33 = _reading("33", "h")
eq23_h34 = _reading("34", "h")
eq23_h44 = _reading("44", "h")
eq41_11 = _reading("11", "any")
eq41_12 = _reading("12", "any")
eq41_13 = _reading("13", "any")
eq41_14 = _reading("14", "any")
eq41_22 = _reading("22", "any")
eq41_23 = _reading("23", "any")
eq41_24 = _reading("24", "any")
eq41_33 = _reading("33", "any")
eq41_34 = _reading("34", "any")
eq41_44 = _reading("44", "any")


def thm2_print(data: Any, certificates: Any, case: str) -> Result:
    """Printed (21), (22) hold for -K_bar (certificate), whose loop has this decay rate less alpha."""
    accepted(certificates, "void-minus")
    A, G, _ = loop(data, case, "minus")
    with precision(128):
        rate = sampled.decay_rate(A, G, data["h"])
    return Result(Statement({"decay rate less alpha": rate - data["alpha"]}), certificate="void-minus")


def thm2(data: Any, certificates: Any) -> Result:
    """Derived blocks equal the form at three ages, exactly; the controls and rejected gains stand beside it."""
    point, left, right = some_point(9, seed=2), [], []
    for tau in (fmpq(0), fmpq(1, 7), data["h"]):
        rows, form = _pair(data, c.DERIVED, tau, point)
        left.append(c.block(rows))
        right.append(form)
    accepted(certificates, "controls", "reject-zero", "reject-minus", "reject-minus10")
    evidence = {
        "on a trajectory, derived (relative)": trajectory_gap(data, c.DERIVED),
        "on a trajectory, printed (relative)": trajectory_gap(data, c.PRINTED),
    }
    return Result(Identity(np.vstack(left), np.vstack(right)), evidence, certificate="controls")


def h22_twice(data: Any) -> Identity:
    """T2' + T2' as printed, against block 22 of the form at the age h, where the term in P2 vanishes."""
    point = some_point(9)
    _, form = _pair(data, c.PRINTED, data["h"], point)
    return Identity(point["T2"].T + point["T2"].T, form[9:18, 9:18])


def eq26_equal() -> Identity:
    """V_2' with f = xi'P2 xi: the last line of (26) alone, against the derivative (f = 1, whose integral is known)."""
    import sympy as sp

    tau, h, alpha = sp.symbols("tau h alpha", positive=True)
    V2 = (h - tau) * (1 - sp.exp(-2 * alpha * tau)) / (2 * alpha)
    return Identity((h - tau) * (1 - sp.exp(-2 * alpha * tau)), sp.diff(V2, tau))


def last_term_of_27() -> tuple[Any, Any]:
    """Scalar, along xi' = s: the last term of (27) as printed, and V_2' of (25) less the other two terms of (27)."""
    import sympy as sp

    s, tau, h, alpha, P2, P3 = sp.symbols("s tau h alpha P2 P3", positive=True)
    memory = sp.integrate(P2 * s**2 * sp.exp(-2 * alpha * (tau - s)), (s, 0, tau))
    V2 = (h - tau) * memory
    return (h - tau) * P3 * tau**2, sp.diff(V2, tau) + memory + 2 * alpha * (h - tau) * memory


def eq27_weight() -> Identity:
    """The last term of (27) with P3, against what the functional (25) gives."""
    return Identity(*last_term_of_27())


def eq33_sign() -> Statement:
    """Jensen's inequality as printed for f(s) = s on [0, 1]: squared integral less the integral of the square."""
    f = fmpq_poly([0, 1])
    mean, square = f.integral()(fmpq(1)), (f * f).integral()(fmpq(1))
    return Statement({"right less left side": mean**2 - square})


def eq38_product(data: Any) -> Identity:
    """(38) as printed, its zero terms multiplied, against zeta'Pi zeta of (40); neither vanishes at this zeta."""
    point, tau = some_point(9), data["h"] / 3
    draws = np.random.default_rng(3).integers(-9, 10, (36, 1)).tolist()
    zeta = rational.matrix(draws)

    def value(*zero: str) -> Any:
        kept = {name: M * 0 if name[0] in zero else M for name, M in point.items()}
        return (zeta.T @ _pair(data, c.DERIVED, tau, kept)[1] @ zeta)[0, 0]

    base = value("T", "S")
    motion, average = value("S") - base, value("T") - base
    return Identity(base + motion * average, value())


def eq41_affine() -> Identity:
    """Second derivative of the factor tau exp(-2 alpha tau) of Pi_44 against zero."""
    import sympy as sp

    tau, alpha = sp.symbols("tau alpha", positive=True)
    return Identity(sp.diff(tau * sp.exp(-2 * alpha * tau), tau, 2), sp.Integer(0))


def eq48_order(data: Any) -> Statement:
    """V_1 - V of (24), (25) for P_i = I along the first slope of the loop, half an interval after t_k: an upper bound.

    The integral in V_2 is at least tau exp(-2 alpha h), and that exponential at least `decay`.
    """
    exact = pr.exact_data(data, "")
    xi0, tau = exact["xi0"], exact["h"] / 2
    slope = (exact["A_print"] + exact["B"] @ exact["K"]) @ xi0
    point = dict.fromkeys(("P1", "P2", "P3"), rational.identity(9))
    V1, V2, V3 = summands(point, xi0, slope, exact["h"], tau, tau * exact["decay"])
    return Statement({"V_1 - V, at most": V1 - (V1 + V2 + V3)})
