"""Proofs: a point, a contradiction, an enclosure of an optimal value, each as a certificate that `verify` accepted.

Every function returns a certificate (a JSON-able dict) or raises `NotProvenError`, which says which step failed and is
no refutation. What a function returns has passed `verify.arithmetic`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from recontrol.exact import ball, rational
from recontrol.lmi import certificate as write
from recontrol.lmi import duality, verify
from recontrol.lmi.duality import NotProvenError
from recontrol.lmi.faces import Faced, given_faces
from recontrol.lmi.problem import Problem, Solution
from recontrol.lmi.repair import Multipliers, rationalise, slack_conditions
from recontrol.lmi.solvers import DEFAULT_TIME_LIMIT

__all__ = ["NotProvenError", "prove_feasible", "prove_infeasible", "prove_member", "rounded_point"]

PRECISION = 200


def rounded_point(problem: Problem, point: Mapping[str, Any], decimals: int) -> dict[str, Any]:
    """Exact point in original units from floats, rounded to ``decimals`` decimals in scaled units.

    Structure (symmetry, zeros) is restored, boxes are respected by clipping, and values that are exact already pass
    unchanged.
    """
    out: dict[str, Any] = {}
    for name, v in problem.variables.items():
        given = point[name]
        if ball.is_rigorous(given):
            out[name] = given
            continue
        w = problem.weights[name]
        scaled = np.reshape(np.asarray(given, dtype=float), v.matrix_shape) / rational.to_float(w)
        x = [rational.rounded(float(value), decimals) for value in v.vector(scaled)]
        V = np.reshape(np.array(v.matrix(x), dtype=object), v.matrix_shape) * w
        if name in problem.boxes:
            low, high = (write.as_matrix(end) for end in problem.boxes[name])
            V = np.array([min(max(a, b), c) for a, b, c in zip(V.flat, low.flat, high.flat, strict=True)], dtype=object)
        V = V.reshape(v.matrix_shape)
        out[name] = V if v.shape else V[0, 0]
    return out


def prove_feasible(
    problem: Problem,
    point: Mapping[str, Any] | Solution,
    *,
    decimals: int = 12,
    says: str = "",
    statement: str | None = None,
    precision: int = PRECISION,
    notes: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Certificate that every condition holds at a rational point near ``point``.

    ``point`` holds floats (rounded to ``decimals`` decimals in scaled units) or exact values (kept). A problem with
    boxes gives the statement "membership", else "definite"; ``statement="box"`` for the box lemmas of `loops`. Raises
    NotProvenError naming the condition that fails at the rounded point: back off further, or keep more decimals.
    """
    notes = dict(notes or {})
    if isinstance(point, Solution):
        if not point.has_point:
            words = "; ".join(filter(None, (point.words, point.reason)))
            raise NotProvenError(f"{problem.name}: {point.solver} gave no point ({point.outcome}: {words})")
        notes = {"back_off": point.margin, "solver": point.solver, **notes}
        point = point.point
    exact = rounded_point(problem, point, decimals)
    statement = statement or ("membership" if problem.boxes else "definite")
    says = says or f"{problem.name}: the conditions hold at the stored point"
    return point_certificate(problem, exact, statement, says, precision, notes)


def point_certificate(
    problem: Problem,
    exact: Mapping[str, Any],
    statement: str,
    says: str,
    precision: int,
    notes: Mapping[str, str],
    bound: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Certificate of the conditions at the ``exact`` point, with the matrices that the verifier tests."""
    with ball.precision(precision):
        values = {**problem.data, **exact}
        matrices = [
            {"name": c.name, "sense": write.normal_sense(c), "matrix": write.encode(c.matrix(values))}
            for c in problem.named
        ]
    found = write.header(problem, statement, "point", says, precision, notes)
    found |= {
        "matrices": matrices,
        "witness": {"point": {n: write.encode(write.as_matrix(x)) for n, x in exact.items()}},
    }
    if bound is not None:
        unknowns = [x for n, v in problem.variables.items() for x in v.exact_vector(exact[n])]
        found["witness"]["unknowns"] = [rational.text(x) for x in unknowns]
        found |= {"objective": write.encode_objective(problem), "bound": dict(bound), "sense": objective_sense(problem)}
    return _accepted(problem, write.finish(found))


def prove_infeasible(
    problem: Problem,
    *,
    multipliers: Mapping[str, Any] | None = None,
    faces: Mapping[str, Any] | None = None,
    decimals: int = 12,
    says: str = "",
    precision: int = PRECISION,
    solver: str = "CLARABEL",
    time_limit: float = DEFAULT_TIME_LIMIT,
    notes: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Certificate that no value of the variables (inside their boxes) satisfies the conditions together.

    ``multipliers`` gives exact Z_c >= 0 by condition (left out: zero; slack conditions need none); else they are
    found, rounded to ``decimals`` decimals in scaled units and repaired exactly. ``faces`` restricts a multiplier to
    W Y W' for an exact W (n, r), or to a principal block (list of 0-based rows); without it faces are looked for where
    the multipliers turn out singular. The statement is
    "exclusion" for a problem with boxes, else "infeasible". Raises NotProvenError.
    """
    statement = "exclusion" if problem.boxes else "infeasible"
    says = says or f"{problem.name}: the conditions contradict each other"
    if multipliers is not None:
        exact = given_multipliers(problem, multipliers)
        return multiplier_certificate(problem, exact, statement, says, precision, notes or {})
    failure = NotProvenError(f"{problem.name}: the multipliers' equations cannot be met in rationals")
    for exact, found in _found_multipliers(problem, decimals, solver, time_limit, faces):
        try:
            return multiplier_certificate(problem, exact, statement, says, precision, {**found, **(notes or {})})
        except NotProvenError as error:
            failure = error
    raise failure


def _found_multipliers(
    problem: Problem, decimals: int, solver: str, time_limit: float, faces: Mapping[str, Any] | None
) -> Iterator[tuple[Multipliers, dict[str, str]]]:
    """Exact multipliers worth a try, and notes on how they were found. Raises NotProvenError if there are none."""
    bare = problem if problem.objective is None else replace(problem, objective=None)
    violation = duality.least_violation(bare, solver, time_limit)
    if violation < -duality.FEASIBLE_BY:
        raise NotProvenError(f"{problem.name}: {solver} finds a point with common margin {-violation:.3g}")
    # Homogeneous conditions end at zero: asking them for more than nothing would leave no multipliers.
    needed = violation / 2 if violation > duality.FEASIBLE_BY else 0.0
    start = Faced(bare, given_faces(bare, faces))
    for faced, found in duality.candidates(start, needed, solver, time_limit):
        notes = {"solver": solver, "violation": f"{violation:.3e}", "least_eigenvalue": f"{found.least:.3e}"}
        notes["faces"] = ", ".join(f"{n}: {W.shape[1]} of {W.shape[0]}" for n, W in faced.faces.items())
        with suppress(NotProvenError):
            yield rationalise(faced, found.multipliers, decimals), {k: v for k, v in notes.items() if v}


def given_multipliers(problem: Problem, multipliers: Mapping[str, Any]) -> Multipliers:
    """Multipliers of the caller, zero where none is given. Raises NotProvenError for one that has no condition."""
    slack = [name for name in slack_conditions(problem) if name not in multipliers]
    unknown = set(multipliers) - {c.name for c in problem.named}
    if unknown:
        raise NotProvenError(f"{problem.name}: multipliers for {', '.join(sorted(unknown))}, which are no conditions")
    zero = {c.name: rational.zeros(*problem.forms[c.name].shape) for c in problem.named if c.name not in slack}
    return Multipliers({**zero, **{n: write.as_matrix(Z) for n, Z in multipliers.items()}}, tuple(slack))


def multiplier_certificate(
    problem: Problem,
    exact: Multipliers,
    statement: str,
    says: str,
    precision: int,
    notes: Mapping[str, str],
    bound: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Certificate of ``exact`` multipliers, with the affine forms that the verifier adds up."""
    found = write.header(problem, statement, "multipliers", says, precision, notes)
    empty = {"constant": "0", "coefficients": {}}
    found |= {
        "unknowns": problem.unknowns,
        "forms": [write.encode_form(c, problem.forms[c.name]) for c in problem.named],
        "unknown_boxes": {
            str(i): [rational.text(lo), rational.text(hi)] for i, (lo, hi) in problem.unknown_boxes.items()
        },
        "witness": {
            "multipliers": {name: write.encode(Z) for name, Z in exact.matrices.items()},
            "slack": list(exact.slack),
        },
        "objective": empty if bound is None else write.encode_objective(problem),
    }
    if bound is not None:
        found |= {"bound": dict(bound), "sense": objective_sense(problem)}
    return _accepted(problem, write.finish(found))


def prove_member(problem: Problem, *, margin: str = "1e-9", solver: str = "CLARABEL", **options: Any) -> dict[str, Any]:
    """Membership certificate if a rational point of the boxes satisfies the conditions, else exclusion certificate.

    Raises NotProvenError if neither can be proven (the question stays open). Keywords go to both proofs.
    """
    solution = problem.solve(solver, margin=margin)
    first = ""
    if solution.has_point:
        try:
            return prove_feasible(problem, solution, **options)
        except NotProvenError as error:
            first = f"{error}; "
    try:
        return prove_infeasible(problem, solver=solver, **options)
    except NotProvenError as error:
        raise NotProvenError(f"{problem.name}: open: {first}{error}") from error


def _accepted(problem: Problem, found: dict[str, Any]) -> dict[str, Any]:
    checked = verify.arithmetic(found)
    if not checked.holds:
        raise NotProvenError(f"{problem.name}: {checked.why}")
    return found


def objective_sense(problem: Problem) -> str:
    """ "min" or "max"."""
    return "min" if problem.objective is None else problem.objective.sense
