"""The augmented plant, the loop with the printed gain, its equilibrium and its first control.

Artifact: `orbits` -> w-print, w-geo -> exact A (9, 9), equilibrium xi_ss (9, 1) for y_r, K_bar xi_ss (3, 1), poles of
A_bar + B_bar K_bar (floats); `exact` -> B, B1, C2, K, xi0; `u0` = K_bar xi(0); `rates`, `pair_split` -> see there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact import rational
from recontrol.exact.ball import precision

from . import problems as pr

STELLAR_DAY = "86164.1"  # s


def model(data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    exact = pr.exact_data(data, "")
    orbits = {}
    for orbit, name in pr.ORBITS.items():
        A, xi = exact[name], pr.equilibrium(exact, name, data["y_r"].T)
        poles = np.sort_complex(np.linalg.eigvals(rational.to_float(A + exact["B"] @ exact["K"])))
        orbits[orbit] = {"A": A, "equilibrium": xi, "thrust_at_rest": exact["K"] @ xi, "poles": poles}
    return {
        "orbits": orbits,
        "exact": {name: exact[name] for name in ("B", "B1", "C2", "K", "xi0")},
        "u0": exact["K"] @ exact["xi0"],
        "rates": rates(data),
        "pair_split": pair_split(data),
    }


def rates(data: Any) -> dict[str, Any]:
    """Balls: orbital rate [rad/s] from the radius and from the period, radius [km] from a period of 24 h and of a
    stellar day, radius [km] and period [s] of the printed digits with the exponent -3.
    """
    gm, radius = data["gm_earth"], data["orbit_radius"]
    day = data["period"] * 3600
    with precision(128):
        two_pi, third = 2 * arb.pi(), arb(1) / 3

        def radius_of(rate: arb) -> arb:
            return (arb(gm) / rate**2) ** third

        w = data["w-print"]
        return {
            "from_radius": (arb(gm) / arb(radius) ** 3).sqrt(),
            "from_period": two_pi / arb(day),
            "radius_24h": radius_of(two_pi / arb(day)),
            "radius_stellar": radius_of(two_pi / arb(rational.decimal(STELLAR_DAY))),
            "radius_of_print": radius_of(arb(w)),
            "period_of_print": two_pi / arb(w),
        }


def slow_pairs(data: Any) -> Callable[[float, np.ndarray], float]:
    """Difference of the real parts of the two slow in-plane pairs [1/s] at an orbital rate [rad/s] and a gain (2, 6).

    A fast rate leaves one slow pair and one at the rate itself; then these two are compared.
    """
    exact = pr.exact_data(data, "block=xy")
    A, B = (rational.to_float(exact[name]) for name in ("A_print", "B"))

    def split(w: float, gain: np.ndarray) -> float:
        A[2, 0], A[2, 3], A[3, 2] = 3 * w * w, 2 * w, -2 * w
        poles = np.linalg.eigvals(A + B @ gain)
        slow = poles[poles.imag > 0.1]
        return float(abs(slow[1].real - slow[0].real))

    return split


def pair_split(data: Any) -> dict[str, Any]:
    """Difference of the real parts of the two slow in-plane pairs [1/s] at each rate, and the rate where it is least.

    The range is over 400 gains of the rounding box (seed 0).
    """
    from scipy.optimize import minimize_scalar

    exact = pr.exact_data(data, "block=xy")
    K, split = rational.to_float(exact["K"]), slow_pairs(data)
    half = rational.to_float(pr.half_units(data)[np.ix_((0, 1), pr.BLOCKS["xy"])])
    rng = np.random.default_rng(0)
    gains = [K, *(K + half * rng.uniform(-1, 1, K.shape) for _ in range(400))]
    out: dict[str, Any] = {}
    for name, w in (("w-print", data["w-print"]), ("w-geo", data["w-geo"]), ("w=0", fmpq(0))):
        values = [split(float(rational.to_float(w)), gain) for gain in gains]
        out[name] = {"value": values[0], "low": min(values), "high": max(values)}
    least = [minimize_scalar(split, bounds=(5e-4, 2e-3), args=(g,), method="bounded").x for g in gains]
    return {**out, "least": {"value": float(least[0]), "low": float(min(least)), "high": float(max(least))}}
