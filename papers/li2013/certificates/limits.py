"""Both sides of the searched limits (0.99 and 1.01 of the value), and the re-synthesised gains."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from recontrol.lmi.conditions import Condition
from recontrol.lmi.proof import NotProvenError, prove_feasible, prove_infeasible

from .. import conditions as c
from .. import problems as pr
from ..points import exact_point, prove
from ..synthesis.resynthesis import proof_case

# Units and row balancing under which the interior of the multipliers was wide enough, tried in turn.
ATTEMPTS = (("si", False), ("iso", True), ("fine", True), ("nat", True))
# Above a searched limit the violation, and with it the room for rounding multipliers, grows with the distance.
ABOVE = (1.01, 1.02, 1.05, 1.10)


def _conditions(orbit: str, decay: str = "decay", gain: str = "K") -> list[Condition]:
    listed = pr.decay_conditions((orbit,), c.DERIVED, decay=decay)
    return [*(replace(item, rename={**item.rename, "K": gain}) for item in listed), *pr.definite_conditions()]


def feasible(data: Any, name: str, case: str, says: str, more: dict[str, Any] | None = None) -> dict[str, Any]:
    """Certificate of derived (21) for the case (w-print) at the solver's point of largest common margin."""
    listed = _conditions("w-print", gain="K_design" if more else "K")
    problem = pr.problem(data, name, case, listed, more=more, coupled=bool(more))
    solution = problem.solve(fast=True)
    if not solution.has_point:
        raise NotProvenError(f"{name}: {solution.words}")
    point = exact_point(problem, solution.point, decimals=12)
    if more:
        return prove_feasible(problem, point, says=says)
    return prove(data, name, case, listed, point, says)


def refuted(data: Any, name: str, case: str, says: str) -> dict[str, Any]:
    """Certificate that derived (21) has no solution for the case, w-print."""
    failures = []
    for unit, balanced in ATTEMPTS:
        problem = pr.problem(data, name, f"{case} units={unit}", _conditions("w-print", "decay_above"))
        try:
            return prove_infeasible(replace(problem, balanced=balanced), says=says)
        except NotProvenError as error:
            failures.append(f"{unit}: {error}")
    raise NotProvenError("; ".join(failures))


def _scaled(bracket: Any, factor: float) -> str:
    return f"{factor * (bracket['low'] + bracket['high']) / 2:.6f}"


def _h(synthesis: Any, key: str, factor: float) -> str:
    return _scaled(synthesis["periods"]["h_max"][key]["z"], factor)


def h_a0_below(data: Any, synthesis: Any) -> dict[str, Any]:
    """Derived (21), alpha = 0, holds at 0.99 of the largest h."""
    h = _h(synthesis, "derived-a0", 0.99)
    return feasible(data, "h-a0-below", f"alpha=0 h={h}", f"derived (21) holds for alpha = 0, h = {h} s")


def _above(data: Any, synthesis: Any, name: str, key: str, alpha: str) -> dict[str, Any]:
    """Refutation in the z block at the nearest of 1.01 ... 1.10 of the largest h for which it can be proven."""
    failures = []
    for factor in ABOVE:
        h = _h(synthesis, key, factor)
        says = f"derived (21) has no solution for alpha = {alpha} 1/s, h = {h} s, {factor:g} of the largest"
        try:
            return refuted(data, name, f"block=z alpha={alpha} h={h}", says)
        except NotProvenError as error:
            failures.append(str(error))
    raise NotProvenError("; ".join(failures))


def h_a0_above(data: Any, synthesis: Any) -> dict[str, Any]:
    """alpha = 0: no solution above the largest h."""
    return _above(data, synthesis, "h-a0-above", "derived-a0", "0")


def h_a02_below(data: Any, synthesis: Any) -> dict[str, Any]:
    """Derived (21), alpha = 0.02, holds at 0.99 of the largest h."""
    h = _h(synthesis, "derived-a02", 0.99)
    return feasible(data, "h-a02-below", f"h={h}", f"derived (21) holds for alpha = 0.02, h = {h} s")


def h_a02_above(data: Any, synthesis: Any) -> dict[str, Any]:
    """alpha = 0.02: no solution above the largest h."""
    return _above(data, synthesis, "h-a02-above", "derived-a02", "0.02")


def alpha_below(data: Any, synthesis: Any) -> dict[str, Any]:
    """Derived (21), h = 0.5 s, holds at 0.99 of the largest decay rate (the plane limits it)."""
    alpha = _scaled(synthesis["periods"]["alpha_max"]["xy"], 0.99)
    return feasible(data, "alpha-below", f"alpha={alpha}", f"derived (21) holds for h = 0.5 s, alpha = {alpha} 1/s")


def reject_minus(data: Any) -> dict[str, Any]:
    """The z block refutes -K_bar: a principal block of a feasible point is feasible."""
    return refuted(data, "reject-minus", "gain=minus block=z", "derived (21) has no solution for -K_bar")


def reject_minus10(data: Any) -> dict[str, Any]:
    """The z block refutes -10 K_bar."""
    return refuted(data, "reject-minus10", "gain=minus10 block=z", "derived (21) has no solution for -10 K_bar")


def _gain(data: Any, synthesis: Any, alpha: str) -> dict[str, Any]:
    K = synthesis["resynthesis"]["designs"][alpha]["rounded"]
    case = proof_case(alpha)
    rate = pr.tokens(case)["alpha"]
    says = f"derived (21) holds at alpha = {rate} for the gain designed at {alpha}, rounded to four decimals"
    return feasible(data, f"design-{alpha}", case, says, {"K_design": K})


def design_10(data: Any, synthesis: Any) -> dict[str, Any]:
    """The gain designed at alpha = 0.10, proven at 0.09."""
    return _gain(data, synthesis, "0.10")


def design_15(data: Any, synthesis: Any) -> dict[str, Any]:
    """The gain designed at alpha = 0.15, proven at 0.135."""
    return _gain(data, synthesis, "0.15")


def design_20(data: Any, synthesis: Any) -> dict[str, Any]:
    """The gain designed at alpha = 0.20, proven at 0.18."""
    return _gain(data, synthesis, "0.20")
