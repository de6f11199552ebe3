"""Matrix exponentials of many linear loops at once. In: a stack of matrices. Out: the stack of their exponentials."""

from __future__ import annotations

from typing import Any

import numpy as np

Array = Any

_PADE13 = (
    64764752532480000.0, 32382376266240000.0, 7771770303897600.0, 1187353796428800.0, 129060195264000.0,
    10559470521600.0, 670442572800.0, 33522128640.0, 1323241920.0, 40840800.0, 960960.0, 16380.0, 182.0, 1.0,
)  # fmt: skip
_THETA13 = 5.371920351148152


def batched_expm(matrices: Array) -> Array:
    """exp of each matrix of a stack (runs, n, n), by scaling and squaring with the Pade approximant of degree 13.

    One scaling for the whole stack: the largest 1-norm decides. Source: Higham, The scaling and squaring method for the
    matrix exponential revisited, SIAM J. Matrix Anal. Appl. 26 (2005), algorithm 2.3. Raises ValueError for a stack
    that is not square or not finite.
    """
    a = np.asarray(matrices, dtype=float)
    if a.ndim != 3 or a.shape[1] != a.shape[2]:
        raise ValueError(f"expected a stack (runs, n, n), found shape {a.shape}")
    if not np.all(np.isfinite(a)):
        raise ValueError("a matrix of the stack is not finite")
    norm = float(np.max(np.sum(np.abs(a), axis=1), initial=0.0))
    squarings = max(0, int(np.ceil(np.log2(norm / _THETA13)))) if norm > _THETA13 else 0
    a = a / 2.0**squarings
    b = _PADE13
    eye = np.eye(a.shape[1])
    a2 = a @ a
    a4 = a2 @ a2
    a6 = a4 @ a2
    odd = a @ (a6 @ (b[13] * a6 + b[11] * a4 + b[9] * a2) + b[7] * a6 + b[5] * a4 + b[3] * a2 + b[1] * eye)
    even = a6 @ (b[12] * a6 + b[10] * a4 + b[8] * a2) + b[6] * a6 + b[4] * a4 + b[2] * a2 + b[0] * eye
    result = np.linalg.solve(even - odd, even + odd)
    for _ in range(squarings):
        result = result @ result
    return result
