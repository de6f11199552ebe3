"""The reduced-order compensator: (58)-(69), whether these belong together, and the stability of its loop."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Result, Size, Statement
from recontrol.exact.ball import exact_midpoint, precision
from recontrol.exact.polynomial import PRECISION, charpoly, kharitonov_corners
from recontrol.exact.rational import rounded

from ..intervals import coefficient_polynomials, coefficient_range
from ..loops import first_state, printed_gain, printed_gain_box, printed_reduced, reduced_loop
from ..recipe import partition, plant_of, reduced_matrices
from .support import coefficient_margins, routh_margins, used


def _block(model: Any, index: int) -> np.ndarray:
    plant = plant_of(model, "yaw")
    return partition(plant, plant.C)[index]


def eq58(model: Any) -> np.ndarray:
    """A11 of (6)."""
    return _block(model, 0)


def eq59(model: Any) -> np.ndarray:
    """A12 of (6)."""
    return _block(model, 1)


def eq60(model: Any) -> np.ndarray:
    """A21 of (6)."""
    return _block(model, 2)


def eq61(model: Any) -> np.ndarray:
    """A22 of (6)."""
    return _block(model, 3)


def eq62(model: Any) -> np.ndarray:
    """B1 of (7)."""
    return _block(model, 4)


def eq63(model: Any) -> np.ndarray:
    """B2 of (7)."""
    return _block(model, 5)


def eq64_point(data: Any) -> np.ndarray:
    """K1 from (52) and (6), the decimals taken as exact."""
    return printed_gain(data)[:, :1]


def eq64_K(synthesis: Any) -> np.ndarray:
    """K1 of K.q1."""
    return synthesis["gains"]["yaw"]["balls"]["K"][:, :1]


def eq65_point(data: Any) -> np.ndarray:
    """K2 from (52) and (6), the decimals taken as exact."""
    return printed_gain(data)[:, 1:]


def eq65_K(synthesis: Any) -> Result:
    """K2 of K.q1."""
    numbers = "the right version: (66) to (69) follow from the unrounded gain"
    return Result(synthesis["gains"]["yaw"]["balls"]["K"][:, 1:], evidence=used(numbers))


def _typed(synthesis: Any, name: str) -> np.ndarray:
    return synthesis["gains"]["yaw"]["balls"]["x1"]["typed4"][name]


def eq66_typed4(synthesis: Any) -> np.ndarray:
    """Correct (46) with Lr.typed4 and K.q1."""
    return _typed(synthesis, "A")


def eq67_typed4(synthesis: Any) -> np.ndarray:
    """Correct (47) with Lr.typed4 and K.q1, laid in a row as printed."""
    return _typed(synthesis, "B").T


def eq67_shape(model: Any) -> Result:
    """One row for each state of the compensator, one column for the output."""
    plant = plant_of(model, "yaw")
    numbers = "the right version: (66) to (69) belong to one compensator"
    return Result(Size(plant.n - 1, plant.C.shape[0]), evidence=used(numbers))


def eq68_print(data: Any) -> np.ndarray:
    """-K2 with the decimals of (65)."""
    return -data["K2"]


def eq68_K(synthesis: Any) -> np.ndarray:
    """-K2 of K.q1."""
    return -synthesis["gains"]["yaw"]["balls"]["K"][:, 1:]


def eq69_typed4(synthesis: Any) -> np.ndarray:
    """(49) with Lr.typed4 and K.q1."""
    return _typed(synthesis, "D")


def estimator_gain_sets(model: Any, data: Any, K: np.ndarray, sign: int = 1) -> list[list[arb]]:
    """Enclosures of L_r, one list per column of (66): L_r = (A_r(:,j) - A22(:,j)) / (s K2_j - A12_j).

    sign -1 supposes the printed sign of (46). K is a ball row (1, 4).
    """
    _, A12, _, A22, *_, K2 = partition(plant_of(model, "yaw"), K)
    with precision(PRECISION):
        difference = data.ball("A_r") - A22
        return [list(difference[:, j] / (K2[0, j] * sign - A12[0, j])) for j in range(3)]


def ends(x: arb) -> tuple[fmpq, fmpq]:
    """Rational lower and upper end of a ball."""
    return x.mid().fmpq() - x.rad().fmpq(), x.mid().fmpq() + x.rad().fmpq()


def intersect(balls: list[arb]) -> tuple[fmpq, fmpq]:
    """Largest lower and smallest upper end; empty if they cross."""
    pairs = [ends(x) for x in balls]
    return max(low for low, _ in pairs), min(high for _, high in pairs)


def gain_box(data: Any) -> np.ndarray:
    """K over the box of (52), balls (1, 4)."""
    with precision(PRECISION):
        return printed_gain_box(data)


def s3_own(model: Any, data: Any, synthesis: Any) -> Result:
    """One rational K in the box of (52) and one L_r give all 16 entries of (66)-(69) to their half units.

    The margins are the half units less the deviations, so a positive one is exact membership; no pole is supposed:
    any L_r found by whatever means would do. The evidence has the three enclosures and their intersection.
    """
    plant = plant_of(model, "yaw")
    balls = synthesis["gains"]["yaw"]["balls"]
    K = rounded(exact_midpoint(balls["K"]), 12)
    design = reduced_matrices(plant, K, rounded(exact_midpoint(balls["x1"]["typed4"]["L"]), 12))
    printed = printed_reduced(lambda name: data[name])
    half = printed_reduced(data.half)
    found = {"A_r": design.A, "B_r": design.B, "C_r": design.C, "D_r": design.D}
    margins = {
        f"{name}({i + 1},{j + 1})": half[name][i, j] - abs(found[name][i, j] - printed[name][i, j])
        for name in found
        for i, j in np.ndindex(found[name].shape)
    }
    margins["K in the box of (52)"] = min(
        h - abs(x) for x, h in zip((K - printed_gain(data))[0], data.half("A_c")[0], strict=True)
    )
    return Result(Statement(margins), evidence=enclosure_evidence(model, data, balls["K"]))


def enclosure_evidence(model: Any, data: Any, K: np.ndarray) -> dict[str, Any]:
    """Intersections of the three enclosures of L_r: K from the box of (52), then K.q1, then with the printed sign."""
    out: dict[str, Any] = {}
    for name, gain, sign in (("K of (52)", gain_box(data), 1), ("K.q1", K, 1), ("printed sign", K, -1)):
        sets = estimator_gain_sets(model, data, gain, sign)
        out[f"L_r, {name}"] = [[float(end) for end in intersect([column[i] for column in sets])] for i in range(3)]
    return out


def abs_stable_red_y(model: Any, data: Any) -> Result:
    """(66)-(69) fed with y = Cx: characteristic coefficients over the whole rounding box; one stays negative."""
    plant = plant_of(model, "yaw")
    with precision(PRECISION):
        p = charpoly(reduced_loop(plant, plant.C, **printed_reduced(data.ball)))
    return Result(Statement(coefficient_margins(p)), evidence={"order": plant.n + 3})


def abs_stable_red_x1(model: Any, data: Any) -> Statement:
    """(66)-(69) fed with x1: Routh column at the printed decimals."""
    plant = plant_of(model, "yaw")
    M = reduced_loop(plant, first_state(plant.n), **printed_reduced(lambda name: data[name]))
    return Statement(routh_margins(charpoly(M)))


def abs_stable_red_box(model: Any, data: Any) -> Statement:
    """(66)-(69) fed with x1, whole rounding box: Routh columns of the four Kharitonov polynomials, exact."""
    ends = [coefficient_range(c, fmpq(1)) for c in coefficient_polynomials(model, data)]
    margins: dict[str, Any] = {}
    for k, corner in enumerate(kharitonov_corners(ends), start=1):
        margins |= routh_margins(corner, f"polynomial {k}: Routh")
    return Statement(margins)
