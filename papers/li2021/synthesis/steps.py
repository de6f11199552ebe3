"""Two-step synthesis: P3 (state feedback), P4 (then (13) at that C_f), P5 (both steps with the torque conditions)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flint import fmpq

from recontrol.exact.rational import rounded, to_float
from recontrol.lmi import solvers
from recontrol.lmi.model import build as build_model
from recontrol.lmi.problem import Problem

from .. import conditions as c
from ..problems import STATE_FEEDBACK, build, theorem, with_gamma
from .solving import NoPointError, centre, controller_of_point, gain_of, largest_margin, least_gamma, point

DECIMALS = 6  # of a C_f that a later step takes as exact data
TORQUE = (c.eq19, c.eq20_derived)
FIRST_STEP_TORQUE = (c.state_feedback_torque, c.state_feedback_start)
PAIRS = {"3/20": ("3", "20"), "3/3": ("3", "3"), "1/3": ("1", "3")}


def first_step(data: Any, case: str, *, torque: bool = False, best: bool = False) -> Problem:
    """(SF), with the torque conditions if asked."""
    conditions = [c.state_feedback, *(FIRST_STEP_TORQUE if torque else ())]
    variables = with_gamma(STATE_FEEDBACK) if best else STATE_FEEDBACK
    return build(data, "state-feedback", case, conditions, variables, best=best)


def central_gain(problem: Problem) -> tuple[Any, dict[str, Any]]:
    """Canonical C_f of a first step (exact, six decimals) and how it was found."""
    start = point(problem.solve(margin="1e-6"))
    x, found = centre(problem, start)
    gain = rounded(gain_of(x), DECIMALS)
    return gain, {"C_f": gain, "X": x["X"], "decrement": found.decrement, "steps": found.steps}


def state_feedback(data: Any) -> dict[str, Any]:
    """P3: least gamma for three lambdas, the central C_f and, for the spread, C_f of other points at lambda = 1."""
    gammas, spread = {}, {}
    for lam in ("1", "3", "10"):
        gammas[lam], solution = least_gamma(first_step(data, f"plant;e2=0.1;lam={lam}", best=True))
        if lam == "1":
            spread["min-gamma"] = gain_of(solution.point)
    problem = first_step(data, "plant;e2=0.1")
    _, found = central_gain(problem)
    spread["margin"] = gain_of(point(largest_margin(problem)))
    spread["logdet"] = gain_of(_largest_ellipsoid(problem))
    return {"gamma": gammas, "centre": found, "spread": spread}


def _largest_ellipsoid(problem: Problem) -> Any:
    """Point that maximises log det X, an objective that is not linear. Raises NoPointError."""
    import cvxpy

    model = build_model(problem, fmpq(0))
    v = problem.variables["X"]
    X = cvxpy.reshape(v.basis() @ model.unknowns["X"], v.shape, order="C")
    program = cvxpy.Problem(cvxpy.Maximize(cvxpy.log_det(X)), model.problem.constraints)
    run = solvers.run(program, solvers.profile("CLARABEL"))
    found = replace(model, problem=program).point_of(run) if run.outcome == solvers.OPTIMAL else None
    if found is None:
        raise NoPointError(f"largest log det X: CLARABEL says {run.words}")
    return found


def two_step(data: Any) -> dict[str, Any]:
    """P4: (13) at the central C_f of P3 (lambda = 1), gamma = 10: which multipliers work, and least gamma of "diag"."""
    gain, found = central_gain(first_step(data, "plant;e2=0.1"))
    design, record = _second_step(data, gain, "plant", ())
    return {"C_f": gain, "centre": found, "design": design, **record}


def torque(data: Any) -> dict[str, Any]:
    """P5: both steps with the torque conditions for three pairs (lambda, theta); the design is that of (3, 20)."""
    out: dict[str, Any] = {"pairs": {}}
    for name, (lam, theta) in PAIRS.items():
        case = f"plant;e2=0.1;lam={lam};theta={theta}"
        gamma, _ = least_gamma(first_step(data, case, torque=True, best=True))
        gain, found = central_gain(first_step(data, case, torque=True))
        design, record = _second_step(data, gain, f"plant;theta={theta}", TORQUE)
        out["pairs"][name] = {"gamma-first": gamma, "C_f": gain, "centre": found, "design": design, **record}
    first = out["pairs"]["3/20"]
    return out | {"C_f": first["C_f"], "design": first["design"]}


def _second_step(data: Any, gain: Any, case: str, conditions: tuple[Any, ...]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Controller of (13) with "diag" at gamma = 10, the analytic centre, and the least gamma given C_f."""
    problem = theorem(data, "diag", case, gains=False, found={"C_f": gain}, torque=conditions)
    solution = problem.solve()
    x, found = centre(problem, point(solution))
    gamma, _ = least_gamma(theorem(data, "diag", case, gains=False, found={"C_f": gain}, torque=conditions, best=True))
    record = {"gamma": gamma, "solution": solution.record(), "point": x, "decrement": found.decrement}
    return controller_of_point(x, to_float(gain))._asdict(), record
