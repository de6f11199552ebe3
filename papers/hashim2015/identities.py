"""Two loops with an eigenvalue that is exactly zero for every gain, proven with symbols for the gains."""

from __future__ import annotations

import numpy as np
from flint import Ordering, fmpq, fmpq_mpoly_ctx

from .loops import full_loop, reduced_loop
from .recipe import Plant, reduced_matrices
from .symbols import lifted, symbolic_charpoly


def _symbols(names: list[str]) -> dict[str, np.ndarray]:
    """Independent variables as 1 x 1 object arrays under their names."""
    variables = fmpq_mpoly_ctx.get(names, Ordering.lex).gens()
    out = {}
    for name, variable in zip(names, variables, strict=True):
        out[name] = np.empty((1, 1), dtype=object)
        out[name][0, 0] = variable
    return out


def ace_loop(plant: Plant) -> tuple[np.ndarray, np.ndarray]:
    """Loop of A - BK - LC with entry (2,1) zero, as ``ace-print`` shows, for symbolic K, L; and its null vector.

    The vector is k1 e4 for the plant and (-(0.1650 + k4), 0, 0, k1) for the estimate, 0.1650 from (6).
    """
    n = plant.n
    names = [f"k{i}" for i in range(1, n + 1)] + [f"l{i}" for i in range(1, n + 1)]
    s = _symbols(names)
    one = s["k1"][0, 0] * 0 + 1
    K = np.hstack([s[name] for name in names[:n]])
    L = np.vstack([s[name] for name in names[n:]])
    A = lifted(plant.A, one)
    Ah = A - plant.B @ K - L @ plant.C
    Ah[1, 0] = one * 0
    vector = lifted(np.full((2 * n, 1), fmpq(0), dtype=object), one)
    vector[n - 1, 0] = s["k1"][0, 0]
    vector[n, 0] = one * plant.A[0, n - 1] - s[f"k{n}"][0, 0]
    vector[2 * n - 1, 0] = s["k1"][0, 0]
    return full_loop(Plant(A, plant.B, plant.C), K, L, Ah), vector


def ace_null_vector_holds(plant: Plant) -> bool:
    """Whether the loop of `ace_loop` annihilates its vector, for every K and L."""
    M, vector = ace_loop(plant)
    return all(x == 0 for x in (M @ vector).ravel()) and any(x != 0 for x in vector.ravel())


def pitch_error_pole_is_zero() -> bool:
    """Pitch with coefficient 0, x1 measured: A22 - L A12 = 0 and a singular loop matrix, for every K and L_r."""
    s = _symbols(["k1", "k2", "l"])
    one = s["l"][0, 0] * 0 + 1
    zero, unit = fmpq(0), fmpq(1)
    plant = Plant(
        lifted(np.array([[zero, zero], [unit, zero]], dtype=object), one),
        np.array([[unit], [zero]], dtype=object),
        np.array([[unit, zero]], dtype=object),
    )
    K, L = np.hstack([s["k1"], s["k2"]]), s["l"]
    design = reduced_matrices(plant, K, L)
    error = plant.A[1:, 1:] - L @ plant.A[:1, 1:]
    loop = reduced_loop(plant, plant.C, design.A, design.B, design.C, design.D)
    return bool(error[0, 0] == 0 and symbolic_charpoly(loop)[0] == 0)
