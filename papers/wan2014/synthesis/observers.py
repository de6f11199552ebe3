"""Observer gains that place the poles (40) with three outputs: many are possible, the algorithm is not named."""

from __future__ import annotations

from itertools import permutations, product
from typing import Any

import numpy as np

from recontrol.exact.rational import to_float

Array = np.ndarray
STARTS, SWEEPS, SEED = 5, 15, 2014


def poles_of(data: Any) -> list[complex]:
    """The six poles (40), conjugates next to each other."""
    return [s for pole in np.ravel(data.float("poles")) for s in (complex(pole), complex(pole).conjugate())]


def placement(data: Any, model: Any) -> dict[str, Any]:
    """Gains by three algorithms, their distance to the printed one and their worst pole error."""
    import control
    from scipy.signal import place_poles

    A, C, poles = to_float(model["A"]["n_printed"]), data.float("C"), poles_of(data)
    # The algorithm iterates: its default tolerance is coarser than what is compared here.
    found = {"yang_tits": place_poles(A.T, C.T, poles, maxiter=100).gain_matrix.T}
    found["varga"] = np.asarray(control.place_varga(A.T, C.T, poles)).T
    variants = robust_placements(A.T, C.T, poles)
    found["kautsky"] = min(variants, key=lambda L: np.abs(L - data.float("L_corrected")).max())
    target = data.float("L_corrected")
    report = {
        name: {
            "distance": float(np.abs(L - target).max()),
            "pole_error": float(max(np.abs(np.linalg.eigvals(A - L @ C) - s).min() for s in poles)),
        }
        for name, L in found.items()
    }
    report["kautsky"]["tried"] = len(variants)
    return {**found, "report": report}


def robust_placements(A: Array, B: Array, poles: list[complex]) -> list[Array]:
    """Transposed gains by Kautsky, Nichols, Van Dooren's method 0 for complex pairs.

    Each sweep replaces one eigenvector by the vector of its admissible subspace that is most orthogonal to the others;
    orders of the pairs, which member leads, and five starts are varied.
    """
    random = np.random.default_rng(SEED)
    leading = poles[::2]
    spaces = {s: _admissible(A, B, s) for s in leading}
    found = []
    for order in permutations(leading):
        for signs in product((1, -1), repeat=3):
            for _ in range(STARTS):
                vectors = [
                    spaces[s] @ (random.normal(size=3) + 1j * sign * random.normal(size=3))
                    for s, sign in zip(order, signs, strict=True)
                ]
                vectors = [v / np.linalg.norm(v) for v in vectors]
                found.append(_gain(A, B, order, _sweep(vectors, [spaces[s] for s in order])))
    return found


def _admissible(A: Array, B: Array, s: complex) -> Array:
    """Orthonormal basis (6, 3) of the eigenvectors that feedback can give to the pole s."""
    range_of_B = np.linalg.qr(B, mode="complete")[0]
    rest = range_of_B[:, B.shape[1] :].T
    _, _, right = np.linalg.svd(rest @ (A - s * np.eye(len(A))))
    return right[rest.shape[0] :].conj().T


def _sweep(vectors: list[Array], spaces: list[Array]) -> list[Array]:
    for _ in range(SWEEPS):
        for k in range(len(vectors)):
            others = [w for j, v in enumerate(vectors) if j != k for w in (v, v.conj())] + [vectors[k].conj()]
            normal = np.linalg.qr(np.column_stack(others), mode="complete")[0][:, -1]
            projected = spaces[k] @ (spaces[k].conj().T @ normal)
            if np.linalg.norm(projected) > 1e-12:
                vectors[k] = projected / np.linalg.norm(projected)
    return vectors


def _gain(A: Array, B: Array, order: tuple[complex, ...], vectors: list[Array]) -> Array:
    """L (6, 3) with A' - C' L' having these eigenvectors."""
    V = np.column_stack([w for v in vectors for w in (v, v.conj())])
    D = np.diag([t for s in order for t in (s, s.conjugate())])
    closed = (V @ D @ np.linalg.inv(V)).real
    return np.linalg.lstsq(B, A - closed, rcond=None)[0].T
