"""The three attitude axes as exact data.

Artifact, one entry per axis: ``yaw``, ``pitch-tf`` (default pitch, coefficient of (2)), ``pitch-ss`` ((9)), ``roll``.

======== ===================== ==============================================================
key      shape                 what
======== ===================== ==============================================================
A B C D  (n,n)(n,1)(1,n)(1,1)  state space in floats; n = 4, pitch 2; the input and time have no printed units
exact    {A, B, C}             the same as rationals
a b      n+1, n                denominator (monic) and numerator, rationals, ascending powers of s
======== ===================== ==============================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

AXES = ("yaw", "pitch-tf", "pitch-ss", "roll")


def complete_column(B: np.ndarray, n: int) -> np.ndarray:
    """Column ``B`` (m, 1) with the zeros that the print lacks for ``n`` states."""
    missing = np.full((n - B.shape[0], 1), fmpq(0), dtype=object)
    return np.vstack([B, missing])


def with_pitch_coefficient(A: np.ndarray, coefficient: fmpq) -> np.ndarray:
    """Pitch state matrix (2, 2) with another coefficient at (1,2)."""
    A = A.copy()
    A[0, 1] = coefficient
    return A


def plants(data: Any) -> dict[str, dict[str, np.ndarray]]:
    """Rational A (n, n), B (n, 1), C (1, n) of each axis."""
    A_pitch = data["A_pitch"]
    return {
        "yaw": {"A": data["A_yaw"], "B": data["B_yaw"], "C": data["C_yaw"]},
        "pitch-tf": {
            "A": with_pitch_coefficient(A_pitch, data["pitch_coefficient"]),
            "B": data["B_pitch"],
            "C": data["C_pitch"],
        },
        "pitch-ss": {"A": A_pitch, "B": data["B_pitch"], "C": data["C_pitch"]},
        "roll": {"A": data["A_roll"], "B": complete_column(data["B_roll"], 4), "C": data["C_roll"]},
    }


def model(data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    return {axis: _entry(plant) for axis, plant in plants(data).items()}


def _entry(plant: dict[str, np.ndarray]) -> dict[str, Any]:
    # Controller form: the first row of A is minus the denominator and C the numerator, both descending.
    A, C = plant["A"], plant["C"]
    denominator = [-x for x in reversed(A[0].tolist())] + [fmpq(1)]
    return {
        "A": A.astype(float),
        "B": plant["B"].astype(float),
        "C": C.astype(float),
        "D": np.zeros((1, 1)),
        "exact": plant,
        "a": np.array(denominator, dtype=object),
        "b": np.array(list(reversed(C[0].tolist())), dtype=object),
    }
