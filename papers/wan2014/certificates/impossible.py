"""The complete inequality (14) has no solution; the printed X, Y violate it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi import proof
from recontrol.lmi.conditions import condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import symmetric

from .. import conditions, problems
from ..boxes import eps_weight

DECIMALS = 5


def p38(data: Any, synthesis: Any, gain: str) -> dict[str, Any]:
    """Infeasibility of (14) with X > 0 for F = A - LC, whatever eps, Y, rho and the start.

    The multiplier Z lives on the first two blocks, with B'Z11 = B'Z12 so that Y drops out; the block of eps gets what
    cancels eps. What is left is <Z, (14)> = <G(Z), X> > 0 (the multiplier of X > 0).
    """
    from ..synthesis.infeasible import observers

    case = f"n_printed, {gain if gain.startswith('L_') else 'placed ' + gain}"
    F = observers(data, synthesis["placement"])[gain]
    plain = problems.rendezvous(data, f"n_printed, {gain if gain.startswith('L_') else 'L_corrected'}")
    target = replace(
        plain,
        name="P38",
        conditions=[c for c in plain.named if c.name == "eq14"] + [condition(conditions.definite)],
        variables={k: v for k, v in plain.variables.items() if k != "r"},
        units={k: v for k, v in plain.units.items() if k != "r"},
        data={k: v for k, v in plain.data.items() if k not in ("x0", "cost_unit", "time_unit") and "limit" not in k}
        | {"F": F},
        objective=None,
        case=case,
    )
    says = f"(14) has no solution X > 0, Y, eps for the observer gain {gain}"
    return proof.prove_infeasible(
        target, multipliers={"eq14": _multiplier(target, synthesis["multipliers"][gain]["Z"])}, says=says
    )


def _multiplier(target: Problem, Z: Any) -> np.ndarray:
    """Exact multiplier (30, 30) from the float Z (12, 12): rounded, shifted, rows copied, eps cancelled."""
    rounded = rational.symmetric_part(rational.rounded(np.asarray(Z), DECIMALS))
    rounded = rounded + fmpq(2, 10**DECIMALS) * rational.identity(12)
    rounded[3:6, 6:] = rounded[3:6, :6]
    rounded[6:, 3:6] = rounded[:6, 3:6]
    full = rational.zeros(target.forms["eq14"].shape[0])
    full[:12, :12] = rounded
    excess = eps_weight(target, full)
    for k in range(12, 18):
        full[k, k] = -excess / 6
    return full


def p38_L_printed(data: Any, synthesis: Any) -> dict[str, Any]:
    return p38(data, synthesis, "L_printed")


def p38_L_corrected(data: Any, synthesis: Any) -> dict[str, Any]:
    return p38(data, synthesis, "L_corrected")


def p38_yang_tits(data: Any, synthesis: Any) -> dict[str, Any]:
    return p38(data, synthesis, "yang_tits")


def p38_varga(data: Any, synthesis: Any) -> dict[str, Any]:
    return p38(data, synthesis, "varga")


def p38_kautsky(data: Any, synthesis: Any) -> dict[str, Any]:
    return p38(data, synthesis, "kautsky")


def box_source(data: Any, case: str) -> dict[str, Any]:
    """X over its rounding box as balls, and a diagonal congruence that makes its diagonal about one."""
    scales = [rational.rounded(float(x) ** -0.5, 3) for x in np.diag(data.float("X"))]
    return {"X": data.ball("X"), "T": rational.diagonal(scales)}


def X_definite(data: Any) -> dict[str, Any]:
    """X > 0 for every X in the rounding box of (43)."""
    source = "papers.wan2014.certificates.impossible:box_source"
    with ball.precision(proof.PRECISION):
        found = box_source(data, "box")
        problem = Problem(
            "X", {}, [condition(conditions.scaled_definite)], found, paper="wan2014", case="box", source=source
        )
        return proof.prove_feasible(problem, {}, says="every X in the rounding box of (43) is positive definite")


def error_vector(data: Any, F: np.ndarray) -> np.ndarray:
    """Eigenvector (6,) of the largest eigenvalue of he(F X0) after scaling by the diagonal of X0, back in SI units."""
    X = data.float("X")
    scale = np.diag(X) ** -0.5
    M = rational.to_float(F) @ X
    _, vectors = np.linalg.eigh(scale[:, None] * (M + M.T) * scale[None, :])
    v = scale * vectors[:, -1]
    return v / np.abs(v).max()


def eq14_violated(data: Any, gain: str) -> dict[str, Any]:
    """One vector v with v' he(FX) v > 0 for every X in the box: block (2, 2) of (14) is not negative definite."""
    F = problems.observer(data, gain)
    assert F is not None
    target = Problem(
        "block (2,2) of (14)",
        {"X": symmetric(6)},
        [condition(conditions.error_block)],
        {"F": F},
        boxes={"X": problems.print_boxes(data)["box of X"]},
        paper="wan2014",
        case=gain,
        source=problems.SOURCE,
    )
    v = rational.rounded(error_vector(data, F), 8)
    says = f"no X in the rounding box of (43) satisfies (14) with {gain}"
    return proof.prove_infeasible(target, multipliers={"error_block": v[:, None] * v[None, :]}, says=says)


def eq14_L_printed(data: Any) -> dict[str, Any]:
    return eq14_violated(data, "L_printed")


def eq14_L_corrected(data: Any) -> dict[str, Any]:
    return eq14_violated(data, "L_corrected")
