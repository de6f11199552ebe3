"""Which problem the printed X, Y, K solve: members of all rounding boxes, and boxes without any."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.lmi import proof
from recontrol.lmi.conditions import condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import full, symmetric

from .. import boxes, conditions
from ..problems import boxed, print_boxes, rendezvous
from ..synthesis.readout import OBSERVERS


def K_member(data: Any, synthesis: Any) -> dict[str, Any]:
    """X, Y = K X and K in their boxes."""
    found = synthesis["joint"]["gain"]
    X, K = boxes.rounded_print(np.asarray(found["X"]), np.asarray(found["K"]))
    limits = {v: print_boxes(data)[f"box of {v}"] for v in "XYK"}
    problem = Problem(
        "K = Y X^-1",
        {"X": symmetric(6), "Y": full(3, 6), "K": full(3, 6)},
        [condition(conditions.product)],
        boxes=limits,
        paper="wan2014",
        case="print",
    )
    return proof.prove_feasible(
        problem, {"X": X, "Y": K @ X, "K": K}, says="some X, Y, K in all rounding boxes satisfy K X = Y"
    )


def member(data: Any, found: Any, case: str, count: int, says: str) -> dict[str, Any]:
    """Witness of one case; raises NotProvenError if the search of the synthesis came back empty."""
    certificate = None if found is None else boxes.certify(rendezvous(data, case, count=count), data, found, says)
    if certificate is None:
        raise proof.NotProvenError(f"{case}, R{count}: no witness at hand")
    return certificate


def excluded(data: Any, found: Any, case: str, count: int, says: str) -> dict[str, Any]:
    """Refutation of one case; raises NotProvenError if the search of the synthesis came back empty."""
    if found is None:
        raise proof.NotProvenError(f"{case}, R{count}: no refutation at hand")
    return boxes.refute(rendezvous(data, case, count=count), data, found, says)


def CO_n_orbit_R2(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "X, Y, K in all rounding boxes solve CO at n_orbit with e(0) = 0"
    return member(data, synthesis["joint"]["CO_n_orbit_R2"], "n_orbit, canonical", 2, says)


def CO_n_orbit_R1(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "X, Y, K in all rounding boxes solve CO at n_orbit with e(0) = 0, R once"
    return member(data, synthesis["joint"]["CO_n_orbit_R1"], "n_orbit, canonical", 1, says)


def SF_n_orbit_R2(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "X, Y, K in all rounding boxes solve SF at n_orbit with e(0) = 0"
    return member(data, synthesis["joint"]["SF_n_orbit_R2"], "n_orbit", 2, says)


def CO_n_printed_R2(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "no X, Y, K in the rounding boxes solve CO at the printed mean motion"
    return excluded(data, synthesis["joint"]["CO_n_printed_R2"], "n_printed, canonical", 2, says)


def CO_n_printed_R1(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "no X, Y, K in the rounding boxes solve CO at the printed mean motion, R once"
    return excluded(data, synthesis["joint"]["CO_n_printed_R1"], "n_printed, canonical", 1, says)


def SF_n_printed_R2(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "no X, Y, K in the rounding boxes solve SF at the printed mean motion"
    return excluded(data, synthesis["joint"]["SF_n_printed_R2"], "n_printed", 2, says)


def SF_n_printed_R1(data: Any, synthesis: Any) -> dict[str, Any]:
    says = "no X, Y, K in the rounding boxes solve SF at the printed mean motion, R once"
    return excluded(data, synthesis["joint"]["SF_n_printed_R1"], "n_printed", 1, says)


def start_excluded(data: Any, case: str) -> dict[str, Any]:
    """(30) with this e(0) and (31) contradict each other over the boxes of X and Y; (14) is not needed."""
    problem = rendezvous(data, f"n_orbit, {case}")
    needed = {a for c in problem.named if not c.name.startswith("eq14") for a in c.arguments().values()}
    kept = Problem(
        f"start with {case}",
        {k: v for k, v in problem.variables.items() if k in needed},
        [c for c in problem.named if not c.name.startswith("eq14")],
        {k: v for k, v in problem.data.items() if k in needed},
        units={k: v for k, v in problem.units.items() if k in needed},
        paper="wan2014",
        case=problem.case,
        source=problem.source,
    )
    says = f"no X, Y in their rounding boxes satisfy (30) with {case} and (31)"
    return proof.prove_infeasible(boxed(data, kept, with_gain=False), says=says)


def e0_velocity_excluded(data: Any) -> dict[str, Any]:
    return start_excluded(data, "e0_velocity")


def e0_full_excluded(data: Any) -> dict[str, Any]:
    return start_excluded(data, "e0_full")


def end_of_n(data: Any, synthesis: Any, problem: str, side: str, where: str) -> dict[str, Any]:
    """Member or exclusion just inside or outside one end of the interval of n, R twice."""
    entry = synthesis["intervals"][f"{problem}_{side}"][where]
    case = f"{entry['text']}{OBSERVERS[problem]}"
    if where == "inside":
        return member(data, entry, case, 2, f"X, Y, K in all rounding boxes solve {problem} at {entry['text']} rad/s")
    return excluded(data, entry, case, 2, f"no X, Y, K in the rounding boxes solve {problem} at {entry['text']} rad/s")


def n_CO_low_inside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "CO", "low", "inside")


def n_CO_low_outside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "CO", "low", "outside")


def n_CO_high_inside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "CO", "high", "inside")


def n_CO_high_outside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "CO", "high", "outside")


def n_SF_low_inside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "SF", "low", "inside")


def n_SF_low_outside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "SF", "low", "outside")


def n_SF_high_inside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "SF", "high", "inside")


def n_SF_high_outside(data: Any, synthesis: Any) -> dict[str, Any]:
    return end_of_n(data, synthesis, "SF", "high", "outside")
