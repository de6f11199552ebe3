"""The compensated system (55)-(57) and the stability of the full-order loop."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.claims.values import Result, Size, Statement
from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION, charpoly
from recontrol.exact.rational import identity, zeros

from ..loops import full_loop, printed_gain, printed_gain_box
from ..recipe import Plant, plant_of
from .support import UNUSED, routh_margins, used

HALF = 4
CURVES = "no printed number comes from (55); curves that did would have the gain fed back twice"


def _embed(block: np.ndarray, row: int, column: int) -> np.ndarray:
    """The block inside an 8 x 8 matrix of zeros, so that the claim's mask picks it."""
    M = zeros(2 * HALF, 2 * HALF)
    M[row : row + block.shape[0], column : column + block.shape[1]] = block
    return M


def _parts(model: Any, synthesis: Any) -> tuple[Plant, np.ndarray, np.ndarray, np.ndarray]:
    balls = synthesis["gains"]["yaw"]["balls"]
    return plant_of(model, "yaw"), balls["K"], balls["L"]["typed4"], balls["L"]["exact"]


def eq55_11(model: Any, data: Any) -> Result:
    """A - BK as (26) has it, for every K in the box of (52)."""
    plant = plant_of(model, "yaw")
    with precision(PRECISION):
        found = _embed(plant.A - plant.B @ printed_gain_box(data), 0, 0)
    return Result(found, evidence=used(CURVES, "$A - BK$, that is (52)"))


def eq55_11_twice(model: Any, synthesis: Any, data: Any) -> Result:
    """A - 2BK: the closed loop A_c of (52) where (26) has A, so that K is fed back twice."""
    plant, K, *_ = _parts(model, synthesis)
    from_print = data["A_c"] - plant.B @ printed_gain(data)
    with precision(PRECISION):
        twice = plant.A - plant.B @ K - plant.B @ K
    return Result(_embed(twice, 0, 0), evidence={"A_c - BK with the decimals of (52)": from_print[:1]})


def eq55_12(model: Any, data: Any) -> np.ndarray:
    """BK with the gains of (64), (65), anywhere in their boxes."""
    plant = plant_of(model, "yaw")
    K1 = np.empty((1, 1), dtype=object)
    K1[0, 0] = data.ball("K1")
    return _embed(plant.B @ np.hstack([K1, data.ball("K2")]), 0, HALF)


def eq55_12_K(model: Any, synthesis: Any) -> np.ndarray:
    """BK with K.q1."""
    plant, K, *_ = _parts(model, synthesis)
    return _embed(plant.B @ K, 0, HALF)


def eq55_e16(model: Any, data: Any) -> Result:
    """K2(1) from (52) and (6), anywhere in the box."""
    plant = plant_of(model, "yaw")
    box = printed_gain_box(data)
    evidence = {"K2(1) of (65) and its half unit (the intervals touch)": [data["K2"][0, 0], data.half("K2")[0, 0]]}
    evidence |= used("the right version: (66) to (69) follow from the unrounded gain")
    return Result(_embed(plant.B @ box, 0, HALF), evidence=evidence)


def in_error_states(M: np.ndarray) -> np.ndarray:
    """A loop matrix of [x; xh] in the states [x; x - xh] of (26)."""
    one = identity(HALF)
    T = np.block([[one, zeros(HALF)], [one, -one]])  # its own inverse
    return T @ M @ T


def eq55_21(model: Any, data: Any) -> np.ndarray:
    """What drives the estimation error from the state, in the loop of (52), (54) and the compensator A - BK - LC."""
    plant, K, L = plant_of(model, "yaw"), printed_gain(data), data["L"]
    loop = full_loop(plant, K, L, plant.A - plant.B @ K - L @ plant.C)
    return _embed(in_error_states(loop)[HALF:, :HALF], HALF, 0)


def eq55_22(model: Any, data: Any) -> Result:
    """A - LC with (54), anywhere in its box."""
    plant = plant_of(model, "yaw")
    found = _embed(plant.A - data.ball("L") @ plant.C, HALF, HALF)
    return Result(found, evidence=used(CURVES, "$A - LC$, whose second row begins with 1"))


def eq55_22_typed4(model: Any, synthesis: Any) -> Result:
    """A - BK - LC, the compensator's matrix, with L.typed4; the evidence lists what L.exact would give."""
    plant, K, L, L_exact = _parts(model, synthesis)
    with precision(PRECISION):
        Ah, Ah_exact = (plant.A - plant.B @ K - gain @ plant.C for gain in (L, L_exact))
    return Result(_embed(Ah, HALF, HALF), evidence={"with L.exact": Ah_exact})


def eq55_22_exact(model: Any, synthesis: Any) -> np.ndarray:
    """A - BK - LC with L.exact."""
    plant, K, _, L = _parts(model, synthesis)
    with precision(PRECISION):
        return _embed(plant.A - plant.B @ K - L @ plant.C, HALF, HALF)


def eq56_size(model: Any) -> Result:
    """Plant and estimator have n states each."""
    return Result(Size(2 * plant_of(model, "yaw").n, 1), evidence=used(UNUSED))


def eq57_size(model: Any) -> Result:
    """Plant and estimator have n states each."""
    return Result(Size(1, 2 * plant_of(model, "yaw").n), evidence=used(UNUSED))


def eq57_val(model: Any, data: Any) -> np.ndarray:
    """[C 0], as many entries as are printed."""
    C = plant_of(model, "yaw").C
    return np.hstack([C, zeros(1, data["C_ce"].shape[1] - C.shape[1])])


def abs_stable_full(model: Any, data: Any) -> Result:
    """Plant with (64), (65), (54) and the compensator A - BK - LC, the decimals taken as exact."""
    plant = plant_of(model, "yaw")
    K = np.hstack([np.array([[data["K1"]]], dtype=object), data["K2"]])
    M = full_loop(plant, K, data["L"], plant.A - plant.B @ K - data["L"] @ plant.C)
    separated = charpoly(plant.A - plant.B @ K) * charpoly(plant.A - data["L"] @ plant.C)
    evidence = {"characteristic polynomial is the product of controller and estimator": bool(charpoly(M) == separated)}
    return Result(Statement(routh_margins(charpoly(M))), evidence=evidence)
