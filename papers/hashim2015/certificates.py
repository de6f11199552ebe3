"""Proofs that a reader can check again with ``recontrol verify``.

Loops of the recomputed designs hold balls that enclose the gains; loops of printed numbers are rational, boxes are
those of the print.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from recontrol.exact.ball import midpoint, precision
from recontrol.lmi import loops
from recontrol.lmi.conditions import condition
from recontrol.lmi.enclosure import bound_by_multipliers, bound_by_point
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import prove_feasible
from recontrol.lmi.variables import symmetric

from . import analysis, conditions, problems, recipe
from .model import AXES
from .synthesis.lqr import multiplier, program

PAPER = "hashim2015"
SOURCE = "papers.hashim2015.problems:problem_data"
BITS = 128
BOX_UNITS = (1, 1, 1, 1, 1, 5, 2)


def inverse_lqr(data: Any) -> dict[str, Any]:
    """No diagonal Q >= 0 gives (52) with R = 1: the third weight is negative over the whole rounding box."""
    case = problems.CONTROLLER_BOX
    with precision(BITS):
        found = problems.problem_data(data, case)
        problem = Problem(
            "inverse LQR", {}, [conditions.third_weight_is_negative], found, paper=PAPER, case=case, source=SOURCE
        )
        return prove_feasible(
            problem, {}, says="for every K in the box of (52) a diagonal Q has a negative third entry"
        )


def loop_full(data: Any) -> dict[str, Any]:
    """[A-BK, BK; 0, A-LC] is stable for every K in the box of (52) and every L in that of (54)."""
    case = problems.FULL_BOX
    says = "the full-order loop is stable for every K and L that the print admits"
    with precision(BITS):
        M = problems.problem_data(data, case)["M"]
        return loops.prove_stable(M, name="full-order loop", says=says, paper=PAPER, case=case, source=SOURCE)


def box_x1(data: Any) -> dict[str, Any]:
    """(66)-(69) fed with x1: stable for all sixteen entries anywhere in their half units."""
    case = problems.REDUCED_BOX
    says = "the printed reduced compensator fed with x1 is stable over its whole rounding box"
    context = {"paper": PAPER, "case": case, "source": SOURCE}
    return loops.prove_box_stable(
        **problems.problem_data(data, case), units=BOX_UNITS, name="reduced loop", says=says, **context
    )


def _all_axes(loop_of_axis: Mapping[str, np.ndarray], case: str, says: str) -> dict[str, Any]:
    """One Lyapunov matrix per axis in one certificate."""
    import scipy.linalg

    variables, chosen, data, point = {}, [], {}, {}
    for axis, M in loop_of_axis.items():
        n = M.shape[0]
        variables[f"P {axis}"], data[f"M {axis}"] = symmetric(n), M
        rename = {"P": f"P {axis}", "M": f"M {axis}"}
        chosen.append(condition(loops.definite, f"{axis}: P > 0", rename=rename))
        chosen.append(condition(loops.hurwitz, f"{axis}: decay", rename=rename))
        point[f"P {axis}"] = scipy.linalg.solve_continuous_lyapunov(midpoint(M).T, -np.eye(n))
    return prove_feasible(
        Problem("loops of the axes", variables, chosen, data, paper=PAPER, case=case, source=SOURCE), point, says=says
    )


def loops_full(model: Any, synthesis: Any) -> dict[str, Any]:
    """The full-order loop of every axis, recomputed gains in balls."""
    with precision(BITS):
        found = {axis: analysis.axis_full_loop(model, synthesis, axis) for axis in AXES}
        return _all_axes(found, problems.FULL_LOOPS, "the full-order loop of every axis is stable")


def loops_corrected(model: Any, synthesis: Any) -> dict[str, Any]:
    """The corrected reduced loop of every axis, y measured, recomputed gains in balls."""
    with precision(BITS):
        found = {axis: analysis.corrected_loop(model, synthesis, axis) for axis in AXES}
        return _all_axes(found, problems.CORRECTED_LOOPS, "the corrected reduced loop of every axis is stable")


def ace_stable(data: Any) -> dict[str, Any]:
    """A member of the rounding box of (55), lower right block with the printed 0 at (6,5), whose loop is stable."""
    case = problems.STABLE_MEMBER
    M = problems.problem_data(data, case)["M"]
    return loops.prove_stable(M, name="loop of a member of (55)", paper=PAPER, case=case, source=SOURCE)


def ace_unstable(data: Any) -> dict[str, Any]:
    """Another member of the same box whose loop is unstable: the print does not decide."""
    case = problems.UNSTABLE_MEMBER
    M = problems.problem_data(data, case)["M"]
    return loops.prove_unstable(M, name="loop of a member of (55)", paper=PAPER, case=case, source=SOURCE)


def _lower(model: Any, synthesis: Any, axis: str) -> dict[str, Any]:
    problem = program(recipe.plant_of(model, axis), axis)
    return bound_by_point(problem, {"P": synthesis["lqr"][axis]["primal"]})[1]


def _upper(model: Any, synthesis: Any, axis: str) -> dict[str, Any]:
    plant = recipe.plant_of(model, axis)
    Z = multiplier(plant, synthesis["lqr"][axis]["gain"])
    return bound_by_multipliers(program(plant, axis), {"lqr": Z})[1]


def lqr_yaw_lower(model: Any, synthesis: Any) -> dict[str, Any]:
    """Lower bound of the optimal LQR cost tr P of yaw."""
    return _lower(model, synthesis, "yaw")


def lqr_yaw_upper(model: Any, synthesis: Any) -> dict[str, Any]:
    """Upper bound of the optimal LQR cost tr P of yaw."""
    return _upper(model, synthesis, "yaw")


def lqr_pitch_lower(model: Any, synthesis: Any) -> dict[str, Any]:
    """Lower bound of the optimal LQR cost tr P of pitch, coefficient of (2)."""
    return _lower(model, synthesis, "pitch-tf")


def lqr_pitch_upper(model: Any, synthesis: Any) -> dict[str, Any]:
    """Upper bound of the optimal LQR cost tr P of pitch, coefficient of (2)."""
    return _upper(model, synthesis, "pitch-tf")


def lqr_roll_lower(model: Any, synthesis: Any) -> dict[str, Any]:
    """Lower bound of the optimal LQR cost tr P of roll."""
    return _lower(model, synthesis, "roll")


def lqr_roll_upper(model: Any, synthesis: Any) -> dict[str, Any]:
    """Upper bound of the optimal LQR cost tr P of roll."""
    return _upper(model, synthesis, "roll")
