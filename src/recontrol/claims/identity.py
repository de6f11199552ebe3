"""Exact equality of two sides of an identity."""

from __future__ import annotations

import sys
from typing import Any

import flint
import numpy as np

from recontrol.errors import ValueContractError

_EXACT = (flint.fmpq, flint.fmpz, flint.fmpq_poly, flint.fmpz_poly, flint.fmpq_mpoly, flint.fmpz_mpoly, int)


def equal(left: Any, right: Any) -> bool:
    """True iff both sides are exactly equal: arrays entry by entry (a different shape is unequal), polynomials and
    rationals as such, sympy expressions after simplification of the difference.

    Raises ValueContractError for floats and balls, which prove no identity.
    """
    if isinstance(left, np.ndarray) or isinstance(right, np.ndarray):
        if np.shape(left) != np.shape(right):
            return False
        return all(equal(a, b) for a, b in zip(np.ravel(left), np.ravel(right), strict=True))
    if isinstance(left, (tuple, list)) and isinstance(right, (tuple, list)):
        return len(left) == len(right) and all(equal(a, b) for a, b in zip(left, right, strict=True))
    if isinstance(left, str) and isinstance(right, str):
        return left == right
    if isinstance(left, _EXACT) and isinstance(right, _EXACT):
        return bool(left == right)
    if "sympy" in sys.modules:
        return _equal_symbolic(left, right)
    raise ValueContractError(f"no exact identity between {type(left).__name__} and {type(right).__name__}")


def _equal_symbolic(left: Any, right: Any) -> bool:
    import sympy

    if isinstance(left, sympy.MatrixBase) or isinstance(right, sympy.MatrixBase):
        if left.shape != right.shape:
            return False
        return all(_equal_symbolic(a, b) for a, b in zip(left, right, strict=True))
    try:
        sides = [sympy.sympify(side) for side in (left, right)]
        difference = sides[0] - sides[1]
    except (sympy.SympifyError, TypeError):
        raise ValueContractError(
            f"no exact identity between {type(left).__name__} and {type(right).__name__}"
        ) from None
    if any(side.has(sympy.Float) for side in sides):
        raise ValueContractError("the identity contains a float; write the numbers as rationals")
    return sympy.simplify(difference) == 0
