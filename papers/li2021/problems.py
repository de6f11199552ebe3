"""The paper's matrix inequalities as problems: exact data by case, variables, units.

A case is text, ``base;name=decimal;...``. The base chooses the matrices: ``plant`` (rigid plant, scalars of Table 1),
``proposed`` (the same and the printed gains), ``loop-proposed`` and ``loop-ref39`` (A, B, C, W of the rigid loop, K the
torque), ``gains-proposed``, ``gains-H-proposed``, ``gains-J-proposed`` and ``all-proposed`` (that loop with channels of
uncertainty). What follows replaces scalars, for example ``proposed;delta_m=0.0117``. Certificates name this module's
`problem_data` as the source of their data.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.exact.rational import decimal, identity, zeros
from recontrol.lmi.conditions import Condition, condition, minimise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import Variable, diagonal, full, repeated, scalar, symmetric
from recontrol.systems.output_feedback import Controller
from recontrol.systems.robust import Channels, channels, gain_drift, norm_bounded, with_derivative

from . import conditions as c
from .plant import PRINTED, controller, initial_state, loop, plant

CHANNELS = {"gains": "", "gains-H": "H", "gains-J": "J", "all": "HJ"}
SOURCE = "papers.li2021.problems:problem_data"
SCALARS = {
    "a": "disk_a",
    "b": "disk_b",
    "delta_m": "drift_bound",
    "u_max": "u_max",
    "theta": "theta",
    "eps1": "eps1",
    "eps3": "eps3",
    "lam": "lambda",
    "lambda1": "lambda1",
    "gamma": "gamma",
    "e2": "eps2",
}
# Angles of 0.1 rad, torques of 1 N m and the inertia of about 20 kg m^2 make these the natural sizes.
UNITS = {
    "S": "100",
    "N": "100",
    "F_a": "100",
    "F_b": "100",
    "C_f": "10",
    "P": "100",
    "X": "1/10",
    "Y": "10",
    "Ah": "1",
    "Bh": "10",
    "Ch": "1",
    "Z": "1",
}
SN = {"S": symmetric(6), "N": symmetric(6)}
GAINS = {"F_a": full(6, 6), "F_b": full(6, 3)}
CONVEX = {"X": symmetric(6), "Y": symmetric(6), "Ah": full(6, 6), "Bh": full(6, 3), "Ch": full(3, 6)}
STATE_FEEDBACK = {"X": symmetric(6), "Z": full(3, 6)}
MULTIPLIERS = {
    "one": {"D1": repeated([12]), "D2": repeated([12])},
    "three": {"D1": repeated([12]), "D2": repeated([6, 3, 3])},
    "diag": {"D1": diagonal(12), "D2": diagonal(12)},
}
SIGNS = {"tau": c.sign_tau, "D1": c.sign_D1, "D2": c.sign_D2}


def problem_data(data: Any, case: str) -> dict[str, Any]:
    """Every datum that a condition may ask for in this case, exact."""
    base, *changes = case.split(";")
    scalars = {name: data[source] for name, source in SCALARS.items()}
    scalars |= {name: decimal(text) for name, text in (change.split("=") for change in changes)}
    p = plant(data)
    table: dict[str, Any] = {k: p[k] for k in "ABCLKW"} | scalars
    table |= {
        "u2": scalars["u_max"] ** 2,
        "gamma2": scalars["gamma"] ** 2,
        "tau": scalars["lam"] ** 2,
        "e1": scalars["eps1"],
    }
    table |= {"D1": identity(12) * scalars["eps1"], "D2": identity(12) * scalars["e2"]}
    x0 = initial_state(data)
    table["x0"] = x0 * scalars["times"] if "times" in scalars else x0
    kind, _, name = base.rpartition("-")
    if name in PRINTED:
        gains = controller(data, name)
        table |= {"A_f": gains.A, "B_f": gains.B, "C_f": gains.C}
    elif base != "plant":
        raise ValueError(f"case {case!r}: expected plant or the name of a controller last, found {base!r}")
    if kind:
        table |= loop(p, gains)
        table |= {"K": np.hstack([zeros(3, 6), gains.C]), "xi0": np.vstack([table["x0"], zeros(6, 1)])}
    if kind in CHANNELS:
        table |= uncertainty(p, gains, table, CHANNELS[kind])._asdict()
    return table


def uncertainty(p: Mapping[str, Any], gains: Controller, table: Mapping[str, Any], parts: str) -> Channels:
    """Channels of gain drift (always), Delta H ("H") and Delta J ("J") around a printed loop, exact."""
    pairs = gain_drift(p["B"], p["C"], gains, table["delta_m"]) if table["delta_m"] != 0 else []
    if "H" in parts:
        pairs.append(norm_bounded(p["L"], p["K"], 12))
    found = channels(pairs, 3)
    if "J" in parts:
        W = np.hstack([p["W"], zeros(3, 6)])
        found = with_derivative(found, table["A"], table["B"], -table["B"], W)
    return found


def gamma_squared(gamma2: Any) -> Any:
    """Objective: gamma^2."""
    return gamma2


def build(
    data: Any,
    name: str,
    case: str,
    conditions: Sequence[Callable[..., Any] | Condition],
    variables: Mapping[str, Variable],
    *,
    found: Mapping[str, Any] | None = None,
    best: bool = False,
    balanced: bool = True,
) -> Problem:
    """A problem whose data are those of the case that its conditions name.

    ``found`` gives exact data that the paper does not (a gain of a first step); ``best`` minimises gamma^2. lambda^2
    and the multipliers get their sign as a condition of its own, which a proof of infeasibility needs.
    """
    named = [x if isinstance(x, Condition) else condition(x) for x in conditions]
    named += [condition(sign) for unknown, sign in SIGNS.items() if unknown in variables]
    table = problem_data(data, case) | dict(found or {})
    wanted = {argument for x in named for argument in x.arguments().values()} - set(variables)
    return Problem(
        name,
        dict(sorted(variables.items())),  # the order in which a stored certificate comes back
        named,
        {argument: table[argument] for argument in sorted(wanted)},
        minimise(gamma_squared) if best else None,
        units={unknown: UNITS[unknown] for unknown in variables if unknown in UNITS},
        balanced=balanced,
        paper="li2021",
        case=case,
        source=SOURCE,
    )


def with_gamma(variables: Mapping[str, Variable]) -> dict[str, Variable]:
    """The variables and gamma^2."""
    return {**variables, "gamma2": scalar()}


def theorem(
    data: Any, kind: str, case: str, *, gains: bool, best: bool = False, found: Mapping[str, Any] | None = None,
    torque: Sequence[Callable[..., Any]] = (),
) -> Problem:  # fmt: skip
    """(13) with the multiplier structure "one", "three" or "diag" at a given C_f; ``gains``: A_f and B_f given too."""
    variables = {**SN, **({} if gains else GAINS), "tau": scalar(), **MULTIPLIERS[kind]}
    condition13 = c.eq13_gains if gains else c.eq13
    return build(
        data,
        f"eq13-{kind}",
        case,
        [condition13, *torque],
        with_gamma(variables) if best else variables,
        found=found,
        best=best,
    )


def lemma(data: Any, case: str, *, structured: bool, best: bool = False, free_tau: bool = False) -> Problem:
    """(12) of a printed loop, P free or structured.

    In plain rows with gamma^2 in units of 100: balanced rows make CLARABEL stop short of the optimum here.
    """
    variables: dict[str, Variable] = dict(SN) if structured else {"P": symmetric(12)}
    if free_tau:
        variables["tau"] = scalar()
    problem = build(
        data,
        "eq12-structured" if structured else "eq12-free",
        case,
        [c.eq12_structured if structured else c.eq12],
        with_gamma(variables) if best else variables,
        best=best,
    )
    return replace(problem, balanced=False, units={**problem.units, "gamma2": "100"} if best else problem.units)
