"""Symbols for the formulas of sections 2.2 to 2.4: matrices whose entries are independent polynomial variables.

An identity that holds for these holds for every plant and gain of the order: 4 for yaw and roll, 2 for pitch.
"""

from __future__ import annotations

from functools import lru_cache
from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

SHAPES = {
    "A": ("n", "n"),
    "B": ("n", 1),
    "C": (1, "n"),
    "K": (1, "n"),
    "L": ("n", 1),
    "x": ("n", 1),
    "xh": ("n", 1),
    "L_r": ("m", 1),
    "x2": ("m", 1),
    "xh2": ("m", 1),
    "xc": ("m", 1),
    "F": ("n", 1),
    "u": (1, 1),
    "y": (1, 1),
    "dy": (1, 1),
    "P": ("n", "n"),
}


@lru_cache(maxsize=2)
def symbols(n: int) -> SimpleNamespace:
    """Matrices of SHAPES with m = n - 1 (object arrays of ``fmpq_mpoly``), P symmetric, and the blocks of (27)."""
    sizes: dict[Any, int] = {"n": n, "m": n - 1, 1: 1}
    shapes = {name: (sizes[r], sizes[c]) for name, (r, c) in SHAPES.items()}
    names = [f"{name}_{i}_{j}" for name, (r, c) in shapes.items() for i in range(r) for j in range(c)]
    variables = iter(fmpq_mpoly_ctx.get(names, Ordering.lex).gens())
    found: dict[str, np.ndarray] = {}
    for name, shape in shapes.items():
        M = np.empty(shape, dtype=object)
        for index in np.ndindex(shape):
            M[index] = next(variables)
        found[name] = M
    P = found["P"]
    for i, j in np.ndindex(n, n):
        if i > j:
            P[i, j] = P[j, i]
    A, B, K = found["A"], found["B"], found["K"]
    blocks = {"A11": A[:1, :1], "A12": A[:1, 1:], "A21": A[1:, :1], "A22": A[1:, 1:]}
    return SimpleNamespace(n=n, **found, **blocks, B1=B[:1], B2=B[1:], K1=K[:, :1], K2=K[:, 1:])


def equal(left: np.ndarray, right: np.ndarray) -> bool:
    """Whether two symbolic arrays of one shape agree in every coefficient."""
    return left.shape == right.shape and all(x == y for x, y in zip(left.flat, right.flat, strict=True))


def shape(M: np.ndarray) -> np.ndarray:
    """The shape of ``M`` as exact numbers, for tests whether two terms may be added."""
    return np.array([[fmpq(k) for k in M.shape]], dtype=object)


def stack(*rows: np.ndarray) -> np.ndarray:
    """Columns of polynomials on top of each other."""
    parts = [x for row in rows for x in row.flat]
    out = np.empty((len(parts), 1), dtype=object)
    for i, part in enumerate(parts):
        out[i, 0] = part
    return out


def lifted(M: np.ndarray, one: fmpq_mpoly) -> np.ndarray:
    """Rational matrix as polynomials; entry by entry, since numpy takes a polynomial for a sequence."""
    out = np.empty(M.shape, dtype=object)
    for index in np.ndindex(M.shape):
        out[index] = one * M[index]
    return out


def symbolic_charpoly(A: np.ndarray) -> list[fmpq_mpoly]:
    """Coefficients c_0..c_n of det(sI - A), c_n = 1, by the Faddeev-LeVerrier recursion."""
    n = A.shape[0]
    one = A[0, 0] * 0 + 1
    coefficients, M = [one], A * 0
    for k in range(1, n + 1):
        shifted = (A @ M) + _scalar(coefficients[0], n)
        trace = sum((A @ shifted).diagonal().tolist(), one * 0)
        coefficients.insert(0, trace * fmpq(-1, k))
        M = shifted
    return coefficients


def _scalar(c: fmpq_mpoly, n: int) -> np.ndarray:
    out = np.empty((n, n), dtype=object)
    for i, j in np.ndindex(n, n):
        out[i, j] = c if i == j else c * 0
    return out
