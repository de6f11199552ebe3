"""The semidefinite programs of the folder, each in the scaled units of its design (see `plant.SCALES`).

Data are exact: the orbital rate enters rounded to 16 decimals, g = gamma_inf / z_weight, z_weight
being the factor 1e-3 of z_inf in (3). ``case`` is a text that `source`
turns back into the data, so that every certificate can be rebuilt from paper.yaml.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact.ball import precision
from recontrol.exact.linalg import inverse
from recontrol.exact.rational import decimal
from recontrol.lmi.conditions import condition, maximise, minimise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import full, scalar, symmetric

from . import conditions as c
from . import plant

SOURCE = "papers.shi2016.problems:source"
X6, W36, Y3 = symmetric(6), full(3, 6), symmetric(3)


def source(data: Any, case: str) -> dict[str, Any]:
    """Data of a case such as ``"scaled:ext"``, ``"scaled:nonfragile"`` or ``"SI:trad"``: the plant and, if there is
    one, the published gain. ``"box:ext"`` holds the closed loop over the rounding box and the interval of omega0
    instead."""
    kind, name = case.split(":")
    if kind == "box":
        return _boxes(data, name)
    rate = plant.exact_rate(data)
    matrices = plant.scaled(data, rate, name) if kind == "scaled" else plant.matrices(data, rate)
    if name in plant.GAINS:
        matrices["K"] = plant.scaled_gain(data, name) if kind == "scaled" else data[plant.GAINS[name]]
        matrices["Ms"] = sharing_matrix(matrices)
    if kind == "scaled":
        matrices["M"], matrices["N"] = data["M"], plant.units(data, name).gain(data["N"])
    return matrices


def _boxes(data: Any, gain: str) -> dict[str, Any]:
    """``A``: A + B1 K over the box; ``A_plus``, ``A_minus``: with Delta K at F = 1 and -1, ``_i`` for N-interleaved."""
    with precision(plant.BITS):
        si = plant.matrices(data, plant.rate_interval(data))
        loop = plant.closed_loop(si, plant.gain_box(data, gain))
        push = si["B1"] @ data["M"]
        out: dict[str, Any] = {"A": loop}
        for suffix, name in (("", "N"), ("_i", "N_interleaved")):
            out |= {f"A_plus{suffix}": loop + push @ data[name], f"A_minus{suffix}": loop - push @ data[name]}
        return out


def sharing_matrix(matrices: dict[str, Any]) -> np.ndarray:
    """Ms = -J^{-1} (angle columns of K + low), (3, 3), from SI or scaled matrices."""
    loop = plant.closed_loop(matrices, matrices["K"])
    return -loop[3:6, 0:3]


def pick(matrices: dict[str, Any], names: str, **more: Any) -> dict[str, Any]:
    """The named data and further ones."""
    return {name: matrices[name] for name in names.split()} | more


def problem(
    name: str, case: str, variables: Any, conditions: Any, data: Any, objective: Any = None, **more: Any
) -> Problem:
    """A problem of this folder: data rebuilt by `source` from the case."""
    return Problem(name, variables, conditions, data, objective, paper="shi2016", case=case, source=SOURCE, **more)


def _level(data: Any, g: fmpq, units: str) -> fmpq:
    """gamma of (8) at level g: g itself in scaled units."""
    return g if units == "scaled" else g * data["z_weight"]


def _shared_factor(data: Any, shared: bool) -> fmpq:
    """Factor of X in `conditions.h2_lyapunov`: 1 unless it shares a scaled X with (8) as printed."""
    return 1 / data["z_weight"] if shared else fmpq(1)


def fixed(data: Any, gain: str, kind: str, g: fmpq, units: str = "scaled", **more: Any) -> Problem:
    """Least rho for a published gain: ``trad`` is (8) with (9) and one X, ``std`` the same with `brl_std`, ``prt`` what
    is left of Theorem 2 once its vacuous block is dropped."""
    case = f"{units}:{gain}"
    matrices = source(data, case)
    given = pick(matrices, "A B1 B2 C1 C2 D1 D2 K", gamma=_level(data, g, units))
    if kind == "prt":
        conditions = [c.brl_fixed, c.output_coupling]
        return problem(f"rho-prt-{gain}", case, {"X": X6, "Z": Y3}, conditions, given, minimise(c.total), **more)
    bounded_real = c.brl_fixed if kind == "trad" else c.brl_std_fixed
    given["factor"] = _shared_factor(data, kind == "trad" and units == "scaled")
    conditions = [bounded_real, c.h2_lyapunov_fixed]
    return problem(f"rho-{kind}-{gain}", case, {"X": X6}, conditions, given, minimise(c.output_energy), **more)


def h2_effort(data: Any, gain: str, effort_squared: fmpq, units: str = "scaled", **more: Any) -> Problem:
    """Least H2 norm with a bound on the effort of u = Kx (``effort_squared`` in the units chosen)."""
    case = f"{units}:{gain}"
    given = pick(source(data, case), "A B1 B2 C2", factor=fmpq(1), rho=effort_squared)
    conditions = [c.h2_lyapunov, c.effort, condition(c.trace_below, "effort_bound", rename={"Z": "Y"})]
    variables = {"X": X6, "W": W36, "Y": Y3}
    return problem(f"h2-effort-{gain}", case, variables, conditions, given, minimise(c.output_energy), **more)


def single(data: Any, kind: str, g: fmpq, effort_squared: fmpq, units: str = "scaled", **more: Any) -> Problem:
    """One X for both norms with an effort bound: ``std`` or ``print`` (the normalisation of (8)), in units of K_ext."""
    case = f"{units}:ext"
    factor, gamma = _shared_factor(data, kind == "print" and units == "scaled"), _level(data, g, units)
    given = pick(source(data, case), "A B1 B2 C1 C2 D1 D2", gamma=gamma, factor=factor, rho=effort_squared / factor)
    conditions = [
        c.brl if kind == "print" else c.brl_std,
        c.h2_lyapunov,
        c.effort,
        condition(c.trace_below, "effort_bound", rename={"Z": "Y"}),
    ]
    variables = {"X": X6, "W": W36, "Y": Y3}
    return problem(f"single-{kind}", case, variables, conditions, given, minimise(c.output_energy), **more)


def least_effort(data: Any, g: fmpq) -> Problem:
    """Least certified effort Tr(W X^{-1} W') of any gain that satisfies (8) as printed, in the units ``orbit``.

    The X of (8) is that of SI units over h / z_weight: the squared effort is ws / z_weight times the optimal value.
    """
    case = "scaled:orbit"
    given = pick(source(data, case), "A B1 B2 C1 D1 D2", gamma=g)
    variables = {"X": X6, "W": W36, "Y": Y3}
    return problem("least-effort-print", case, variables, [c.brl, c.effort], given, minimise(c.total, Z="Y"))


def dilated(data: Any, g: fmpq, effort_squared: fmpq, e1: fmpq, e2: fmpq) -> Problem:
    """Two Lyapunov matrices and one slack G with an effort bound; e1, e2 in units of 1/ws."""
    case = "scaled:ext"
    given = pick(source(data, case), "A B1 B2 C1 C2 D1 D2", e1=e1, e2=e2, bz=g, bd=g, rho=effort_squared)
    conditions = [
        c.dilated_inf,
        c.dilated_h2,
        c.dilated_effort,
        condition(c.trace_below, "effort_bound", rename={"Z": "Y"}),
        condition(c.definite, "P1_definite", rename={"X": "P1"}),
    ]
    variables = {"P1": X6, "P2": X6, "G": full(6, 6), "F": W36, "Y": Y3}
    return problem("dilated", case, variables, conditions, given, minimise(c.output_energy, X="P2"))


def nonfragile(data: Any, effort_squared: fmpq | None, delta: str = "1") -> Problem:
    """Least guaranteed H2 norm for every abs(F) <= delta with an effort bound; without one, least effort."""
    case = "scaled:nonfragile"
    given = pick(source(data, case), "A B1 B2 C2 M N", delta=decimal(delta))
    conditions: list[Any] = [c.nonfragile, c.effort]
    objective = minimise(c.total, Z="Y")
    if effort_squared is not None:
        given["rho"] = effort_squared
        conditions.append(condition(c.trace_below, "effort_bound", rename={"Z": "Y"}))
        objective = minimise(c.output_energy)
    else:
        del given["C2"]
    variables = {"X": X6, "W": W36, "Y": Y3, "e": scalar()}
    return problem("nonfragile", case, variables, conditions, given, objective)


def nonfragile_dual(data: Any) -> Problem:
    """Multipliers of `nonfragile` without an effort bound: the largest Tr(B2'P B2) bounds the squared effort from
    below."""
    case = "scaled:nonfragile"
    given = pick(source(data, case), "A B1 B2 M N")
    conditions = [c.nonfragile_dual, c.nonfragile_dual_gain]
    return problem("nonfragile-dual", case, {"P": X6, "z": full(6, 1)}, conditions, given, maximise(c.dual_trace))


def thm1_iii(data: Any, gain: str, units: str = "scaled", **more: Any) -> Problem:
    """(iii) of Theorem 1 for a published gain with N2 tied; its least Tr Z is the squared H2 norm."""
    case = f"{units}:{gain}"
    given = pick(source(data, case), "A B1 B2 C2 K")
    conditions = [c.thm1_iii, c.tied_n2, c.output_coupling]
    variables = {"X": X6, "Q": full(6, 6), "N2": full(6, 6), "Z": Y3}
    return problem(f"thm1-iii-{gain}", case, variables, conditions, given, minimise(c.total), **more)


def extended(data: Any, g: fmpq) -> Problem:
    """Theorem 2 as printed, without the rank-raising unknowns: least Tr Z over (8) with W free and [X C2'; C2 Z] > 0.

    Q and N2 are left out: the remaining block of Theorem 2 holds for every X > 0 with the Q and N2 of `vacuous`.
    """
    case = "scaled:ext"
    given = pick(source(data, case), "A B1 B2 C1 C2 D1 D2", gamma=g)
    conditions = [c.brl, c.output_coupling]
    return problem("thm2-printed", case, {"X": X6, "W": W36, "Z": Y3}, conditions, given, minimise(c.total))


def traditional(data: Any, g: fmpq) -> Problem:
    """Lemmas 1 and 2 with one X and W = Q, without an effort bound: least Tr(C2 X C2')."""
    case = "scaled:ext"
    given = pick(source(data, case), "A B1 B2 C1 C2 D1 D2", gamma=g, factor=_shared_factor(data, True))
    conditions = [c.brl, c.h2_lyapunov]
    return problem("traditional", case, {"X": X6, "W": W36}, conditions, given, minimise(c.output_energy))


def vacuous(X: np.ndarray, A: np.ndarray, B2: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Q and N2 that make (26) hold for any X > 0: Q = (B2 B2' + X^{-1})^{-1}, N2 = -X - Q'A.

    The (1,2) block of (26) is then zero, and its Schur complement is -Q - Q' + Q'(B2 B2' + X^{-1})Q = -Q < 0.
    """
    Q = inverse(B2 @ B2.T + inverse(X))
    return Q, -X - Q.T @ A


def gain_of(point: dict[str, Any], X: str = "X", W: str = "W") -> np.ndarray:
    """K = W X^{-1} from a float point."""
    return np.linalg.solve(point[X].T, point[W].T).T
