"""The rigid plant, its uncertainty and the printed loops as exact matrices of the paper's decimals.

``plant`` gives, as rationals (floats by `floats`):

========= ======== ========================================================================
A B C     6x6 ...  x' = A x + B (u + d~), y = C x with x = [q; q'], after elimination of the modes
M0 FF     3x3      J0 - F'F and F'F [kg m^2]
L K       6x12 ... Delta A = L Delta_H K
W         3x6      [0 Xi_J], the non-zero rows of W0
D G N     3x3      matrices of the small-angle model (6)
========= ======== ========================================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact.rational import identity, to_float, zeros
from recontrol.spacecraft.flexible import orbital_matrices, rigid_part
from recontrol.systems.generic import diag, inverse
from recontrol.systems.output_feedback import Controller, closed_loop, extended

# Which delta_i stands in which place of Delta_G and Delta_D (0-based), as in the text after (6).
DELTA_G, DELTA_D = (1, 1, 0, 2, 2, 0), (0, 0, 2, 2, 1, 1)
PRINTED = ("proposed", "ref39")
SUFFIX = {"proposed": "", "ref39": "39"}


def inertia_envelope(data: Any) -> np.ndarray:
    """Delta J_i (3,) [kg m^2], exact."""
    return np.ravel(data["J0"]) * np.ravel(data["inertia_envelope"])


def factors(data: Any) -> dict[str, np.ndarray]:
    """Xi_J (3, 3), Xi_D, Xi_G (3, 6) and Gamma_D, Gamma_G (6, 3) of the inertia uncertainty, exact."""
    d1, d2, d3 = inertia_envelope(data)
    n = data["orbital_rate"]
    z = 0 * n
    Xi_D = np.array([[z, -d1, z, -d3, z, -d2], [z] * 6, [d1, z, d3, z, d2, z]], dtype=object) * n
    Xi_G = np.array([[d2, z, z, z, -4 * d3, z], [z, z, 3 * d1, 3 * d3, z, z], [z, d2, z, z, z, -d1]], dtype=object)
    return {
        "Xi_J": diag(inertia_envelope(data)),
        "Xi_D": Xi_D,
        "Xi_G": Xi_G * (n * n),
        "Gamma_D": data["Gamma_D"].T,
        "Gamma_G": data["Gamma_G"].T,
    }


def plant(data: Any) -> dict[str, np.ndarray]:
    """Matrices of the head of this module, exact."""
    A, B, M0 = rigid_part(data["J0"], data["F"], data["orbital_rate"])
    f = factors(data)
    Mi = inverse(M0)
    D, G, N = orbital_matrices(data["J0"], data["orbital_rate"])
    L = np.vstack([zeros(3, 12), np.hstack([-Mi @ f["Xi_G"], -Mi @ f["Xi_D"]])])
    K = np.vstack([np.hstack([f["Gamma_G"], zeros(6, 3)]), np.hstack([zeros(6, 3), f["Gamma_D"]])])
    C, W = np.hstack([identity(3), zeros(3, 3)]), np.hstack([zeros(3, 3), f["Xi_J"]])
    FF = data["F"].T @ data["F"]
    return {"A": A, "B": B, "C": C, "M0": M0, "FF": FF, "L": L, "K": K, "W": W, "D": D, "G": G, "N": N}


def controller(data: Any, name: str) -> Controller:
    """Printed controller ("proposed" or "ref39"), exact decimals."""
    return Controller(*(data[f"{k}_f{SUFFIX[name]}"] for k in "ABC"))


def controller_box(data: Any, name: str) -> Controller:
    """Rounding box of a printed controller, balls."""
    return Controller(*(data.ball(f"{k}_f{SUFFIX[name]}") for k in "ABC"))


def loop(p: dict[str, np.ndarray], c: Controller) -> dict[str, np.ndarray]:
    """Rigid loop of a controller: A (12, 12), B (12, 3), C (3, 12), W (3, 12), of the entry type of its arguments."""
    B, C = extended(p["B"], p["C"], 6)
    W = np.hstack([p["W"], 0 * p["W"]])
    return {"A": closed_loop(p["A"], p["B"], p["C"], c), "B": B, "C": C, "W": W}


def initial_state(data: Any) -> np.ndarray:
    """x0 = [q(0); qdot(0)] (6, 1), exact."""
    return np.vstack([data["q0"].T, data["qd0"].T])


def floats(matrices: dict[str, Any]) -> dict[str, Any]:
    """The same in doubles."""
    return {name: to_float(M) for name, M in matrices.items()}


def float_controller(c: Controller) -> Controller:
    """A controller in doubles."""
    return Controller(*(to_float(M) for M in c))
