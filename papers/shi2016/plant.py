"""The plant of (3) and the published gains in any arithmetic: floats, rationals, balls, sympy expressions.

Units: angles rad, rates rad/s, torques N m. ``rate`` is the orbital rate omega0 [rad/s]. State x = (phi, theta, psi and
their derivatives); the torque part of the model is ``low``, with J q'' = low x + u + d.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.exact.ball import ball, midpoint, precision
from recontrol.exact.rational import diagonal, identity, matrix, zeros
from recontrol.lmi.scaling import Units

BITS = 200
RADII = {"Re-equatorial": "Re_equatorial", "Re-mean": "Re_mean"}
DEFAULT = "Re-equatorial"
GAINS = {"ext": "K_ext", "trad": "K_trad"}
SHAPES = {"N-printed": "N", "N-interleaved": "N_interleaved"}
"""Case of Delta K -> name of its row N in paper.yaml."""

SCALES = {
    "ext": ("0.36", "1.8"),
    "trad": ("0.03", "0.0135"),
    "nonfragile": ("0.2", "0.6"),
    "orbit": ("0.003", "0.0001"),
}
"""Unit of frequency [1/s] and of torque [N m] per design problem, from bandwidth and stiffness of the gains; ``orbit``
is a few orbital rates and the gravity-gradient stiffness, for loops that are hardly faster than the orbit."""


def orbital_rate(data: Any, case: str = DEFAULT) -> arb:
    """omega0 = sqrt(gm / r^3) [rad/s] at the printed altitude above the radius of the case."""
    with precision(BITS):
        radius = data[RADII[case]] + data["altitude"]
        return (arb(data["gm_earth"]) / arb(radius) ** 3).sqrt()


def rate_interval(data: Any) -> arb:
    """The interval of omega0 that covers both radii [rad/s]."""
    low, high = data["rate_interval"][0]
    return ball((low + high) / 2, (high - low) / 2)


def inertias(data: Any) -> list[fmpq]:
    """(Ix, Iy, Iz) [kg m^2]."""
    return list(data["inertia"][0])


def torque_rows(inertia: Any, rate: Any) -> list[list[Any]]:
    """``low`` (3, 6) of J q'' = low x + u + d for any scalars, as rows."""
    ix, iy, iz = inertia
    square, coupling = rate * rate, rate * (iy - ix - iz)
    return [
        [-4 * (iy - iz) * square, 0, 0, 0, 0, -coupling],
        [0, -3 * (ix - iz) * square, 0, 0, 0, 0],
        [0, 0, -(iy - ix) * square, coupling, 0, 0],
    ]


def low_matrix(data: Any, rate: Any) -> np.ndarray:
    """``low`` (3, 6) as an object array of rationals and balls."""
    out = zeros(3, 6)
    for i, row in enumerate(torque_rows(inertias(data), rate)):
        for j, entry in enumerate(row):
            out[i, j] = entry if isinstance(entry, arb) else fmpq(entry)
    return out


def matrices(data: Any, rate: Any) -> dict[str, np.ndarray]:
    """A, B1, B2, C1, C2, D1, D2 of (3) and ``low``, object arrays, in SI units."""
    inverse = diagonal([1 / j for j in inertias(data)])
    low = low_matrix(data, rate)
    A = np.vstack([np.hstack([zeros(3), identity(3)]), inverse @ low])
    B = np.vstack([zeros(3), inverse])
    weight = data["z_weight"]
    return {
        "A": A,
        "B1": B,
        "B2": B,
        "C1": low * weight,
        "C2": np.hstack([identity(3), zeros(3)]),
        "D1": identity(3) * weight,
        "D2": identity(3) * weight,
        "low": low,
    }


def units(data: Any, name: str) -> Units:
    """Scaled units of `SCALES`: x_s = (q, q'/ws), t_s = ws t, torques over ts, z_s = z_inf / (z_weight ts)."""
    frequency, torque = matrix([list(SCALES[name])])[0]
    return Units(
        state=[1, 1, 1, frequency, frequency, frequency],
        input=torque,
        output=torque * data["z_weight"],
        time=1 / frequency,
    )


def scale_factors(data: Any, name: str) -> dict[str, fmpq]:
    """``ws``, ``ts``, h = ws/ts^2 and ``h8`` = h / z_weight.

    Squared H2 norms are h times, squared efforts ws times, X of (8) as printed h8 times the scaled ones.
    """
    frequency, torque = matrix([list(SCALES[name])])[0]
    h = frequency / torque**2
    return {"ws": frequency, "ts": torque, "h": h, "h8": h / data["z_weight"]}


def scaled(data: Any, rate: Any, name: str) -> dict[str, np.ndarray]:
    """The matrices of (3) in the units of `units`; there D1 = D2 = I, C1 = low, gamma is gamma_inf / z_weight."""
    unit, plant = units(data, name), matrices(data, rate)
    return {
        "A": unit.dynamics(plant["A"]),
        "B1": unit.inputs(plant["B1"]),
        "B2": unit.inputs(plant["B2"]),
        "C1": unit.outputs(plant["C1"]),
        "C2": plant["C2"],
        "D1": unit.feedthrough(plant["D1"]),
        "D2": unit.feedthrough(plant["D2"]),
    }


def scaled_gain(data: Any, name: str) -> np.ndarray:
    """Published gain ``ext`` or ``trad`` (3, 6), exact, in its own scaled units."""
    return units(data, name).gain(data[GAINS[name]])


def half_unit(data: Any, name: str) -> fmpq:
    """Half a unit of the last decimal of a published gain: its zeros are printed bare, all other entries share it."""
    name = GAINS[name]
    (half,) = set(data.half(name)[data[name] != 0])
    return half


def gain_box(data: Any, name: str, zeros_rounded: bool = False) -> np.ndarray:
    """Rounding box of a published gain (3, 6): half a unit of the last decimal on every entry that is not zero.

    A printed 0 counts as exact unless ``zeros_rounded``.
    """
    exact, half = data[GAINS[name]], half_unit(data, name)
    out = np.empty(exact.shape, dtype=object)
    for place in np.ndindex(exact.shape):
        wide = zeros_rounded or exact[place] != 0
        out[place] = ball(exact[place], half if wide else 0)
    return out


def closed_loop(plant: dict[str, np.ndarray], K: np.ndarray) -> np.ndarray:
    """A + B1 K."""
    return plant["A"] + plant["B1"] @ K


def float_plant(data: Any, case: str = DEFAULT) -> dict[str, np.ndarray]:
    """`matrices` as float arrays, with ``K_ext``, ``K_trad`` and ``rate``."""
    rate = orbital_rate(data, case)
    out = {name: midpoint(M) for name, M in matrices(data, rate).items()}
    return out | {"rate": float(rate), "K_ext": data.float("K_ext"), "K_trad": data.float("K_trad")}


def exact_rate(data: Any, case: str = DEFAULT) -> fmpq:
    """omega0 rounded to 16 decimals: a rational within 5e-17 rad/s, for problems that need exact data."""
    scale = 10**16
    with precision(BITS):
        return fmpq(int(float((orbital_rate(data, case) * scale).mid().floor())), scale)


def pareto_constant(data: Any) -> arb:
    """Least h2 effort^3 of the decoupled plant, (3 sqrt(3)/8) (sum J_i^{-1/2})^2."""
    total = sum((1 / arb(j).sqrt() for j in inertias(data)), arb(0))
    return 3 * arb(3).sqrt() / 8 * total**2
