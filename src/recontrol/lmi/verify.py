"""The standalone verifier of certificate files. It trusts python-flint and the problem data, nothing else here.

A certificate is a JSON object (see docs/lmi.md). Checking has three steps: the digest; the arithmetic of what stands in
the file; and, where the paper's folder is at hand, whether the matrices in the file are the paper's (`rebuild`).

    definite, membership, box   the stored matrices are positive (semi)definite, equalities vanish, entries lie in boxes
    infeasible, exclusion       multipliers Z_c >= 0 with sum <Z_c, M_c(x)> negative for every x in its boxes
    bound                       one of the two, for an optimal value
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from flint import arb, ctx, fmpq, fmpz

SCHEMA = "recontrol/certificate/1"
POINT = ("definite", "membership", "box")
MULTIPLIERS = ("infeasible", "exclusion")
BOXED = ("membership", "exclusion")
"""Statements about boxes; every other one but "bound" is about all values, and has none."""
SENSES = (">", ">=", "=")
KEY = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
"""Key of a paper: the name of its folder, never a path."""
UNREADABLE = (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError, RecursionError)


class CertificateError(ValueError):
    """A file that is no certificate of this schema: key or entry that cannot be read."""


@dataclass(frozen=True)
class Verified:
    """Whether the statement holds, how strongly ("exact", "ball"), and the reason in words."""

    holds: bool
    strength: str
    why: str


def digest(certificate: Mapping[str, Any]) -> str:
    """SHA-256 of the canonical text of everything but the digest."""
    rest = {key: value for key, value in certificate.items() if key != "digest"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return "sha256:" + hashlib.sha256(text.encode()).hexdigest()


def number(entry: Any) -> Any:
    """fmpq of "p/q", or arb of {"mid": "p/q", "rad": "p/q"} (dyadic). Raises CertificateError."""
    try:
        if isinstance(entry, str):
            p, _, q = entry.partition("/")
            return fmpq(fmpz(p), fmpz(q or "1"))  # int() refuses numbers of many digits
        mid, rad = (_dyadic(number(entry[key])) for key in ("mid", "rad"))
        if rad < 0:
            raise ValueError("negative radius")
        return arb(mid, rad)
    except (*UNREADABLE, ZeroDivisionError) as error:
        raise CertificateError(f"expected 'p/q' or a ball, found {entry!r}") from error


def _dyadic(q: fmpq) -> arb:
    shift = int(q.q).bit_length() - 1
    if int(q.q) != 1 << shift:
        raise ValueError("not dyadic")
    return arb((int(q.p), -shift))


def dense(rows: Any) -> list[list[Any]]:
    """Matrix of a nested list of entries. Raises CertificateError for rows of different lengths."""
    if (
        not isinstance(rows, list)
        or not rows
        or not all(isinstance(row, list) and len(row) == len(rows[0]) for row in rows)
    ):
        raise CertificateError(f"expected the rows of a matrix, found {str(rows)[:60]}")
    return [[number(x) for x in row] for row in rows]


def terms(coefficients: Mapping[str, Any]) -> dict[int, Any]:
    """Coefficients by unknown. Raises CertificateError for a key that is no plain index: "00" would hide behind "0"."""
    for key in coefficients:
        if not re.fullmatch("0|[1-9][0-9]*", key):
            raise CertificateError(f"{key!r} is not the number of an unknown")
    return {int(key): value for key, value in coefficients.items()}


def check(certificate: Mapping[str, Any], root: Path | str | None = None) -> Verified:
    """Check digest, arithmetic and, if ``root`` (default: the working directory) holds the paper's folder, the origin.

    Never raises for a bad certificate: `Verified.why` says what is wrong with it.
    """
    try:
        if certificate.get("schema") != SCHEMA:
            return Verified(False, "exact", f"expected schema {SCHEMA}, found {certificate.get('schema')!r}")
        if certificate.get("digest") != digest(certificate):
            return Verified(False, "exact", "the digest does not fit the content: the file was changed")
        alone = arithmetic(certificate)
        if not alone.holds:
            return alone
        return _with_origin(certificate, alone, Path.cwd() if root is None else Path(root))
    except UNREADABLE as error:
        return Verified(False, "exact", f"the certificate cannot be read: {type(error).__name__}: {error}")


def _with_origin(certificate: Mapping[str, Any], alone: Verified, root: Path) -> Verified:
    paper = certificate["paper"]
    if paper and not KEY.fullmatch(paper):
        return Verified(False, "exact", f"{paper!r} is not the key of a paper")
    if not paper or not (root / "papers" / paper / "paper.yaml").is_file():
        return Verified(True, alone.strength, f"{alone.why}; arithmetic alone, no paper folder to rebuild it from")
    from recontrol.lmi.rebuild import origin

    found = origin(certificate, root)
    return Verified(found.holds, alone.strength, f"{alone.why}; {found.why}" if found.holds else found.why)


def arithmetic(certificate: Mapping[str, Any]) -> Verified:
    """Check what stands in the file, without the repository."""
    statement = certificate["statement"]
    side = certificate.get("proof")
    before = ctx.prec
    ctx.prec = min(max(int(certificate["precision"]), 53), 10_000)
    try:
        if statement not in (*POINT, *MULTIPLIERS, "bound") or side not in ("point", "multipliers"):
            return Verified(False, "exact", f"unknown statement {statement!r} with proof {side!r}")
        if statement != "bound" and side != ("point" if statement in POINT else "multipliers"):
            return Verified(False, "exact", f"a statement {statement!r} is not proven by {side}")
        if statement != "bound" and (statement in BOXED) != bool(certificate["boxes"]):
            return Verified(
                False, "exact", f"a statement {statement!r} {'needs' if statement in BOXED else 'has no'} boxes"
            )
        return _point(certificate) if side == "point" else _multipliers(certificate)
    finally:
        ctx.prec = before


# -- a point ----------------------------------------------------------------------------------------------------------


def _point(certificate: Mapping[str, Any]) -> Verified:
    balls = False
    if not certificate["matrices"]:
        return Verified(False, "exact", "no condition was checked")
    for item in certificate["matrices"]:
        _check_sense(item)
        M = dense(item["matrix"])
        balls = balls or _has_balls(M)
        if item["sense"] == "=":
            if any(type(x) is not fmpq or x != 0 for row in M for x in row):
                return Verified(False, "exact", f"{item['name']}: the equality does not hold exactly")
        elif not (positive_definite(M) or (item["sense"] == ">=" and positive_semidefinite(M))):
            return Verified(False, "ball" if balls else "exact", f"{item['name']}: not proven positive definite")
    if problem := _outside(certificate):
        return Verified(False, "exact", problem)
    strength = "ball" if balls else "exact"
    count = f"{len(certificate['matrices'])} condition(s) hold at the stored point"
    if certificate["statement"] != "bound":
        return Verified(True, strength, count)
    costs, x = certificate["objective"], [number(v) for v in certificate["witness"]["unknowns"]]
    parts = (number(c) * x[i] for i, c in terms(costs["coefficients"]).items())
    value = sum(parts, number(costs["constant"]))
    return _compared(value, certificate, strength, count, from_point=True)


def _check_sense(item: Mapping[str, Any]) -> None:
    if item["sense"] not in SENSES:
        raise CertificateError(f"{item['name']}: unknown sense {item['sense']!r}")


def _outside(certificate: Mapping[str, Any]) -> str:
    """Name of a variable that leaves its box, or nothing."""
    for name, (low, high) in certificate["boxes"].items():
        rows = zip(dense(low), dense(certificate["witness"]["point"][name]), dense(high), strict=True)
        if not all(lo <= v <= hi for los, vs, his in rows for lo, v, hi in zip(los, vs, his, strict=True)):
            return f"{name} lies outside its box"
    return ""


# -- multipliers ------------------------------------------------------------------------------------------------------


def _multipliers(certificate: Mapping[str, Any]) -> Verified:
    """Lower bound of c0 + c'x over all x with M_c(x) >= 0, by weak duality.

    c0 + c'x - sum <Z_c, M_c(x)> = (c0 - sum <Z_c, M_c0>) + sum_i (c_i - sum <Z_c, M_ci>) x_i; a bracket of the
    second sum must vanish, or x_i has a box. "Slack" conditions say that a variable is > 0: their Z is the bracket.
    """
    costs = certificate["objective"]
    residual = {i: number(c) for i, c in terms(costs["coefficients"]).items()}
    value, strict_active, balls = number(costs["constant"]), False, False
    slack, boxes = list(certificate["witness"]["slack"]), _unknown_boxes(certificate)
    for form in certificate["forms"]:
        _check_places(form)
        if form["name"] in slack:
            continue
        Z = dense(certificate["witness"]["multipliers"][form["name"]])
        if form["sense"] != "=" and not (positive_definite(Z) or positive_semidefinite(Z)):
            return Verified(False, "exact", f"the multiplier of {form['name']} is not positive semidefinite")
        strict_active |= form["sense"] == ">" and any(x != 0 for row in Z for x in row)
        balls = balls or any(
            isinstance(e[2], dict) for M in (form["constant"], *form["coefficients"].values()) for e in M
        )
        value = value - _inner(Z, form, form["constant"])
        for i, M in terms(form["coefficients"]).items():
            residual[i] = residual.get(i, fmpq(0)) - _inner(Z, form, M)
    for form in certificate["forms"]:
        if form["name"] in slack:
            Z, certain = _take_slack(form, residual)
            if not certain:
                return Verified(False, "ball" if balls else "exact", f"the slack of {form['name']} is not definite")
            strict_active |= form["sense"] == ">" and positive_definite(Z)
    for i, r in residual.items():
        if type(r) is fmpq and r == 0:
            continue
        if i not in boxes:
            return Verified(False, "exact", f"the multipliers do not eliminate {certificate['unknowns'][i]}")
        low, high = boxes[i]
        value = value + _smallest(r * low, r * high)
    strength = "ball" if balls or isinstance(value, arb) else "exact"
    if certificate["statement"] == "bound":
        return _compared(value, certificate, strength, "multipliers eliminate every unknown", from_point=False)
    if costs["coefficients"] or number(costs["constant"]) != 0:
        return Verified(False, "exact", "a proof of infeasibility has no objective")
    if value > 0 or (strict_active and value >= 0):
        where = " in their boxes" if boxes else ""
        return Verified(True, strength, f"multipliers contradict the conditions for every value of the unknowns{where}")
    return Verified(False, strength, f"the multipliers give no contradiction: {value} is not positive")


def _check_places(form: Mapping[str, Any]) -> None:
    """Raise CertificateError for a sense that is unknown or an entry that lies outside the (upper half of the) form."""
    _check_sense(form)
    for entries in (form["constant"], *terms(form["coefficients"]).values()):
        for i, j, _ in entries:
            if not (type(i) is int and type(j) is int and 0 <= i < form["size"] and j >= 0):
                raise CertificateError(f"{form['name']}: no entry ({i}, {j})")
            if form["sense"] != "=" and not i <= j < form["size"]:
                raise CertificateError(f"{form['name']}: entry ({i}, {j}) is below the diagonal or outside")


def order(certificate: Mapping[str, Any]) -> list[str]:
    """Names of the variables as their unknowns are numbered. Raises CertificateError if one is missing or doubled."""
    names = list(certificate["order"])
    if sorted(names) != sorted(certificate["variables"]):
        raise CertificateError("the order is not that of the variables")
    return names


def _unknown_boxes(certificate: Mapping[str, Any]) -> dict[int, tuple[Any, Any]]:
    """Interval of every scalar unknown from the boxes of the variables. Raises CertificateError for an empty one."""
    out: dict[int, tuple[Any, Any]] = {}
    first = 0
    for name in order(certificate):
        entries = certificate["variables"][name]["entries"]
        if name in certificate["boxes"]:
            low, high = (dense(end) for end in certificate["boxes"][name])
            for i, j, k, sign in entries:
                ends = (low[i][j], high[i][j]) if sign > 0 else (-high[i][j], -low[i][j])
                a, b = out.get(first + k, ends)
                out[first + k] = (max(a, ends[0]), min(b, ends[1]))
        first += max(entry[2] for entry in entries) + 1
    if not all(low <= high for low, high in out.values()):
        raise CertificateError("a box is empty")
    if {i: (number(low), number(high)) for i, (low, high) in terms(certificate["unknown_boxes"]).items()} != out:
        raise CertificateError("the boxes of the unknowns are not those of the variables")
    return out


def _inner(Z: list[list[Any]], form: Mapping[str, Any], entries: Any) -> Any:
    """<Z, M> for symmetric M given by its upper triangle [[i, j, value], ...]; for equalities by all its entries."""
    if len(Z) != form["size"]:
        raise CertificateError(f"{form['name']}: the multiplier has another size")
    total: Any = fmpq(0)
    for i, j, entry in entries:
        total = total + _count(form, i, j) * Z[i][j] * number(entry)
    return total


def _count(form: Mapping[str, Any], i: int, j: int) -> int:
    return 1 if i == j or form["sense"] == "=" else 2


def _take_slack(form: Mapping[str, Any], residual: dict[int, Any]) -> tuple[list[list[Any]], bool]:
    """Multiplier of the condition "V > 0" that makes the residuals of V's unknowns vanish; whether it is >= 0."""
    n = form["size"]
    if n > len(form["coefficients"]):
        raise CertificateError(f"{form['name']} is not of the form V > 0")
    Z: list[list[Any]] = [[fmpq(0)] * n for _ in range(n)]
    places: set[tuple[int, int]] = set()
    for i, M in terms(form["coefficients"]).items():
        if len(M) != 1 or number(M[0][2]) != 1 or (M[0][0], M[0][1]) in places:
            raise CertificateError(f"{form['name']} is not of the form V > 0")
        a, b, _ = M[0]
        places.add((a, b))
        Z[a][b] = Z[b][a] = residual.pop(i, fmpq(0)) / _count(form, a, b)
    if form["constant"]:
        raise CertificateError(f"{form['name']} is not of the form V > 0")
    return Z, positive_definite(Z) or positive_semidefinite(Z)


def _smallest(a: Any, b: Any) -> Any:
    if isinstance(a, arb) or isinstance(b, arb):
        return arb(a).min(arb(b))
    return min(a, b)


def _compared(value: Any, certificate: Mapping[str, Any], strength: str, how: str, *, from_point: bool) -> Verified:
    """Hold a proven value against the bound that is stated. Maxima are stored as minima of minus the objective."""
    stated, side, sense = number(certificate["bound"]["value"]), certificate["bound"]["side"], certificate["sense"]
    if sense not in ("min", "max") or not isinstance(stated, fmpq):
        raise CertificateError(f"expected a rational bound of a min or max, found {stated} of {sense!r}")
    if side != ("upper" if from_point == (sense == "min") else "lower"):
        return Verified(False, "exact", f"this proof gives no {side} bound of a {sense}imum")
    target = stated if sense == "min" else -stated
    holds = value <= target if from_point else value >= target
    words = f"{how}: optimal value {'<=' if side == 'upper' else '>='} {certificate['bound']['value']}"
    return Verified(bool(holds), strength, words if holds else f"the proof does not reach the stated bound: {value}")


# -- definiteness -----------------------------------------------------------------------------------------------------


def _has_balls(M: list[list[Any]]) -> bool:
    return any(isinstance(x, arb) for row in M for x in row)


def _symmetric(M: list[list[Any]]) -> bool:
    n = len(M)
    if any(len(row) != n for row in M):
        return False
    pairs = ((M[i][j], M[j][i]) for i in range(n) for j in range(i))
    return all(arb(x).overlaps(arb(y)) if isinstance(x, arb) or isinstance(y, arb) else x == y for x, y in pairs)


def positive_definite(M: list[list[Any]]) -> bool:
    """Proof of M > 0 by L D L' in balls, then exactly where all entries are rational. False means "not proven"."""
    if not _symmetric(M):
        return False
    if _pivots_positive([[arb(x) for x in row] for row in M]):
        return True
    return not _has_balls(M) and _pivots_positive([list(row) for row in M])


def _pivots_positive(W: list[list[Any]]) -> bool:
    n = len(W)
    for k in range(n):
        if not W[k][k] > 0:
            return False
        for i in range(k + 1, n):
            if type(W[i][k]) is fmpq and W[i][k] == 0:
                continue
            factor = W[i][k] / W[k][k]
            for j in range(k + 1, i + 1):
                W[i][j] = W[i][j] - factor * W[j][k]
    return True


def positive_semidefinite(M: list[list[Any]]) -> bool:
    """Whether the rational matrix M >= 0, exactly. Balls: False."""
    if _has_balls(M) or not _symmetric(M):
        return False
    W, n = [list(row) for row in M], len(M)
    for k in range(n):
        if W[k][k] < 0 or (W[k][k] == 0 and any(W[i][k] != 0 for i in range(k + 1, n))):
            return False
        for i in range(k + 1, n):
            if W[i][k] != 0:
                factor = W[i][k] / W[k][k]
                for j in range(k + 1, i + 1):
                    W[i][j] = W[i][j] - factor * W[j][k]
    return True


def main(argv: list[str], root: Path | str | None = None) -> int:
    """Verify the files of the command line against the papers under ``root``, as in `check`.

    Returns 0 if every statement holds, 1 if one does not, 2 for a file that cannot be read. What a file says of itself
    is shown as its own words: `Verified.why` alone was checked.
    """
    if not argv or any(a.startswith("-") for a in argv):
        print("usage: recontrol verify FILE...", file=sys.stderr)
        return 2
    code = 0
    for name in argv:
        try:
            certificate = json.loads(Path(name).read_text(encoding="utf-8"))
            if not isinstance(certificate, dict):
                raise CertificateError("not a JSON object")
        except (OSError, ValueError, RecursionError) as error:
            print(f"{name}: cannot be read: {error}")
            code = 2
            continue
        found = check(certificate, root)
        says = f" (in the file's own words: {certificate['says']})" if found.holds and certificate.get("says") else ""
        print(f"{name}: {'holds' if found.holds else 'REFUSED'}, {found.strength}: {found.why}{says}")
        code = max(code, 0 if found.holds else 1)
    return code


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
