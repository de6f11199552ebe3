"""The derived (21), (22): proven for the published gain and its rounding box, refuted by negative controls."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi import loops
from recontrol.lmi.conditions import Condition, condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import prove_feasible, prove_infeasible
from recontrol.lmi.variables import symmetric

from .. import conditions as c
from .. import problems as pr
from ..points import box_conditions, prove, with_start
from ..synthesis.points import BOTH


def decay_box(data: Any, synthesis: Any) -> dict[str, Any]:
    """Derived (21), (22), (47), V(0) equal to the print: one point for both orbits and every gain in the box."""
    stored = synthesis["points"]["decay"]
    case = f"{stored['case']} gain=box"
    listed, more = box_conditions(data, case, BOTH, stored["point"])
    says = "derived (21), (22), (47) hold for every gain that rounds to (61), with V(0) as printed"
    return prove(data, "decay-box", case, [*listed, *with_start((), c.DERIVED)], stored["point"], says, more)


def functional(data: Any, synthesis: Any) -> dict[str, Any]:
    """The point of largest margin in isotropic units, used for V(t)."""
    stored = synthesis["points"]["functional"]
    says = "derived (21), (22), (47) hold with V(0) as printed (w-print)"
    listed = with_start(("w-print",), c.DERIVED)
    return prove(data, "functional", stored["case"], listed, stored["point"], says)


CONTROLS = {"fast": {"alpha": "0.06"}, "long": {"h": "2.4"}, "minus": {"gain": "minus"}}


def _direction(condition_: Condition, values: Mapping[str, Any]) -> tuple[float, np.ndarray]:
    """Largest eigenvalue of the (negative) condition, and its eigenvector rounded to rationals, as a column."""
    eigenvalues, vectors = np.linalg.eigh(-rational.to_float(condition_.matrix(values)))
    return float(eigenvalues[-1]), rational.rounded(vectors[:, -1:], 9)


def controls(data: Any, synthesis: Any) -> dict[str, Any]:
    """The proven point fails where it must: alpha = 0.06, h = 2.4, the gain -K_bar, and (22) with P_1 halved."""
    point = synthesis["points"]["decay"]["point"]
    listed: list[Condition] = []
    more: dict[str, Any] = {}
    for name, change in CONTROLS.items():
        case = " ".join(f"{key}={value}" for key, value in change.items())
        exact = pr.exact_data(data, case)
        renamed = {key: f"{key}_{name}" for key in ("K", "h", "alpha", "decay")}
        values = {**exact, **point, "decay": exact["decay_above"]}
        for orbit in BOTH:
            A = {"A": pr.ORBITS[orbit]}
            plain = [condition(f, f.__name__, rename=A, faults=c.DERIVED) for f in (c.phi, c.phi_hat)]
            (_, x), which = max(((_direction(p, values), p.name) for p in plain), key=lambda item: item[0][0])
            key = f"x_{name}_{orbit.removeprefix('w-')}"
            along = c.along_phi if which == "phi" else c.along_phi_hat
            listed.append(condition(along, f"{name}[{orbit}]", rename={**A, **renamed, "x": key}, faults=c.DERIVED))
            more |= {key: x, **{renamed[k]: values[k] for k in renamed}}
    listed.append(_halved(data, point, more))
    says = "the stored point violates derived (21) for alpha = 0.06, h = 2.4 and -K_bar, and (22) with P_1 halved"
    return prove(data, "controls", "", listed, point, says, more)


def _halved(data: Any, point: Mapping[str, Any], more: dict[str, Any]) -> Condition:
    """(22) with half of P_1, on the axis where it fails most; its data go to `more`."""
    exact = pr.exact_data(data, "")
    half = {**exact, **point, "P1": point["P1"] * fmpq(1, 2)}
    found = [(_direction(condition(c.thrust, axis=k), half), k) for k in range(3)]
    (_, x), axis = max(found, key=lambda item: item[0][0])
    more |= {"x_half": x, "one_half": fmpq(1, 2)}
    return condition(c.along_thrust, "half", rename={"factor": "one_half", "x": "x_half"}, axis=axis)


def reject_zero(data: Any) -> dict[str, Any]:
    """Without control a constant integral of the error is a solution: xi = xi(t_k) = v, xi' = 0, V' + 2 alpha V > 0."""
    constant = rational.matrix([0] * 6 + [1, 0, 0]).T
    zeta = np.vstack([constant, constant * 0, constant])
    listed = [*pr.decay_conditions(BOTH, c.DERIVED, decay="decay_above"), *pr.definite_conditions()]
    problem = pr.problem(data, "reject-zero", "gain=zero", listed)
    says = "derived (21) has no solution without control"
    return prove_infeasible(problem, multipliers={"phi[w-print]": zeta @ zeta.T}, says=says)


def _loop_matrices(data: Any, gain: str) -> dict[str, np.ndarray]:
    exact = pr.exact_data(data, f"gain={gain}")
    return {orbit: exact[A] + exact["B"] @ exact["K"] for orbit, A in pr.ORBITS.items()}


def hurwitz_box(data: Any) -> dict[str, Any]:
    """A_bar + B_bar K Hurwitz for both orbits and every gain of the rounding box, by one Lyapunov matrix each."""
    from scipy.linalg import solve_continuous_lyapunov

    variables, listed, matrices, point = {}, [], {}, {}
    for orbit, M in _loop_matrices(data, "box").items():
        tag = orbit.removeprefix("w-")
        middle = ball.midpoint(M)
        P = rational.symmetric_part(rational.rounded(solve_continuous_lyapunov(middle.T, -np.eye(9)), 9))
        variables[f"P_{tag}"], point[f"P_{tag}"], matrices[f"M_{tag}"] = symmetric(9), P, M
        rename = {"P": f"P_{tag}", "M": f"M_{tag}"}
        listed.append(condition(loops.definite, f"P > 0 [{orbit}]", rename=rename))
        listed.append(condition(loops.hurwitz, f"hurwitz [{orbit}]", rename=rename))
    problem = Problem("hurwitz-box", variables, listed, matrices, paper="li2013")
    return prove_feasible(problem, point, says="A_bar + B_bar K is Hurwitz for every gain that rounds to (61)")


def minus_unstable(data: Any) -> dict[str, Any]:
    """A_bar - B_bar K_bar not Hurwitz: P with M'P + P M > 0 that is positive somewhere."""
    from scipy.linalg import solve_continuous_lyapunov

    variables, listed, matrices, point = {}, [], {}, {}
    for orbit, M in _loop_matrices(data, "minus").items():
        tag = orbit.removeprefix("w-")
        P = solve_continuous_lyapunov(rational.to_float(M).T, np.eye(9))
        v = np.linalg.eigh(P)[1][:, -1:]
        variables[f"P_{tag}"] = symmetric(9)
        point[f"P_{tag}"] = rational.symmetric_part(rational.rounded(P, 9))
        matrices |= {f"M_{tag}": M, f"v_{tag}": rational.rounded(v, 6)}
        rename = {"P": f"P_{tag}", "M": f"M_{tag}", "v": f"v_{tag}"}
        listed.append(condition(loops.expanding, f"expanding [{orbit}]", rename=rename))
        listed.append(condition(loops.somewhere_positive, f"somewhere positive [{orbit}]", rename=rename))
    problem = Problem("minus-unstable", variables, listed, matrices, paper="li2013")
    return prove_feasible(problem, point, says="A_bar - B_bar K_bar is not Hurwitz")
