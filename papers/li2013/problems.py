"""Exact data of a case, and the semidefinite problems that the synthesis and the certificates share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact import ball, linalg, rational
from recontrol.lmi.conditions import Condition, condition, maximise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import Variable, patterned, scalar
from recontrol.spacecraft.orbit import clohessy_wiltshire, thrust_input
from recontrol.systems.sampled import integral_action

from . import conditions as c

SOURCE = "papers.li2013.problems:exact_data"
ORBITS = {"w-print": "A_print", "w-geo": "A_geo"}
BLOCKS = {"xy": (0, 1, 3, 4, 6, 7), "z": (2, 5, 8), "all": tuple(range(9))}
DEFAULTS = {
    "gain": "K_bar",
    "block": "all",
    "alpha": "0.02",
    "h": "0.5",
    "weight": "square",
    "channel": "both",
    "units": "nat",
}
FACTORS = {"K_bar": 1, "zero": 0, "minus": -1, "minus10": -10}
# State units [m, m/s, m s] for proofs: the length is |y_c(0)|, the time (m L / u_max)^(1/2) = 2 s.
NATURAL = ("20",) * 3 + ("10",) * 3 + ("40",) * 3
SCALES = {"nat": NATURAL, "iso": ("20",) * 9, "si": ("1",) * 9, "fine": ("1",) * 6 + ("5",) * 3}


def exponential_bounds(exponent: fmpq) -> tuple[fmpq, fmpq]:
    """Rationals with nine decimals just below and just above exp(-exponent); equal to 1 for a zero exponent."""
    if exponent == 0:
        return fmpq(1), fmpq(1)
    value = (-arb(exponent)).exp() * 10**9
    low, high = value.lower().floor().fmpq(), value.upper().ceil().fmpq()
    return low / 10**9, high / 10**9


def plant(w: fmpq, mass: fmpq) -> dict[str, np.ndarray]:
    """Exact A_bar (9, 9), B_bar (9, 3), B1_bar (9, 6), C2_bar (3, 9) of (12) for the orbital rate `w` [rad/s]."""
    A, B = (rational.matrix(M) for M in (clohessy_wiltshire(w), thrust_input(mass)))
    C = np.hstack([rational.identity(3), rational.zeros(3)])
    A_bar, B_bar, B1_bar = integral_action(A, B, C)
    return {"A": A_bar, "B": B_bar, "B1": B1_bar, "C2": np.hstack([rational.zeros(3, 6), rational.identity(3)])}


def half_units(data: Any) -> np.ndarray:
    """Half units of the last places of the printed gain (3, 9); none where it is zero, which counts as exact."""
    half = data.half("K_bar")
    return np.where(data["K_bar"] == 0, half * 0, half)


def gain_box(data: Any) -> np.ndarray:
    """Balls (3, 9) of every gain that rounds to the print; the printed zeros are exact."""
    return ball.box(data["K_bar"], half_units(data))


def exact_data(data: Any, case: str) -> dict[str, Any]:
    """Data of a case written "name=value ..." (missing names: DEFAULTS), restricted to its block of states.

    `unit` is the identity of the chosen units, as a quadratic form in SI units. Matrices are exact,
    K is a ball matrix for gain=box, `decay` and `decay_above` enclose exp(-2 alpha h).
    """
    of = tokens(case)
    states = list(BLOCKS[of["block"]])
    axes = [i for i in range(3) if i in states]
    columns = {"both": axes + [3 + i for i in axes], "d-only": axes, "yr-only": [3 + i for i in axes]}[of["channel"]]
    K = gain_box(data) if of["gain"] == "box" else data["K_bar"] * FACTORS[of["gain"]]
    plants = {orbit: plant(data[orbit], data["mass"]) for orbit in ORBITS}
    some = plants["w-print"]
    scale = [rational.decimal(SCALES[of["units"]][i]) for i in states]
    h, alpha, gamma = rational.decimal(of["h"]), rational.decimal(of["alpha"]), data["gamma"]
    decay, above = exponential_bounds(2 * alpha * h)
    xi0 = np.vstack([data["x0"].T, rational.zeros(3, 1)])
    return {
        **{name: plants[orbit]["A"][np.ix_(states, states)] for orbit, name in ORBITS.items()},
        "B": some["B"][np.ix_(states, axes)],
        "K": K[np.ix_(axes, states)],
        "B1": some["B1"][np.ix_(states, columns)],
        "C2": some["C2"][np.ix_(axes, states)],
        "h": h,
        "alpha": alpha,
        "zero": fmpq(0),
        "unit": rational.diagonal([1 / (d * d) for d in scale]),
        "decay": decay,
        "decay_above": above,
        "xi0": xi0[states],
        "rho": data["rho"],
        "u_max": data["thrust_max"],
        "V0": data["V0"],
        "gamma2": gamma * gamma if of["weight"] == "square" else gamma,
    }


def equilibrium(exact: Mapping[str, Any], A: str, y_r: np.ndarray) -> np.ndarray:
    """xi_ss (9, 1) of the loop for a constant reference `y_r` (3, 1) and d = 0, exact."""
    push = exact["B1"] @ np.vstack([rational.zeros(3, 1), y_r])
    return linalg.solve(exact[A] + exact["B"] @ exact["K"], -push)


def unknowns(block: str, *, coupled: bool = False) -> dict[str, Variable]:
    """P_1 ... S_3 of the block; for all nine states zero between the plane and z unless `coupled`.

    The gain has no cross terms and neither has the plant, so flipping the signs of the z states maps solutions to
    solutions, and the mean of both has this pattern: (21), (22), (55) lose nothing by it. V(0) alone couples them.
    """
    states = BLOCKS[block]
    plane = np.array([i in BLOCKS["z"] for i in states])
    mask = np.ones((len(states),) * 2, dtype=bool) if coupled else plane[:, None] == plane[None, :]
    return {name: patterned(mask, symmetric=name.startswith("P")) for name in c.UNKNOWNS}


def units(block: str, scale: Sequence[str], value: str = "1") -> dict[str, Any]:
    """Units of the unknowns when V is measured in `value` [m^2 or as the problem says] and states in `scale`."""
    rows = [1 / rational.decimal(scale[i]) for i in BLOCKS[block]]
    unit = rational.decimal(value)
    return {name: ([unit * r for r in rows], rows) for name in c.UNKNOWNS}


def decay_conditions(orbits: Sequence[str], faults: str, *, decay: str = "decay", margin: bool = False) -> list:
    """(21) for each orbit, as strict conditions or with the margin t."""
    first, second = (c.phi_margin, c.phi_hat_margin) if margin else (c.phi, c.phi_hat)
    out = []
    for orbit in orbits:
        A = {"A": ORBITS[orbit]}
        out.append(condition(first, f"phi[{orbit}]", rename=A, faults=faults))
        out.append(condition(second, f"phi_hat[{orbit}]", rename={**A, "decay": decay}, faults=faults))
    return out


def definite_conditions(*, margin: bool = False, names: Sequence[str] = ("P1", "P2", "P3")) -> list[Condition]:
    """P_i > 0."""
    function = c.definite_margin if margin else c.definite
    return [condition(function, f"{name} > 0", rename={"P": name}) for name in names]


def thrust_conditions(block: str, *, margin: bool = False) -> list[Condition]:
    """(22) for the axes of the block."""
    function = c.thrust_margin if margin else c.thrust
    axes = [name for k, name in enumerate("xyz") if k in BLOCKS[block]]
    return [condition(function, f"thrust {name}", axis=k) for k, name in enumerate(axes)]


def performance_conditions(orbits: Sequence[str], faults: str, *, schur: bool = False) -> list[Condition]:
    """(55) for each orbit."""
    out = []
    for orbit in orbits:
        for function, name in ((c.performance, "performance"), (c.performance_hat, "performance_hat")):
            out.append(condition(function, f"{name}[{orbit}]", rename={"A": ORBITS[orbit]}, faults=faults, schur=schur))
    return out


def used(exact: Mapping[str, Any], listed: Sequence[Condition], variables: Mapping[str, Any], *extra: str) -> dict:
    """The data that the conditions ask for."""
    names = {name for item in listed for name in item.arguments().values()} | set(extra)
    return {name: value for name, value in exact.items() if name in names and name not in variables}


def tokens(case: str) -> dict[str, str]:
    """The choices of a case, defaults filled in."""
    return {**DEFAULTS, **dict(item.split("=") for item in case.split())}


def problem(
    data: Any, name: str, case: str, listed: Sequence[Condition], *, value: str = "1", coupled: bool = False,
    objective: Any = None, extra: Mapping[str, Variable] | None = None, more: Mapping[str, Any] | None = None,
) -> Problem:  # fmt: skip
    """A Problem over P_1 ... S_3 (and `extra` scalars) with the data of the case (and `more`) that it needs.

    `value` is the unit of V in which the solver works; the states have the units of the case.
    """
    of = tokens(case)
    variables = {**unknowns(of["block"], coupled=coupled), **(extra or {})}
    exact = {**exact_data(data, case), **(more or {})}
    wanted = ["xi0"] if objective is not None and objective.function is c.value_at_start else []
    return Problem(
        name, variables, listed, used(exact, listed, variables, *wanted), objective,
        units={**units(of["block"], SCALES[of["units"]], value), **dict.fromkeys(extra or {}, value)},
        paper="li2013", case=case, source=SOURCE,
    )  # fmt: skip


def point_problem(data: Any, case: str, orbits: Sequence[str], faults: str) -> Problem:
    """(21), (22), V(0) equal to the print, P_2, P_3 > 0, all by the largest margin t (no cap; V in units of 100)."""
    block = tokens(case)["block"]
    listed = [
        *decay_conditions(orbits, faults, margin=True),
        *definite_conditions(margin=True, names=("P2", "P3")),
        *thrust_conditions(block, margin=True),
        condition(c.initial_value),
    ]
    return problem(data, "point", case, listed, value="100", objective=maximise(c.margin), extra={"t": scalar()})
