"""Plants, sizes and statements about them: (1)-(14), (50), (51), sections 1 and 3."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, fmpq

from recontrol.claims.values import Identity, Result, Size, Statement
from recontrol.exact.ball import precision, to_ball
from recontrol.exact.linalg import determinant
from recontrol.exact.polynomial import PRECISION, real_roots

from ..loops import first_state
from ..recipe import Plant, plant_of
from .formulas import krylov
from .support import UNUSED, descending, used

FREQUENCIES = (10, 100)


def _realisation(model: Any, data: Any, axis: str) -> Identity:
    plant = plant_of(model, axis)
    return Identity((plant.b, plant.a), (descending(data[f"{axis}_num"]), descending(data[f"{axis}_den"])))


def eq6_tf(model: Any, data: Any) -> Identity:
    """Numerator and denominator of C (sI - A)^-1 B against (1)."""
    return _realisation(model, data, "yaw")


def eq12_tf(model: Any, data: Any) -> Identity:
    """The same for roll with the completed input matrix."""
    return _realisation(model, data, "roll")


def eq9_tf(model: Any, data: Any) -> Result:
    """A(1,2) that realises (2): the denominator of (9) is s^2 - A(1,2)."""
    plant = plant_of(model, "pitch-tf")
    same_sign = plant.a == descending(np.array([fmpq(1), fmpq(0), -data["pitch_coefficient"]], dtype=object))
    return Result(plant.A[0, 1], evidence={"denominator of (2) realised": bool(same_sign)})


def s21_D(model: Any, case: str) -> Identity:
    """Direct term of the transfer function: the polynomial part of b/a."""
    plant = plant_of(model, case)
    return Identity(plant.b // plant.a, plant.b * 0)


def eq13_size(data: Any) -> Result:
    """As many rows as (12) has states."""
    return Result(Size(data["A_roll"].shape[0], 1), evidence=used("none is printed for roll"))


def s3_ctrb(model: Any, case: str) -> Statement:
    """Square of the determinant of (50): positive if and only if the rank is n."""
    plant = plant_of(model, case)
    return Statement({"det^2": determinant(krylov(plant.A, plant.B)) ** 2})


def s3_obsv(model: Any, case: str) -> Statement:
    """Square of the determinant of (51), output y."""
    plant = plant_of(model, case)
    return Statement({"det^2": determinant(krylov(plant.A.T, plant.C.T)) ** 2})


def eq28_premise(model: Any, case: str) -> Result:
    """C of the axis against [1 0 ... 0]."""
    plant = plant_of(model, case)
    evidence = used("the wrong version: (66) to (69) are the design for $y = x_1$", "$y = Cx$ with (8), (11), (14)")
    return Result(Identity(first_state(plant.n), plant.C), evidence=evidence)


def s3_pole_positive(model: Any) -> Result:
    """The unstable root of the denominator of (2)."""
    return Result(real_roots(plant_of(model, "pitch-tf").a)[-1], evidence=used(UNUSED))


def s3_pole_negative(model: Any) -> arb:
    """The stable root of the denominator of (2)."""
    return real_roots(plant_of(model, "pitch-tf").a)[0]


def s3_pole_square(model: Any) -> fmpq:
    """The square of either root: the coefficient itself."""
    return -plant_of(model, "pitch-tf").a[0]


def s3_imag(model: Any) -> Result:
    """On the imaginary axis if the square of the real part is zero; both roots are real."""
    plant = plant_of(model, "pitch-tf")
    poles = real_roots(plant.a)
    evidence = {"poles [1/s]": np.array(poles, dtype=object), "time constant [s]": 1 / poles[-1]}
    evidence |= used(UNUSED, "one real pole in either half plane")
    return Result(Statement({"minus the square of the real part": plant.a[0]}, strict=False), evidence=evidence)


def s1_order(synthesis: Any, case: str) -> Statement:
    """Order of (22) less order of (44) less the number of outputs, zero both ways."""
    entry = synthesis["gains"][case]
    full, reduced = entry["full"]["exact"], entry["x1"]["exact"]
    surplus = full["A"].shape[0] - reduced["A"].shape[0] - reduced["B"].shape[1]
    return Statement({"surplus": fmpq(surplus), "minus surplus": fmpq(-surplus)}, strict=False)


def s1_sensors(synthesis: Any, case: str) -> Result:
    """Signals that (22) measures less those that (44) measures."""
    entry = synthesis["gains"][case]
    saved = fmpq(entry["full"]["exact"]["B"].shape[1] - entry["x1"]["exact"]["B"].shape[1])
    return Result(Statement({"sensors saved": saved}), evidence=used(UNUSED, "fewer states, as many sensors"))


def gain_at(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, frequency: int) -> arb:
    """abs(C (jw - A)^-1 B + D) in balls."""
    n = A.shape[0]
    resolvent = acb_mat([[acb(-to_ball(A[i, j]), frequency if i == j else 0) for j in range(n)] for i in range(n)])
    response = resolvent.solve(acb_mat([[acb(to_ball(x))] for x in B.ravel()]))
    total = sum((acb(to_ball(C[0, i])) * response[i, 0] for i in range(n)), acb(to_ball(D[0, 0])))
    return abs(total)


def full_compensator(plant: Plant, entry: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A - BK - LC, L, -K, 0 in balls, exact gains."""
    K, L = entry["balls"]["K"], entry["balls"]["L"]["exact"]
    return plant.A - plant.B @ K - L @ plant.C, L, -K, np.array([[fmpq(0)]], dtype=object)


def s1_bandwidth(model: Any, synthesis: Any, case: str) -> Result:
    """Gain from sensor to control of both reduced designs above that of the full order, and in the limit."""
    plant, entry = plant_of(model, case), synthesis["gains"][case]
    margins, evidence = {}, {}
    with precision(PRECISION):
        full = full_compensator(plant, entry)
        for name, design in (("corrected", entry["balls"]["corrected"]), ("x1", entry["balls"]["x1"]["exact"])):
            reduced = tuple(design[key] for key in "ABCD")
            for frequency in FREQUENCIES:
                high, low = gain_at(*reduced, frequency), gain_at(*full, frequency)
                margins[f"{name}, {frequency} rad/s"] = high - low
                evidence[f"gains {name} / full, {frequency} rad/s"] = [high, low]
            margins[f"{name}, limit"] = abs(design["D"][0, 0])
    return Result(Statement(margins), evidence=evidence)
