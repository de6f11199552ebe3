"""The plant of (3) as floats, one entry per Earth radius, with the closed loops of both published gains.

======== ====== =====================================================================
key      shape  what
======== ====== =====================================================================
A B1 B2  6x6 6x3 6x3  state space, x = (angles [rad], rates [rad/s]), inputs [N m]
C1 D1 D2 3x6 3x3 3x3  output z_inf
C2       3x6    output z2, the angles
low      3x6    orbital torques: J q'' = low x + u + d
rate     scalar omega0 [rad/s], ball
poles    per gain: eigenvalues of A + B1 K [1/s]
======== ====== =====================================================================
"""

from __future__ import annotations

from typing import Any

from . import plant


def model(data: Any) -> dict[str, Any]:
    """Artifact described at the head of this module."""
    return {case: _entry(data, case) for case in plant.RADII}


def _entry(data: Any, case: str) -> dict[str, Any]:
    from scipy.linalg import eigvals

    entry: dict[str, Any] = plant.float_plant(data, case)
    loops = {name: entry["A"] + entry["B1"] @ entry[key] for name, key in plant.GAINS.items()}
    entry["rate"] = plant.orbital_rate(data, case)
    entry["poles"] = {
        name: sorted(eigvals(loop).tolist(), key=lambda s: (s.real, s.imag)) for name, loop in loops.items()
    }
    return entry
