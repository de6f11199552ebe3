"""What several readings need: random rational points, refutations by certificates, loops as exact matrices."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Result, Statement
from recontrol.exact.rational import matrix

PROVEN, REFUTED = fmpq(1), fmpq(-1)


def random_rational(rng: np.random.Generator, rows: int, columns: int) -> np.ndarray:
    """Exact matrix with small random fractions."""
    return matrix([[f"{int(v)}/11" for v in row] for row in rng.integers(-20, 21, (rows, columns))])


def random_symmetric(rng: np.random.Generator, n: int) -> np.ndarray:
    """Exact symmetric matrix with small random fractions."""
    M = random_rational(rng, n, n)
    return M + M.T


def verified(certificates: Mapping[str, Any], *names: str) -> bool:
    """Whether the standalone verifier accepts every certificate named."""
    from recontrol.lmi import verify

    return all(verify.check(certificates[name]).holds for name in names)


def refuted(certificates: Mapping[str, Any], *names: str, evidence: Mapping[str, Any] | None = None) -> Result:
    """The statement is false because these certificates hold; open if one of them does not verify."""
    margin = REFUTED if verified(certificates, *names) else arb(0, 1)
    says = {name: certificates[name]["says"] for name in names}
    return Result(
        Statement({"proof of the contrary": margin}), evidence={**says, **(evidence or {})}, certificate=names[0]
    )


def pivots(M: np.ndarray, name: str) -> dict[str, Any]:
    """Pivots of L D L' of a symmetric matrix: all positive if and only if it is positive definite."""
    from recontrol.exact.linalg import ldl

    return {f"{name}, pivot {k}": d for k, d in enumerate(ldl(M)[1], start=1)}
