"""Whether the matrices of a certificate are the paper's: conditions and data are called again and must agree.

The data come from the certificate's ``source``, a function of (data, case) in the paper's folder, called with
paper.yaml. A datum that the source does not give (a gain that was found, a bound of an exponential) is named.

The box of a variable V is "box of V" of the source, a pair (low, high); where the source gives none and paper.yaml
prints a V, it is the rounding box of the print. Any other box is named too.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact import ball
from recontrol.lmi import certificate as write
from recontrol.lmi import verify
from recontrol.lmi.conditions import Condition, Objective
from recontrol.lmi.problem import Problem
from recontrol.lmi.verify import CertificateError, Verified


def origin(stored: Mapping[str, Any], root: Path) -> Verified:
    """Rebuild the matrices of ``stored`` from the paper's folder under ``root`` and compare. Names what differs."""
    try:
        with _importable(root), ball.precision(int(stored["precision"])):
            problem = rebuild(stored)
            free, wrong = _compare_given(stored, problem, root)
            if wrong:
                return Verified(False, "exact", wrong)
            compare = _compare_point if stored["proof"] == "point" else _compare_forms
            wrong = compare(stored, problem) or _compare_objective(stored, problem)
    except Exception as error:  # the paper's own code runs on what the file says, so anything may be raised
        return Verified(False, "exact", f"cannot be rebuilt from the paper: {type(error).__name__}: {error}")
    if wrong:
        return Verified(False, "exact", f"{wrong} is not what the paper's condition gives")
    without = f"; data that the paper does not give: {', '.join(free)}" if free else ""
    case = f", case {stored['case']!r}" if stored["case"] else ""
    return Verified(True, "exact", f"rebuilt from papers/{stored['paper']}{case}: {_stated(problem)}{without}")


def _stated(problem: Problem) -> str:
    """The conditions by the names of their functions and what their arguments are bound to."""
    words = []
    for c in problem.named:
        renamed = {argument: name for argument, name in c.arguments().items() if argument != name}
        bound = ", ".join(f"{argument}={value}" for argument, value in {**renamed, **c.given}.items())
        words.append(f"{c.function.__name__}({bound})" if bound else c.function.__name__)
    return ", ".join(words)


@contextmanager
def _importable(root: Path) -> Iterator[None]:
    place = str(root.resolve())
    sys.path.insert(0, place)
    try:
        yield
    finally:
        sys.path.remove(place)


def locate(path: str, paper: str) -> Callable[..., Any]:
    """The function at "module:name"; raises CertificateError for places outside papers/``paper`` and recontrol.lmi."""
    module, _, name = path.partition(":")
    if not f"{module}.".startswith((f"papers.{paper}.", "recontrol.lmi.")) or not name.isidentifier():
        raise CertificateError(f"{path!r} is no function of papers/{paper} or of recontrol.lmi")
    return getattr(importlib.import_module(module), name)


def rebuild(stored: Mapping[str, Any]) -> Problem:
    """The problem of a certificate, its functions imported by name, its data from the file."""
    paper = stored["paper"]
    conditions = [
        Condition(locate(c["function"], paper), c["name"], c["sense"], c["rename"], c["given"])
        for c in stored["conditions"]
    ]
    for c in conditions:
        if (marked := getattr(c.function, "sense", c.sense)) != c.sense:
            raise CertificateError(f"{c.name}: the paper says {marked!r}, the certificate {c.sense!r}")
    costs = stored.get("objective", {})
    objective = None
    if "function" in costs:
        objective = Objective(locate(costs["function"], paper), stored["sense"], costs["rename"])
    return Problem(
        stored["problem"],
        {name: write.decode_variable(stored["variables"][name]) for name in verify.order(stored)},
        conditions,
        {name: write.decode(value) for name, value in stored["data"].items()},
        objective,
        boxes={name: (write.decode(low), write.decode(high)) for name, (low, high) in stored["boxes"].items()},
        paper=stored["paper"],
        case=stored["case"],
        source=stored["source"],
    )


def _compare_given(stored: Mapping[str, Any], problem: Problem, root: Path) -> tuple[list[str], str]:
    """Names of data and boxes that the paper does not give, and a description of the first that differs."""
    from recontrol.paper import load

    data = load(root / "papers" / stored["paper"]).data
    source = stored["source"]
    expected = dict(locate(source, stored["paper"])(data, stored["case"])) if source else {}
    for name, value in problem.data.items():
        if name in expected and not _same(value, expected[name]):
            return [], f"datum {name} differs from paper.yaml (case {stored['case']!r})"
    free = sorted(set(problem.data) - set(expected))
    for name, ends in problem.boxes.items():
        if f"box of {name}" not in expected and name in data:
            expected[f"box of {name}"] = (data[name] - data.half(name), data[name] + data.half(name))
        if f"box of {name}" not in expected:
            free.append(f"box of {name}")
        elif not all(map(_same, ends, expected[f"box of {name}"])):
            return [], f"the box of {name} differs from paper.yaml (case {stored['case']!r})"
    return free, ""


def _same(stored: Any, fresh: Any) -> bool:
    """Equality of rationals; a stored ball must contain the fresh value."""
    a, b = (x if isinstance(x, np.ndarray) else np.array([[x]], dtype=object) for x in (stored, fresh))
    return a.shape == b.shape and all(_covers(x, y) for x, y in zip(a.flat, b.flat, strict=True))


def _covers(x: Any, y: Any) -> bool:
    if isinstance(x, arb):
        # Storing a radius rounds it outwards, so the same box read back is never smaller.
        return x.contains(y if isinstance(y, arb) else arb(y))
    return not isinstance(y, arb) and fmpq(x) == fmpq(y)


def _compare_point(stored: Mapping[str, Any], problem: Problem) -> str:
    point = {name: _unwrapped(write.decode(value), problem, name) for name, value in stored["witness"]["point"].items()}
    if stored["statement"] == "box" and not any(hasattr(c.function, "diagonal") for c in problem.named):
        return "a statement about a box"
    if set(point) != set(problem.variables):  # a datum among them would take the place of the paper's
        return "the list of variables"
    for name, v in problem.variables.items():
        v.exact_vector(point[name])
    values = {**problem.data, **point}
    if [item["name"] for item in stored["matrices"]] != [c.name for c in problem.named]:
        return "the list of conditions"
    for item, c in zip(stored["matrices"], problem.named, strict=True):
        if item["sense"] != write.normal_sense(c) or not _agree(write.decode(item["matrix"]), c.matrix(values)):
            return f"the matrix of {c.name}"
        if not _holds(c, c.matrix(values)):
            return f"the definiteness of {c.name}"
    if stored["statement"] == "bound":
        unknowns = [x for n, v in problem.variables.items() for x in v.exact_vector(point[n])]
        if [verify.number(x) for x in stored["witness"]["unknowns"]] != unknowns:
            return "the list of unknowns"
    return ""


def _holds(c: Condition, M: np.ndarray) -> bool:
    rows = [list(row) for row in M]
    if c.is_equality:
        return all(type(x) is fmpq and x == 0 for x in M.flat)
    return verify.positive_definite(rows) or (not c.is_strict and verify.positive_semidefinite(rows))


def _unwrapped(value: Any, problem: Problem, name: str) -> Any:
    v = problem.variables.get(name)
    return value[0, 0] if v is not None and not v.shape else value


def _agree(stored: Any, fresh: Any) -> bool:
    """Equal rationals entry by entry; balls must overlap (the fresh ones are proven again)."""
    return stored.shape == fresh.shape and all(
        arb(x).overlaps(arb(y)) if isinstance(x, arb) or isinstance(y, arb) else x == y
        for x, y in zip(stored.flat, fresh.flat, strict=True)
    )


def _compare_forms(stored: Mapping[str, Any], problem: Problem) -> str:
    fresh = [write.encode_form(c, problem.forms[c.name]) for c in problem.named]
    if stored["unknowns"] != problem.unknowns:
        return "the list of unknowns"
    for old, new in zip(stored["forms"], fresh, strict=True):
        exact = not problem.forms[new["name"]].has_balls()
        if exact and old != new:
            return f"the coefficients of {new['name']}"
    again = verify.arithmetic({**stored, "forms": fresh, "unknown_boxes": _boxes(problem)})
    return "" if again.holds else f"the proof with fresh coefficients ({again.why})"


def _boxes(problem: Problem) -> dict[str, list[Any]]:
    return {str(i): [write.entry(lo), write.entry(hi)] for i, (lo, hi) in problem.unknown_boxes.items()}


def _compare_objective(stored: Mapping[str, Any], problem: Problem) -> str:
    if stored["statement"] != "bound":
        return ""
    constant, costs = problem.costs
    same = verify.number(stored["objective"]["constant"]) == constant
    found = {i: verify.number(c) for i, c in verify.terms(stored["objective"]["coefficients"]).items()}
    return "" if same and found == costs else "the objective"
