"""The rendezvous plant and everything that follows from the problem data without any optimisation.

Artifact (rationals unless said otherwise; SI units, time in s, length in m, force in N):

=============== ============ ============================================================================
key             shape        what
=============== ============ ============================================================================
n               {case}       mean motions n_printed, n_orbit and the counter-readings n_circular, n_perigee
A               {case}(6,6)  Clohessy-Wiltshire matrix for n_printed and n_orbit
B, C            (6,3)(3,6)   thrust input and position output
E1, E2          (6,6)        (42); E2 for n_printed and n_orbit
F_canonical     (6,6)        real canonical form of (40) in the printed order
xi0             {case}(12,1) (x(0), e(0)) for the three e(0)
K0_YX           (3,6)        Y X^-1 of the printed decimals, floats: a warning case
observable      {key}        counts of observable output selections
poles           {case}       eigenvalues of A - LC and A - BK, floats
lqr             dict         LQR gain, cost from x(0) and thrust at t = 0, floats
=============== ============ ============================================================================
"""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.spacecraft import orbit

MEAN_MOTION_DIGITS = 9


def mean_motions(data: Any) -> dict[str, fmpq]:
    """Mean motion [rad/s] by reading; what is not printed is rounded to nine significant digits and then exact."""
    gm, r_p, e = (float(data.float(k)) for k in ("gm", "r_p", "e"))
    roots = {"n_orbit": (1 - e) ** 3, "n_circular": 1.0, "n_perigee": 1 + e}
    found = {k: rational.decimal(f"{np.sqrt(gm * f / r_p**3):.{MEAN_MOTION_DIGITS - 1}e}") for k, f in roots.items()}
    return {"n_printed": data["n_printed"], **found}


def uncertainty_factors(data: Any, n: Any, e: Any = None) -> tuple[np.ndarray, np.ndarray]:
    """E1, E2 of (42) for one mean motion (and eccentricity), of the type of `n`."""
    e = data["e"] if e is None else e
    return e * data["E1_e"], n * n * data["E2_nn"] + n * data["E2_n"]


def canonical_observer(data: Any, order: tuple[int, ...] = (0, 1, 2), signs: tuple[int, ...] = (1, 1, 1)) -> np.ndarray:
    """Block-diagonal F (6, 6) [1/s] of the poles (40): blocks [[a, b], [-b, a]] in an order and with signs of b."""
    F = rational.zeros(6)
    for k, (index, sign) in enumerate(zip(order, signs, strict=True)):
        pole = data.printed("poles").rows[0][index]
        a, b = pole.real.value, sign * pole.imag.value
        F[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = [[a, b], [-b, a]]
    return F


def initial_errors(data: Any) -> dict[str, np.ndarray]:
    """e(0) (6, 1) by case."""
    x0, zero = data["x0"], rational.zeros(6, 1)
    velocity = zero.copy()
    velocity[3:] = x0[3:]
    return {"e0_zero": zero, "e0_velocity": velocity, "e0_full": x0}


def plant(data: Any, n: Any) -> dict[str, np.ndarray]:
    """A, B, E1, E2 as exact matrices for one mean motion [rad/s]."""
    E1, E2 = uncertainty_factors(data, n)
    return {"A": orbit.clohessy_wiltshire(n), "B": orbit.thrust_input(data["m"]), "E1": E1, "E2": E2}


def rank(M: np.ndarray) -> int:
    """Exact rank of a rational matrix."""
    return int(rational.to_fmpq_mat(M).rank())


def is_observable(A: np.ndarray, C: np.ndarray) -> bool:
    """Whether (A, C) is observable, by the exact rank of the observability matrix."""
    rows = [C]
    for _ in range(A.shape[0] - 1):
        rows.append(rows[-1] @ A)
    return rank(np.vstack(rows)) == A.shape[0]


def observable_selections(A: np.ndarray) -> list[str]:
    """The diagonal 0/1 output matrices (as words of six digits) that make A observable."""
    found = []
    for word in product("01", repeat=6):
        C = rational.diagonal([int(digit) for digit in word])
        if is_observable(A, C):
            found.append("".join(word))
    return found


def _observability(data: Any, A: np.ndarray, n: fmpq) -> dict[str, Any]:
    frozen = {"M=0": (1, 0), "M=90": (0, 1), "M=180": (-1, 0)}
    counts = {
        case: len(observable_selections(A + orbit.near_circular(n, data["e"], fmpq(c), fmpq(s))))
        for case, (c, s) in frozen.items()
    }
    words = observable_selections(A)
    rule = [w for w in ("".join(p) for p in product("01", repeat=6)) if w[1] == "1" and "1" in (w[2], w[5])]
    return {
        "words": words,
        "count": len(words),
        "all_have_y": all(w[1] == "1" for w in words),
        "rule_y_and_z_or_vz": sorted(words) == sorted(rule),
        "frozen": counts,
    }


def _lqr(A: np.ndarray, B: np.ndarray, x0: np.ndarray) -> dict[str, Any]:
    from scipy.linalg import solve_continuous_are

    P = solve_continuous_are(A, B, np.eye(6), np.eye(3))
    K = B.T @ P
    return {"K": K, "cost": float(x0 @ P @ x0), "thrust": -K @ x0}


def model(data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    motions = mean_motions(data)
    A = {case: orbit.clohessy_wiltshire(motions[case]) for case in ("n_printed", "n_orbit")}
    B, errors = orbit.thrust_input(data["m"]), initial_errors(data)
    A_float, B_float, K = rational.to_float(A["n_printed"]), rational.to_float(B), data.float("K")
    poles = {
        case: np.linalg.eigvals(A_float - data.float(case) @ data.float("C")) for case in ("L_printed", "L_corrected")
    }
    return {
        "n": motions,
        "A": A,
        "B": B,
        "C": data["C"],
        "E1": uncertainty_factors(data, motions["n_printed"])[0],
        "E2": {case: uncertainty_factors(data, motions[case])[1] for case in A},
        "F_canonical": canonical_observer(data),
        "xi0": {case: np.vstack([data["x0"], error]) for case, error in errors.items()},
        "K0_YX": data.float("Y") @ np.linalg.inv(data.float("X")),
        "observable": _observability(data, A["n_printed"], motions["n_printed"]),
        "poles": {case: _sorted(v) for case, v in poles.items()}
        | {"A-BK": _sorted(np.linalg.eigvals(A_float - B_float @ K))},
        "lqr": _lqr(A_float, B_float, data.float("x0")[:, 0]),
    }


def _sorted(values: np.ndarray) -> np.ndarray:
    return np.array(sorted(values, key=lambda s: (round(s.real, 9), s.imag)))
