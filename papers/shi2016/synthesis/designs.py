"""Well-posed designs on the paper's data: every one bounds the effort of u = Kx by that of a published gain.

Norms of a gain that was found are recomputed in balls from the stored rational gain; certified values come with a
proven point. Everything is in SI units; gains in N m/rad and N m s/rad.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import exact_midpoint, midpoint, precision, to_ball
from recontrol.exact.linalg import is_positive_definite
from recontrol.exact.rational import decimal, from_float, rounded
from recontrol.lmi import enclosure
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError, prove_feasible

from .. import plant, problems, riccati

LEVELS = ("1.001", "1.01", "1.1", "2")
E1 = ("0.3", "0.1", "0.03", "0.01", "0.003")
E2 = ("1", "0.3", "0.1", "0.03")
EFFORTS = ("trad", "0.5", "0.6", "0.8", "ext")
MARGINS = ("1e-8", "1e-7", "1e-6")


def effort_of(data: Any, gain: str) -> fmpq:
    """Effort of a published gain, rounded down to 12 decimals [s^-1/2]."""
    rate = plant.exact_rate(data)
    with precision(plant.BITS):
        effort = riccati.effort_squared(plant.matrices(data, rate), data[plant.GAINS[gain]]).sqrt()
        return fmpq(int(float((effort * 10**12).mid().floor())), 10**12)


def scaled_effort(data: Any, effort: fmpq, name: str) -> fmpq:
    """Squared effort in the units of `plant.SCALES`."""
    return effort**2 / plant.scale_factors(data, name)["ws"]


def performance(data: Any, K: np.ndarray, name: str) -> dict[str, Any]:
    """h2, effort and H-infinity norm of the loop with a float gain in scaled units; the gain in SI units."""
    from recontrol.systems.norms import hinf_norm
    from recontrol.systems.stability import is_hurwitz

    exact = rounded(K, 12)
    with precision(plant.BITS):
        matrices, factors = plant.scaled(data, plant.exact_rate(data), name), plant.scale_factors(data, name)
        loop = plant.closed_loop(matrices, exact)
        if not is_hurwitz(loop):
            return {"stable": False}
        peak = hinf_norm(loop, matrices["B2"], to_ball(matrices["C1"] + exact), matrices["D2"], rtol=1e-7)
        poles = np.linalg.eigvals(midpoint(loop)) * float(factors["ws"])
        return {
            "stable": True,
            "h2": (riccati.h2_squared(matrices, exact) * factors["h"]).sqrt(),
            "effort": (riccati.effort_squared(matrices, exact) * factors["ws"]).sqrt(),
            "hinf": peak.value * data["z_weight"],
            "K": plant.units(data, name).gain(midpoint(exact), back=True),
            "spectral_abscissa": float(poles.real.max()),
        }


def certified(problem: Problem) -> tuple[dict[str, Any] | None, dict[str, Any]]:
    """A point that is proven to satisfy the problem (None if no back-off suffices), and the solver's plain record."""
    plain = problem.solve()
    for margin in MARGINS:
        answer = problem.solve(margin=margin)
        if not answer.has_point:
            continue
        try:
            proof = prove_feasible(problem, answer)
        except NotProvenError:
            continue
        return {
            "point": answer.point,
            "value": answer.value,
            "digest": proof["digest"],
            "margin": margin,
        }, plain.record()
    return None, plain.record()


def _certified_h2(data: Any, problem: Problem, name: str, X: str = "X", W: str = "W", P: str = "X") -> dict[str, Any]:
    """Proven gamma2 of a design and the true performance of its gain."""
    found, record = certified(problem)
    out: dict[str, Any] = {"outcome": record["outcome"], "words": record["words"], "certified": None}
    if found is None:
        return out
    h = float(arb(plant.scale_factors(data, name)["h"]))
    bound = float(np.trace(np.asarray(found["point"][P])[:3, :3]))
    out |= {"certified": float(np.sqrt(h * bound)), "optimal": float(np.sqrt(h * record["value"]))}
    out |= {"margin": found["margin"], "digest": found["digest"]}
    return out | performance(data, problems.gain_of(found["point"], X, W), name)


def h2_effort(data: Any) -> dict[str, Any]:
    """Least H2 norm at the effort of each published gain: proven bounds, the optimal gain, the distance of the
    print."""
    return {gain: _h2_effort(data, gain) for gain in plant.GAINS}


def _h2_effort(data: Any, gain: str) -> dict[str, Any]:
    effort = effort_of(data, gain)
    bound = scaled_effort(data, effort, gain)
    matrices, factors = plant.scaled(data, plant.exact_rate(data), gain), plant.scale_factors(data, gain)
    weight = _weight_for(matrices, float(arb(bound)))
    K = _regulator(matrices, weight)[1]
    lower = _dual_bound(matrices, weight, bound)
    answer = problems.h2_effort(data, gain, bound).solve()
    with precision(plant.BITS):
        published = riccati.h2_squared(matrices, plant.scaled_gain(data, gain)) * factors["h"]
        best = performance(data, K, gain)
        floor = (lower * factors["h"]).sqrt()
        return best | {
            "effort_bound": effort,
            "h2_lower": floor,
            "h2_closed": _closed_form(data, effort),
            "h2_solver": float(np.sqrt((answer.value or 0.0) * float(arb(factors["h"])))),
            "outcome": answer.outcome,
            "published_over_optimum": published.sqrt() / floor,
        }


def _closed_form(data: Any, effort: fmpq) -> arb:
    """Least H2 norm of three decoupled double integrators at an effort, h2 effort^3 = (3 sqrt(3)/8)(sum
    J_i^{-1/2})^2."""
    return plant.pareto_constant(data) / arb(effort) ** 3


def _regulator(matrices: dict[str, np.ndarray], weight: float, shift: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """P and K = -B'P/weight of the regulator with cost |z2|^2 + weight |u|^2 - shift |x|^2 (floats, scaled units)."""
    from scipy.linalg import solve_continuous_are

    A, B, C = (midpoint(matrices[name]) for name in ("A", "B1", "C2"))
    P = solve_continuous_are(A, B, C.T @ C - shift * np.eye(6), weight * np.eye(3))
    return P, -B.T @ P / weight


def _weight_for(matrices: dict[str, np.ndarray], bound: float) -> float:
    """Weight whose regulator has a squared effort just below ``bound``."""
    from scipy.linalg import solve_continuous_lyapunov
    from scipy.optimize import brentq

    A, B = midpoint(matrices["A"]), midpoint(matrices["B1"])

    def surplus(log_weight: float) -> float:
        K = _regulator(matrices, float(np.exp(log_weight)))[1]
        X = solve_continuous_lyapunov(A + B @ K, -B @ B.T)
        return float(np.trace(K @ X @ K.T)) / bound - 1 + 1e-9

    return float(np.exp(brentq(surplus, -12.0, 6.0, xtol=1e-13)))


def _dual_bound(matrices: dict[str, np.ndarray], weight: float, bound: fmpq) -> arb:
    """Proven lower bound of the squared H2 norm of every K with squared effort <= bound, scaled units.

    For any weight and P with A'P + PA - P B1 B1'P / weight + C2'C2 >= 0: h2^2 >= Tr(B2'P B2) - weight * bound. Raises
    NotProvenError if the inequality is not proven for the P that was found.
    """
    exact_weight = from_float(weight)
    P = rounded(_regulator(matrices, weight, shift=1e-10)[0], 14)
    P = (P + P.T) * fmpq(1, 2)
    A, B, C = matrices["A"], matrices["B1"], matrices["C2"]
    product = A.T @ P
    residual = product + product.T - P @ B @ B.T @ P * (1 / exact_weight) + C.T @ C
    if not is_positive_definite(exact_midpoint(residual)):
        raise NotProvenError("the dual point of the regulator is not proven")
    return arb(np.trace(matrices["B2"].T @ P @ matrices["B2"]) - exact_weight * bound)


def single(data: Any) -> dict[str, Any]:
    """One Lyapunov matrix for both norms at the effort of K_ext, in both normalisations of (8)."""
    effort = effort_of(data, "ext")
    bound = scaled_effort(data, effort, "ext")
    std = {g: _certified_h2(data, problems.single(data, "std", decimal(g), bound), "ext") for g in LEVELS}
    printed: dict[str, Any] = {}
    for g in LEVELS:
        problem = problems.single(data, "print", decimal(g), bound)
        printed[g] = {solver: problem.solve(solver, time_limit=20).words for solver in ("CLARABEL", "CVXOPT", "SDPA")}
        printed[g]["least_effort"] = _least_effort(data, decimal(g))
    ten = decimal("10")
    for name, factor in (("10", 1), ("10, ten times the effort", 100)):
        printed[name] = _printed_design(data, problems.single(data, "print", ten, bound * factor))
    return {"effort": effort, "std": std, "print": printed}


def _least_effort(data: Any, g: fmpq) -> arb:
    """Ball around the least effort that (8) as printed certifies for any gain at level g [s^-1/2], proven."""
    found = enclosure.enclose(problems.least_effort(data, g))
    unit = 1 / data["z_weight"] * plant.scale_factors(data, "orbit")["ws"]
    with precision(plant.BITS):
        return (arb(found.lower) * unit).sqrt().union((arb(found.upper) * unit).sqrt())


def _printed_design(data: Any, problem: Problem) -> dict[str, Any]:
    """(8) with its own normalisation where it is feasible: the bound that it certifies and what its gain does."""
    answer = problem.solve("CVXOPT", time_limit=20)
    out: dict[str, Any] = {"outcome": answer.outcome, "words": answer.words, "certified": None}
    if not answer.has_point or answer.value is None:
        return out
    h8 = float(arb(plant.scale_factors(data, "ext")["h8"]))
    out["certified"] = float(np.sqrt(h8 * answer.value))
    return out | performance(data, problems.gain_of(answer.point), "ext")


def dilated(data: Any) -> dict[str, Any]:
    """Two Lyapunov matrices and one slack: best certified gamma2 over the grid of e1, e2 for each level g."""
    effort = effort_of(data, "ext")
    return {"effort": effort, "levels": {g: _best_dilated(data, decimal(g), effort) for g in LEVELS}}


def _best_dilated(data: Any, g: fmpq, effort: fmpq) -> dict[str, Any]:
    bound, h = scaled_effort(data, effort, "ext"), float(arb(plant.scale_factors(data, "ext")["h"]))
    table: dict[str, dict[str, float | None]] = {}
    for e1 in E1:
        answers = {e2: problems.dilated(data, g, bound, decimal(e1), decimal(e2)).solve() for e2 in E2}
        table[e1] = {
            e2: float(np.sqrt(h * a.value)) if a.outcome == "optimal" and a.value else None for e2, a in answers.items()
        }
    best = min((v, e1, e2) for e1, row in table.items() for e2, v in row.items() if v is not None)
    problem = problems.dilated(data, g, bound, decimal(best[1]), decimal(best[2]))
    return {"grid": table, "e1": best[1], "e2": best[2]} | _certified_h2(data, problem, "ext", "G", "F", "P2")


def nonfragile(data: Any) -> dict[str, Any]:
    """Designs that tolerate Delta K for every abs(F) <= 1, over the effort; least effort with a certificate."""
    ws = float(arb(plant.scale_factors(data, "nonfragile")["ws"]))
    least = {}
    for problem in (problems.nonfragile(data, None), problems.nonfragile_dual(data)):
        for solver in ("CLARABEL", "CVXOPT", "SDPA"):
            answer = problem.solve(solver, time_limit=20)
            value = None if not answer.value or answer.value < 0 else float(np.sqrt(ws * answer.value))
            least[f"{problem.name}, {solver}"] = {"effort": value, "outcome": answer.outcome, "words": answer.words}
    designs = {name: _nonfragile(data, name) for name in EFFORTS}
    return {"designs": designs, "least_effort": least}


def _nonfragile(data: Any, name: str) -> dict[str, Any]:
    effort = effort_of(data, name) if name in plant.GAINS else decimal(name)
    problem = problems.nonfragile(data, scaled_effort(data, effort, "nonfragile"))
    out = {"effort_bound": effort} | _certified_h2(data, problem, "nonfragile")
    if out["certified"] is None:
        return out
    from recontrol.systems.periodic import quadratic_stability_radius

    with precision(plant.BITS):
        si = plant.matrices(data, plant.exact_rate(data))
        loop = plant.closed_loop(si, from_float(np.asarray(out["K"])))
        out["radius"] = quadratic_stability_radius(loop, si["B1"] @ data["M"], data["N"])
    return out
