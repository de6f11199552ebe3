"""The LQR gain by routes of different kind, and an enclosure of its optimal cost, every axis.

Artifact, one entry per axis: ``K`` one gain (1, n) per route, ``spread`` the largest deviation of each route from the
spectral factor, ``P`` the Riccati solution in floats, ``primal`` a rational P below it and ``gain`` a rational gain
near K, the witnesses of the certificates, ``trace`` {"lower", "upper"}: the bounds of tr P that these prove,
``solvers``: the semidefinite program as solved.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact.ball import exact_midpoint, midpoint
from recontrol.exact.linalg import is_positive_definite, lyapunov
from recontrol.exact.rational import identity, rounded, to_float, trace_product
from recontrol.lmi.conditions import maximise
from recontrol.lmi.problem import Problem, agreement
from recontrol.lmi.variables import symmetric

from .. import conditions, recipe
from ..model import AXES

DECIMALS = 10
SLACK = fmpq(1, 10**9)
SOLVERS = ("CLARABEL", "CVXOPT", "SCS")


class EnclosureError(ArithmeticError):
    """A rounded witness does not prove its bound."""


def state_weight(plant: recipe.Plant) -> np.ndarray:
    """Q = C'C."""
    return plant.C.T @ plant.C


def program(plant: recipe.Plant, axis: str) -> Problem:
    """Maximise tr P subject to the LQR inequality, units one. Its optimum is rank-deficient: no margin."""
    data = {"A": plant.A, "B": plant.B, "Q": state_weight(plant), "R": identity(1)}
    return Problem(
        "lqr",
        {"P": symmetric(plant.n)},
        [conditions.lqr],
        data,
        maximise(conditions.cost),
        paper="hashim2015",
        case=axis,
        source="papers.hashim2015.problems:problem_data",
    )


def riccati(plant: recipe.Plant, slack: float = 0.0) -> np.ndarray:
    """Float solution P of the Riccati equation for Q - slack I."""
    from scipy.linalg import solve_continuous_are

    Q = to_float(state_weight(plant)) - slack * np.eye(plant.n)
    P = solve_continuous_are(to_float(plant.A), to_float(plant.B), Q, np.eye(1))
    return (P + P.T) / 2


def rational_gain(plant: recipe.Plant) -> np.ndarray:
    """K to ten decimals, exact."""
    return rounded(exact_midpoint(recipe.controller_gain(plant)), DECIMALS)


def moment(plant: recipe.Plant, gain: np.ndarray) -> np.ndarray:
    """Z11 (n, n) with (A - BG) Z11 + Z11 (A - BG)' + I = 0, exact. Raises EnclosureError if G does not stabilise."""
    Z = lyapunov(plant.A - plant.B @ gain, identity(plant.n))
    if not is_positive_definite(Z):
        raise EnclosureError("the rounded gain does not stabilise the plant")
    return Z


def multiplier(plant: recipe.Plant, gain: np.ndarray) -> np.ndarray:
    """Z = [Z11, -Z11 G'; -G Z11, G Z11 G'] >= 0, the dual point of the gain G: its cost is of second order in G - K."""
    Z11 = moment(plant, gain)
    return np.block([[Z11, -Z11 @ gain.T], [-gain @ Z11, gain @ Z11 @ gain.T]])


def rational_primal(plant: recipe.Plant) -> np.ndarray:
    """Rational P near the Riccati solution for Q - 1e-9 I, which satisfies the LQR inequality strictly.

    Raises EnclosureError if it does not.
    """
    P = rounded(riccati(plant, float(SLACK)), DECIMALS + 4)
    if not is_positive_definite(conditions.lqr(P, plant.A, plant.B, state_weight(plant), identity(1))):
        raise EnclosureError("the rounded Riccati solution does not satisfy the LQR inequality")
    return P


def lower_end(plant: recipe.Plant) -> fmpq:
    """tr of `rational_primal`: below tr P."""
    return sum(rational_primal(plant).diagonal().tolist(), fmpq(0))


def upper_end(plant: recipe.Plant) -> fmpq:
    """Cost of `rational_gain`, <Q + G'G, Z11>: above tr P."""
    gain = rational_gain(plant)
    return trace_product(state_weight(plant) + gain.T @ gain, moment(plant, gain))


def routes(plant: recipe.Plant, axis: str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """K by the Riccati equation, a library's lqr and the semidefinite program; and the record of the solvers."""
    import control

    A, B, Q = to_float(plant.A), to_float(plant.B), to_float(state_weight(plant))
    found = {
        "spectral factor": midpoint(recipe.controller_gain(plant)),
        "Riccati equation": B.T @ riccati(plant),
        "control.lqr": np.asarray(control.lqr(A, B, Q, np.eye(1))[0]),
    }
    solutions = [program(plant, axis).solve(solver) for solver in SOLVERS]
    for solution in solutions:
        if solution.has_point:
            found[f"semidefinite program, {solution.solver}"] = B.T @ solution.point["P"]
    return found, agreement(solutions)


def one_axis(plant: recipe.Plant, axis: str) -> dict[str, Any]:
    """Entry of one axis."""
    found, solvers = routes(plant, axis)
    return {
        "K": found,
        "spread": {name: float(np.abs(K - found["spectral factor"]).max()) for name, K in found.items()},
        "P": riccati(plant),
        "primal": rational_primal(plant),
        "gain": rational_gain(plant),
        "trace": {"lower": lower_end(plant), "upper": upper_end(plant)},
        "solvers": solvers,
    }


def lqr(model: dict[str, Any]) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    return {axis: one_axis(recipe.plant_of(model, axis), axis) for axis in AXES}
