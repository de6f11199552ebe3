"""Controller and estimator: (52)-(54), the weights of section 2.2, the estimator of section 2.3."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.values import Result, Size, Statement
from recontrol.exact.ball import exact_midpoint, precision, to_ball
from recontrol.exact.polynomial import PRECISION, charpoly, left_roots, reflect, roots
from recontrol.exact.rational import rounded

from ..loops import printed_gain, printed_gain_box
from ..recipe import CONTROL_WEIGHT, Plant, controller_gain, estimator_poles, lqr_spectrum, plant_of
from .support import routh_margins, used

DECAY = fmpq(1, 10)


def eq52_row1(model: Any, synthesis: Any) -> np.ndarray:
    """A - B K.q1, all rows; the claim masks the first."""
    plant = plant_of(model, "yaw")
    with precision(PRECISION):
        return plant.A - plant.B @ synthesis["gains"]["yaw"]["balls"]["K"]


def eq52_size(model: Any) -> Result:
    """Second row of a matrix of order n."""
    numbers = "the right version: (53) has the eigenvalues of the completed matrix"
    return Result(Size(1, plant_of(model, "yaw").n), evidence=used(numbers))


def _upper(poles: list[Any]) -> np.ndarray:
    out = np.empty((len(poles) // 2, 1), dtype=object)
    out[:, 0] = [z for z in poles if z.imag > 0]
    return out


def eq53_point(data: Any) -> np.ndarray:
    """Eigenvalues of (52), its decimals taken as exact."""
    return _upper(roots(charpoly(data["A_c"])))


def eq53_K(model: Any, data: Any) -> Result:
    """Roots of p(s) with K.q1; a rational K near it lies in the box of (52) and has the poles of (53)."""
    plant = plant_of(model, "yaw")
    K = rounded(exact_midpoint(controller_gain(plant)), 12)
    closed = plant.A - plant.B @ K
    inside = all(abs(x) <= h for x, h in zip((closed - data["A_c"])[0], data.half("A_c")[0], strict=True))
    evidence = {
        "K to 12 decimals in the box of (52)": bool(inside),
        "its poles in the boxes of (53)": poles_inside(roots(charpoly(closed)), data),
    }
    return Result(_upper(left_roots(lqr_spectrum(plant, CONTROL_WEIGHT))), evidence=evidence)


def poles_inside(poles: list[Any], data: Any) -> bool:
    """Whether the upper members of the pole pairs lie in the boxes of (53)."""
    cells = [row[0] for row in data.printed("P_c").rows]
    upper = [z for z in poles if z.imag > 0]
    return all(
        abs(part - number.value) <= number.unit / 2
        for z, cell in zip(upper, cells, strict=True)
        for part, number in ((z.real, cell.real), (z.imag, cell.imag))
    )


def eq54_exact(synthesis: Any) -> np.ndarray:
    """L placed on the unrounded poles."""
    return synthesis["gains"]["yaw"]["balls"]["L"]["exact"]


def eq54_typed4(synthesis: Any) -> np.ndarray:
    """L placed on the poles rounded to four decimals."""
    return synthesis["gains"]["yaw"]["balls"]["L"]["typed4"]


def inverse_lqr(plant: Plant, K: np.ndarray) -> np.ndarray:
    """The diagonal of the only diagonal Q that can give K with R = 1, controller form; balls or rationals.

    p(s)p(-s) - a(s)a(-s) = sum of q_i (-1)^(n-i) s^(2(n-i)).
    """
    n = plant.n
    with precision(PRECISION):
        p = charpoly(plant.A - plant.B @ K)
        difference = (p * reflect(p) - type(p)(plant.a * reflect(plant.a))).coeffs()
        return np.array([difference[2 * (n - i)] * (-1) ** (n - i) for i in range(1, n + 1)], dtype=object)


def s22_bryson(model: Any, data: Any) -> Result:
    """Diagonal of Q for the printed R over the whole box of (52): one entry is negative throughout."""
    plant = plant_of(model, "yaw")
    with precision(PRECISION):
        K_box = printed_gain_box(data)
    diagonal = inverse_lqr(plant, K_box) * data["weight_R"]
    evidence = {
        "diagonal of Q at the decimals of (52)": inverse_lqr(plant, printed_gain(data)) * data["weight_R"],
        "spectral polynomial of C'C": np.array((plant.b * reflect(plant.b)).coeffs(), dtype=object),
        **used("(52) does not come from (18), (19)", r"no diagonal $Q \ge 0$ with $R = 1$ gives (52)"),
    }
    margins = {f"q{i}": q for i, q in enumerate(diagonal, start=1)}
    return Result(Statement(margins, strict=False), evidence=evidence)


def s23_stable(model: Any, data: Any) -> Statement:
    """Routh column of det(sI - A + LC) over the box of (54)."""
    plant = plant_of(model, "yaw")
    with precision(PRECISION):
        return Statement(routh_margins(charpoly(to_ball(plant.A) - data.ball("L") @ plant.C)))


def s23_faster(model: Any, data: Any) -> Result:
    """Error poles left of -0.1 for every L in the box of (54); all plant poles are on the imaginary axis.

    a(s) is a quadratic in s^2 with two different negative roots.
    """
    plant = plant_of(model, "yaw")
    a0, _, a2, _, _ = plant.a.coeffs()
    with precision(PRECISION):
        p = charpoly(to_ball(plant.A) - data.ball("L") @ plant.C)
        shifted = p(type(p)([-DECAY, 1]))
        margins = routh_margins(shifted, "error faster than 0.1/s: Routh")
    margins |= {"plant poles on the axis: a0": a0, "a2": a2, "a2^2 - 4 a0": a2**2 - 4 * a0}
    return Result(Statement(margins), evidence=speed_ratios(plant, data))


def speed_ratios(plant: Plant, data: Any) -> dict[str, Any]:
    """Real part and modulus of the estimator pairs over those of the controller pairs, fast and slow."""
    controller = [z for z in left_roots(lqr_spectrum(plant, CONTROL_WEIGHT)) if z.imag > 0]
    estimator = [z for z in estimator_poles(plant, data["weight_high"]) if z.imag > 0]
    out: dict[str, Any] = {}
    for name, slow, fast in zip(("fast pair", "slow pair"), controller, estimator, strict=True):
        out[f"{name}: ratio of real parts"] = fast.real / slow.real
        out[f"{name}: ratio of moduli"] = abs(fast) / abs(slow)
    return out


def s3_gains_pr(synthesis: Any, case: str) -> Result:
    """K of the axis by the same recipe; L and both reduced designs as evidence."""
    balls = synthesis["gains"][case]["balls"]
    evidence = {
        "L": balls["L"]["exact"],
        "L_r, x1 measured": balls["x1"]["exact"]["L"],
        "x1 design A_r, B_r, C_r, D_r": [balls["x1"]["exact"][name] for name in "ABCD"],
        "L_r, y measured": balls["corrected"]["L"],
        "corrected design A_r, B_r, C_r, D_r": [balls["corrected"][name] for name in "ABCD"],
    }
    return Result(balls["K"], evidence=evidence)
