"""What several readings need: random rational points, refutations that quote their certificates, pivots."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from recontrol.claims import proofs
from recontrol.claims.values import Result
from recontrol.exact.rational import matrix


def random_rational(rng: np.random.Generator, rows: int, columns: int) -> np.ndarray:
    """Exact matrix with small random fractions."""
    return matrix([[f"{int(v)}/11" for v in row] for row in rng.integers(-20, 21, (rows, columns))])


def random_symmetric(rng: np.random.Generator, n: int) -> np.ndarray:
    """Exact symmetric matrix with small random fractions."""
    M = random_rational(rng, n, n)
    return M + M.T


def refuted(certificates: Mapping[str, Any], *names: str, evidence: Mapping[str, Any] | None = None) -> Result:
    """The statement is false because these certificates hold; what they say stands in the evidence."""
    says = {name: certificates[name]["says"] for name in names}
    return proofs.refuted(certificates, *names, evidence={**says, **(evidence or {})})


def drift_limit(certificates: Mapping[str, Any], name: str) -> str:
    """delta_m of the case of a certificate about (13) at a drift bound, as its case writes it."""
    _, *changes = certificates[name]["case"].split(";")
    return dict(change.split("=") for change in changes)["delta_m"]


def pivots(M: np.ndarray, name: str) -> dict[str, Any]:
    """Pivots of L D L' of a symmetric matrix: all positive if and only if it is positive definite."""
    from recontrol.exact.linalg import ldl

    return {f"{name}, pivot {k}": d for k, d in enumerate(ldl(M)[1], start=1)}
