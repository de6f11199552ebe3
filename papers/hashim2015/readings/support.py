"""What several readings need: margins of a Routh test, evidence for the errata sheet."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq_poly

from recontrol.exact.polynomial import monic, routh_column

UNUSED = "none depends on it"


def used(numbers: str, correct: str = "") -> dict[str, str]:
    """Evidence for the errata sheet: whether the paper's own numbers used the right version, and the correct form."""
    return {"correct form": correct, "numbers": numbers} if correct else {"numbers": numbers}


def descending(row: np.ndarray) -> fmpq_poly:
    """Polynomial from coefficients printed in descending powers, (1, n+1)."""
    return fmpq_poly(list(reversed(row.ravel().tolist())))


def routh_margins(p: Any, name: str = "Routh") -> dict[str, Any]:
    """First column of Routh's array of the monic ``p`` below the leading 1: all positive exactly if p is Hurwitz."""
    return {f"{name} {k}": value for k, value in enumerate(routh_column(monic(p))[1:], start=1)}


def coefficient_margins(p: Any, name: str = "coefficient") -> dict[str, Any]:
    """Coefficients of the monic ``p``: a negative one proves a root outside the open left half plane."""
    return {f"{name} of s^{k}": value for k, value in enumerate(monic(p).coeffs()[:-1])}
