"""Writing certificates: rationals and balls as text, conditions by name, and the digest at the end."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import arb

from recontrol.exact import ball, rational
from recontrol.lmi import verify
from recontrol.lmi.affine import AffineMatrix, is_zero
from recontrol.lmi.conditions import Condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import Variable

LARGEST = 1000
"""Rows or columns of a variable; a file that asks for more wants memory, not a check."""


def entry(x: Any) -> Any:
    """ "p/q" of a rational, {"mid", "rad"} of a ball."""
    if isinstance(x, arb):
        if not x.is_finite():
            raise ValueError("a ball that is not finite cannot be stored")
        return {"mid": rational.text(ball.exact_midpoint(x)), "rad": rational.text(ball.exact_radius(x))}
    return rational.text(x)


def encode(value: Any) -> Any:
    """Entry, or nested lists of entries for a matrix."""
    return [[entry(x) for x in row] for row in value] if isinstance(value, np.ndarray) else entry(value)


def decode(value: Any) -> Any:
    """The scalar or object matrix of `encode`."""
    if isinstance(value, list):
        out = np.empty((len(value), len(value[0])), dtype=object)
        out[...] = verify.dense(value)
        return out
    return verify.number(value)


def encode_variable(v: Variable) -> dict[str, Any]:
    """Shape and structure of a variable."""
    return {"shape": list(v.shape), "entries": [list(e) for e in v.entries], "symmetric": v.is_symmetric}


def decode_variable(stored: Mapping[str, Any]) -> Variable:
    """The variable of `encode_variable`. Raises CertificateError for one that makes no sense."""
    entries = tuple((i, j, k, s) for i, j, k, s in stored["entries"])
    if not all(type(number) is int and number >= 0 for e in entries for number in e[:3]):
        raise verify.CertificateError("places and unknowns of a variable are whole numbers")
    if {e[2] for e in entries} != set(range(len({e[2] for e in entries}))):
        raise verify.CertificateError("the unknowns of a variable are not numbered from 0")
    if (
        len(stored["shape"]) not in (0, 2)
        or max([0, *stored["shape"]]) > LARGEST
        or any(e[3] not in (1, -1) for e in entries)
    ):
        raise verify.CertificateError("a variable with entries other than unknowns, or too large to be checked")
    return Variable(tuple(stored["shape"]), entries, max(e[2] for e in entries) + 1, bool(stored["symmetric"]))


def encode_condition(c: Condition) -> dict[str, Any]:
    """Name, place and binding of a condition."""
    return {
        "name": c.name,
        "function": c.path,
        "sense": c.sense,
        "rename": dict(c.rename),
        "given": dict(c.given),
    }


def normal_sense(c: Condition) -> str:
    """Sense after the sign was turned: ">", ">=" or "="."""
    return {"<": ">", "<=": ">="}.get(c.sense, c.sense)


def encode_form(c: Condition, form: AffineMatrix) -> dict[str, Any]:
    """Sparse affine coefficients: upper triangle of symmetric matrices, every entry for equalities."""
    return {
        "name": c.name,
        "sense": normal_sense(c),
        "size": form.shape[0],
        "constant": _sparse(dict(np.ndenumerate(form.constant)), upper=not c.is_equality),
        "coefficients": {str(i): _sparse(M, upper=not c.is_equality) for i, M in form.coefficients.items()},
    }


def _sparse(M: Mapping[Any, Any], *, upper: bool) -> list[list[Any]]:
    return [[i, j, entry(x)] for (i, j), x in sorted(M.items()) if not (upper and j < i) and not is_zero(x)]


def header(problem: Problem, statement: str, proof: str, says: str, precision: int, notes: Mapping[str, str]) -> dict:
    """Keys that every certificate has."""
    return {
        "schema": verify.SCHEMA,
        "statement": statement,
        "proof": proof,
        "says": says,
        "paper": problem.paper,
        "problem": problem.name,
        "case": problem.case,
        "conditions": [encode_condition(c) for c in problem.named],
        "data": {name: encode(value) for name, value in problem.data.items()},
        "source": problem.source,
        "variables": {name: encode_variable(v) for name, v in problem.variables.items()},
        "order": list(problem.variables),  # of the unknowns; a file with sorted keys has lost it
        "boxes": {n: [encode(as_matrix(lo)), encode(as_matrix(hi))] for n, (lo, hi) in problem.boxes.items()},
        "precision": precision,
        "notes": dict(notes),
    }


def encode_objective(problem: Problem) -> dict[str, Any]:
    """Objective as a minimisation: place, constant, coefficients by unknown."""
    constant, costs = problem.costs
    stored: dict[str, Any] = {"constant": entry(constant), "coefficients": {str(i): entry(c) for i, c in costs.items()}}
    if problem.objective is not None:
        stored |= {"function": problem.objective.path, "rename": dict(problem.objective.rename)}
    return stored


def finish(certificate: dict[str, Any]) -> dict[str, Any]:
    """The certificate with its digest."""
    certificate["digest"] = verify.digest(certificate)
    return certificate


def as_matrix(value: Any) -> np.ndarray:
    """A matrix as it is, a number as a matrix (1, 1)."""
    return value if isinstance(value, np.ndarray) else np.array([[rational.rational(value)]], dtype=object)
