"""Where the published gains come from: what a symmetric selection must give, and what other recipes give."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.values import Approx, Result, Statement

from .. import plant


def cancelled_coupling(data: Any, case: str) -> Result:
    """K with V = K + low diagonal in the axes: entries (1,6), (3,4) cancel the gyroscopic coupling, (1,3) and (3,1)
    vanish.

    Evidence: altitudes whose four decimals are the printed ones, for this Earth radius.
    """
    rate = plant.orbital_rate(data, case)
    ix, iy, iz = plant.inertias(data)
    found = np.empty((3, 6), dtype=object)
    found[...] = fmpq(0)
    coupling = rate * (ix + iz - iy)
    found[0, 5], found[2, 3] = -coupling, coupling
    low, high = _altitudes(data, case)
    return Result(found, {"coupling": coupling, "lowest altitude [km]": low, "highest altitude [km]": high})


def _altitudes(data: Any, case: str) -> tuple[arb, arb]:
    """Altitudes [km] at which the coupling rounds to the printed 0.0197."""
    ix, iy, iz = plant.inertias(data)
    printed, half, radius = abs(data["K_trad"][0, 5]), plant.half_unit(data, "trad"), data[plant.RADII[case]]

    def altitude(coupling: fmpq) -> arb:
        rate = coupling / (ix + iz - iy)
        return arb(data["gm_earth"] / rate**2) ** (arb(1) / 3) - radius

    return altitude(printed + half), altitude(printed - half)


def symmetric_selection(data: Any, case: str) -> Result:
    """The same for K_ext: what any unique or sign-symmetric selection of the printed problem would give."""
    return cancelled_coupling(data, case)


def control_penalty(data: Any, synthesis: Any) -> Result:
    """Signs of (1,3) and (3,1) of the least H2 norm at the effort of K_ext against the print; sizes as evidence."""
    K, printed = synthesis["h2-effort"]["ext"]["K"], data.float("K_ext")
    places = {"(1,3)": (0, 2), "(3,1)": (2, 0)}
    margins = {name: Approx(float(np.sign(K[p]) * printed[p]), 1e-12) for name, p in places.items()}
    evidence = {f"{name} of the optimum": float(K[p]) for name, p in places.items()}
    evidence |= {"(1,6) of the optimum": float(K[0, 5]), "(3,4) of the optimum": float(K[2, 3])}
    return Result(Statement(margins), evidence)


def distances(data: Any, synthesis: Any, gain: str) -> Result:
    """Largest relative mismatch of the six diagonal entries from well-posed designs: evidence, never an agreement."""
    printed = data.float(plant.GAINS[gain])
    rows = {f"least H2 norm at the effort of K_{gain}": synthesis["h2-effort"][gain]["K"]}
    if gain == "ext":
        rows |= {f"one X, g = {g}": found["K"] for g, found in synthesis["single"]["std"].items()}
        rows |= {f"two X and slack, g = {g}": found["K"] for g, found in synthesis["dilated"]["levels"].items()}
    places = [(i, j) for i in range(3) for j in (i, i + 3)]
    score = {name: max(abs(K[p] / printed[p] - 1) for p in places) for name, K in rows.items()}
    stiffness = -np.diag(printed[:, :3])
    evidence = {f"largest mismatch, {name}": float(value) for name, value in score.items()}
    evidence["printed stiffness by axis, inertia 20, 15, 12"] = stiffness
    return Result(Approx(float(min(score.values())), 1e-6), evidence)


def distances_ext(data: Any, synthesis: Any) -> Result:
    """`distances` for K_ext."""
    return distances(data, synthesis, "ext")


def distances_trad(data: Any, synthesis: Any) -> Result:
    """`distances` for K_trad; its stiffness is not monotone in the inertia."""
    return distances(data, synthesis, "trad")
