"""Section 6.1 to 6.7: the published controller and estimator in the loop."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import precision, to_ball
from recontrol.exact.linalg import rank
from recontrol.exact.polynomial import PRECISION, charpoly, is_hurwitz
from recontrol.exact.spectrum import companion, eigenvalues, is_stable, spectral_abscissa

from .. import analysis, recipe
from ..identities import ace_null_vector_holds, pitch_error_pole_is_zero
from ..intervals import kharitonov_fraction
from ..loops import printed_reduced, reduced_loop
from ..model import AXES, complete_column
from ..readings.formulas import krylov
from ..readings.gains import inverse_lqr, speed_ratios
from ..readings.reduced import estimator_gain_sets, gain_box, intersect
from ..readings.support import coefficient_margins


def families(data: Any, model: Any, synthesis: Any) -> dict[str, dict[str, np.ndarray]]:
    """Loop matrices by name of quantity and case."""
    signs = {f"{axis}, {name}": M for axis in AXES for name, M in analysis.sign_loops(model, synthesis, axis).items()}
    full = {f"{axis}: full": analysis.axis_full_loop(model, synthesis, axis) for axis in AXES}
    corrected = {f"{axis}: corrected": analysis.corrected_loop(model, synthesis, axis) for axis in AXES}
    return {
        "ace": {"ace-print": data["A_ce"], "ace-one": data["A_ce_one"]},
        "full_loop": analysis.full_loops(model, data, synthesis),
        "ace_member": analysis.deciding_members(model, data),
        "printed_loop": analysis.reduced_loops(model, data),
        "printed_sign": analysis.printed_sign_loops(model, data),
        "x1_design_sign": signs,
        "axis_loop": full | corrected,
    }


def stability(data: Any, model: Any, synthesis: Any) -> dict[str, Any]:
    """Stable or not, spectral abscissa and eigenvalues of each loop."""
    out: dict[str, Any] = {}
    for name, loops in families(data, model, synthesis).items():
        out[f"{name}_stability"] = {case: analysis.word(is_stable(M)) for case, M in loops.items()}
        out[f"{name}_abscissa"] = {case: spectral_abscissa(M) for case, M in loops.items()}
        out[f"{name}_eigenvalues"] = {case: eigenvalues(M) for case, M in loops.items()}
    return out


def gain_intersection(model: Any, data: Any, K: np.ndarray) -> np.ndarray:
    """Intersection over the columns of (66) of the enclosures of L_r, as a ball column (3, 1)."""
    sets = estimator_gain_sets(model, data, K)
    out = np.empty((3, 1), dtype=object)
    with precision(PRECISION):
        for i in range(3):
            low, high = intersect([column[i] for column in sets])
            out[i, 0] = arb((low + high) / 2) + arb(0, arb((high - low) / 2).upper())
    return out


def sign_overlap(model: Any, data: Any) -> dict[str, np.ndarray]:
    """Width shared by the three enclosures of each entry of L_r, K of (52), for either sign of (46); negative: none."""
    out = {}
    for name, sign in (("derived sign", 1), ("printed sign", -1)):
        sets = estimator_gain_sets(model, data, gain_box(data), sign)
        pairs = [intersect([column[i] for column in sets]) for i in range(3)]
        out[name] = np.array([[high - low] for low, high in pairs], dtype=object)
    return out


def propagate(model: Any, K: np.ndarray, L: np.ndarray) -> dict[str, Any]:
    """What the sets of K and L_r imply for the estimator poles, B_r and D_r."""
    plant = recipe.plant_of(model, "yaw")
    with precision(PRECISION):
        design = recipe.reduced_matrices(plant, K, L)
        error = to_ball(plant.A[1:, 1:]) - L @ plant.A[:1, 1:]
        return {"B_r": design.B, "D_r": design.D, "error poles": eigenvalues(error)}


def enclosures(data: Any, model: Any, synthesis: Any) -> dict[str, Any]:
    """Section 6.4 for K of (52) and for K.q1."""
    names = ("Lr_enclosure", "Br_enclosure", "Dr_enclosure", "error_pole_enclosure", "print_meets_enclosure")
    out: dict[str, Any] = {name: {} for name in names}
    slow = recipe.estimator_poles(recipe.plant_of(model, "yaw"), data["weight_high"])[2].real
    for name, K in (("K of (52)", gain_box(data)), ("K.q1", synthesis["gains"]["yaw"]["balls"]["K"])):
        L = gain_intersection(model, data, K)
        implied = propagate(model, K, L)
        out["Lr_enclosure"][name] = L
        out["Br_enclosure"][name] = implied["B_r"]
        out["Dr_enclosure"][name] = implied["D_r"]
        out["error_pole_enclosure"][name] = implied["error poles"]
        pairs = zip(implied["B_r"].ravel(), data.ball("B_r").ravel(), strict=True)
        out["print_meets_enclosure"] |= {
            f"{name}: (67)": all(found.overlaps(box) for found, box in pairs),
            f"{name}: (69)": implied["D_r"][0, 0].overlaps(data.ball("D_r")),
            f"{name}: real error pole and the slow estimator pair": implied["error poles"][-1].real.overlaps(slow),
        }
    return out


def box_stability(data: Any, model: Any) -> dict[str, str]:
    """Hurwitz over the whole rounding boxes of (52) and of (54), hence the full-order loop by separation."""
    plant = recipe.plant_of(model, "yaw")
    with precision(PRECISION):
        controller = is_hurwitz(charpoly(to_ball(plant.A) - plant.B @ gain_box(data)))
        estimator = is_hurwitz(charpoly(to_ball(plant.A) - data.ball("L") @ plant.C))
    both = controller and estimator
    words = {"(52)": controller, "(54)": estimator, "full-order loop, by separation": both}
    return {name: analysis.word(answer) for name, answer in words.items()}


def negative_coefficient(data: Any, model: Any) -> arb:
    """Characteristic coefficient of s^5 of (66)-(69) fed with y, over the whole rounding box."""
    plant = recipe.plant_of(model, "yaw")
    with precision(PRECISION):
        p = charpoly(reduced_loop(plant, plant.C, **printed_reduced(data.ball)))
    return coefficient_margins(p)["coefficient of s^5"]


def separation_distance(model: Any, data: Any, synthesis: Any) -> dict[str, float]:
    """Largest distance between a loop's spectrum and that of controller and estimator together."""
    out = {}
    for axis in AXES:
        plant = recipe.plant_of(model, axis)
        controller = recipe.left_roots(recipe.lqr_spectrum(plant, recipe.CONTROL_WEIGHT))
        estimator = recipe.estimator_poles(plant, data["weight_high"])
        error = recipe.exact_poly(estimator[: plant.n - 1])
        with precision(PRECISION):
            reduced = eigenvalues(companion(error.coeffs()[:-1]))
        full = analysis.as_row(eigenvalues(analysis.axis_full_loop(model, synthesis, axis)))
        corrected = analysis.as_row(eigenvalues(analysis.corrected_loop(model, synthesis, axis)))
        out[f"{axis}: full"] = float(analysis.nearest(full, analysis.as_row([*controller, *estimator])).max())
        out[f"{axis}: corrected"] = float(analysis.nearest(corrected, analysis.as_row([*controller, *reduced])).max())
    return out


def ace_rank(data: Any, case: str) -> int:
    """Rank of the controllability matrix of (55) with (56), completed by the missing zero."""
    A, B = data["A_ce" if case == "ace-print" else "A_ce_one"], data["B_ce"]
    return rank(krylov(A, complete_column(B, A.shape[0])))


def quantities(data: Any, model: Any, synthesis: Any) -> dict[str, Any]:
    """Names of paper.yaml, section 6."""
    plant = recipe.plant_of(model, "yaw")
    return {
        **stability(data, model, synthesis),
        **enclosures(data, model, synthesis),
        "inverse_lqr_diagonal": inverse_lqr(plant, gain_box(data)),
        "box_stability": box_stability(data, model),
        "estimator_controller_ratio": speed_ratios(plant, data),
        "ace_input_rank": {case: fmpq(ace_rank(data, case)) for case in ("ace-print", "ace-one")},
        "ace_zero_eigenvalue": ace_null_vector_holds(plant),
        "printed_loop_coefficient": negative_coefficient(data, model),
        "kharitonov_fraction": kharitonov_fraction(model, data),
        "Lr_overlap": sign_overlap(model, data),
        "separation_distance": separation_distance(model, data, synthesis),
        "pitch_zero_error_pole": pitch_error_pole_is_zero(),
    }
