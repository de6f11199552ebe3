"""What several readings need: random rational points, refutations that quote their certificates, pivots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims import proofs
from recontrol.claims.proofs import undecided
from recontrol.claims.values import Result, Statement
from recontrol.exact.linalg import check_symmetric
from recontrol.exact.polynomial import charpoly
from recontrol.exact.rational import matrix
from recontrol.systems.generic import inverse


def random_rational(rng: np.random.Generator, rows: int, columns: int) -> np.ndarray:
    """Exact matrix with small random fractions."""
    return matrix([[f"{int(v)}/11" for v in row] for row in rng.integers(-20, 21, (rows, columns))])


def random_symmetric(rng: np.random.Generator, n: int) -> np.ndarray:
    """Exact symmetric matrix with small random fractions."""
    M = random_rational(rng, n, n)
    return M + M.T


def refuted(
    certificates: Mapping[str, Any], *names: str, evidence: Mapping[str, Any] | None = None, but: Sequence[str] = ()
) -> Result:
    """The statement is false because these certificates hold; what they say stands in the evidence.

    Open if the case of one of them changes a printed scalar other than those named in ``but``.
    """
    shown = {name: certificates[name]["says"] for name in names} | dict(evidence or {})
    changed = {name: changes(certificates, name).keys() - set(but) for name in names}
    if any(changed.values()):
        return Result(Statement(undecided()), evidence=shown)
    return proofs.refuted(certificates, *names, evidence=shown)


def changes(certificates: Mapping[str, Any], name: str) -> dict[str, str]:
    """Scalars that the case of a certificate puts in the place of printed ones, as its case writes them."""
    _, *found = certificates[name]["case"].split(";")
    return dict(change.split("=") for change in found)


def drift_limit(certificates: Mapping[str, Any], name: str) -> str:
    """delta_m of the case of a certificate about (13) at a drift bound, as its case writes it."""
    return changes(certificates, name)["delta_m"]


def proven_as_printed(certificates: Mapping[str, Any], name: str) -> Result:
    """The claim is what the certificate states with the printed scalars; open if its case changes one of them."""
    changed = changes(certificates, name)
    return Result(Statement(undecided()), evidence=changed) if changed else proofs.proven(certificates, name)


def schur(M: np.ndarray, rows: list[int]) -> np.ndarray:
    """Schur complement of the block ``rows`` in an exact M."""
    rest = [i for i in range(len(M)) if i not in rows]
    corner = M[np.ix_(rows, rows)]
    return M[np.ix_(rest, rest)] - M[np.ix_(rest, rows)] @ inverse(corner) @ M[np.ix_(rows, rest)]


def lacking(M: np.ndarray) -> fmpq:
    """Zero if and only if the exact symmetric M is >= 0, else the least of the sums of its principal minors by order.

    Those sums are the coefficients of det(sI + M), whose roots are real: none is positive if all sums are >= 0.
    """
    check_symmetric(M)
    return min([fmpq(0), *charpoly(-M).coeffs()])


def pivots(M: np.ndarray, name: str) -> dict[str, Any]:
    """Pivots of L D L' of a symmetric matrix: all positive if and only if it is positive definite."""
    from recontrol.exact.linalg import ldl

    return {f"{name}, pivot {k}": d for k, d in enumerate(ldl(M)[1], start=1)}
