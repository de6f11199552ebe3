"""Lemma 3 at the printed gains (C4), and what (19) and (20) add (C6, C7)."""

from __future__ import annotations

from typing import Any

from recontrol.lmi.proof import prove_feasible, prove_infeasible
from recontrol.lmi.variables import scalar, symmetric

from .. import conditions as c
from ..problems import SN, build, lemma, with_gamma

# Rows of (12) without those of the disturbance: multipliers that vanish there hold for every gamma.
WITHOUT_GAMMA = [*range(15), *range(18, 36)]


def lemma_empty(data: Any) -> dict[str, Any]:
    """C4: printed gains, lambda = 1, every gamma, every P (so structured ones too)."""
    problem = build(data, "eq12-free", "loop-proposed", [c.eq12], with_gamma({"P": symmetric(12)}))
    says = "(12) with lambda = 1 has no P for the printed gains, whatever gamma is"
    return prove_infeasible(problem, faces={"eq12": WITHOUT_GAMMA}, says=says)


def lemma_other_lambda(data: Any) -> dict[str, Any]:
    """C4: printed gains, gamma = 10, lambda free, structured P."""
    problem = lemma(data, "loop-proposed", structured=True, free_tau=True)
    return prove_feasible(
        problem, problem.solve(), says="(12) has a structured P for the printed gains at another lambda"
    )


def lemma_ref39(data: Any) -> dict[str, Any]:
    """C4: the gains of [39], lambda = 1, gamma = 10, P free."""
    problem = build(data, "eq12-free", "loop-ref39", [c.eq12], {"P": symmetric(12)})
    return prove_feasible(problem, problem.solve(), says="(12) with the scalars of Table 1 holds for the gains of [39]")


def _torque(data: Any, case: str, start: Any, *, any_gamma: bool) -> Any:
    variables = {**SN, "tau": scalar()}
    return build(
        data,
        "eq12-eq19-eq20",
        case,
        [c.eq12_structured, c.eq19, start],
        with_gamma(variables) if any_gamma else variables,
    )


def start_derived_empty(data: Any) -> dict[str, Any]:
    """C6: (12), (19) and (20) as its proof needs it, theta = 20: nothing for any gamma and lambda."""
    problem = _torque(data, "loop-proposed", c.eq20_derived, any_gamma=True)
    says = "(12), (19), (20 derived), theta = 20: empty for every gamma and lambda"
    return prove_infeasible(problem, faces={"eq12_structured": WITHOUT_GAMMA}, says=says)


def start_printed(data: Any) -> dict[str, Any]:
    """C6: with (20) as printed there is a point, at gamma = 20."""
    problem = _torque(data, "loop-proposed;gamma=20", c.eq20_printed, any_gamma=False)
    return prove_feasible(problem, problem.solve(), says="(12), (19), (20 printed) hold at gamma = 20")


def start_printed_gamma10_empty(data: Any) -> dict[str, Any]:
    """C6: but none at the gamma of Table 1."""
    problem = _torque(data, "loop-proposed", c.eq20_printed, any_gamma=False)
    return prove_infeasible(problem, says="(12), (19), (20 printed) are empty at gamma = 10 for every lambda")


def _scaled_start(data: Any, times: str) -> dict[str, Any]:
    problem = _torque(data, f"loop-proposed;gamma=20;times={times}", c.eq20_printed, any_gamma=False)
    says = f"(12), (19), (20 printed) hold at gamma = 20 for an initial state {times} times that of Table 1"
    return prove_feasible(problem, problem.solve(), says=says)


def start_times10(data: Any) -> dict[str, Any]:
    """C7: the printed conditions accept ten times the initial state."""
    return _scaled_start(data, "10")


def start_times100(data: Any) -> dict[str, Any]:
    """C7: and a hundred times."""
    return _scaled_start(data, "100")
