"""Section IV: poles, norms and robustness of the printed loops."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.proofs import proven, undecided
from recontrol.claims.values import Result, Statement
from recontrol.exact.ball import precision, to_ball
from recontrol.exact.rational import decimal, zeros
from recontrol.spacecraft.flexible import linear_model
from recontrol.systems.norms import hinf_norm
from recontrol.systems.output_feedback import closed_loop
from recontrol.systems.regions import prove_in_disk, shifted_gap
from recontrol.systems.stability import spectrum

from ..plant import controller, loop, plant
from ..synthesis.analysis import boxed_loop
from .support import changes, pivots, proven_as_printed

Array = np.ndarray


def open_loop_origin(data: Any) -> Result:
    """All open-loop poles are nearer to the origin than the disk, whose edge passes at a - b."""
    edge = data["disk_a"] - data["disk_b"]
    with precision(128):
        sizes = [abs(value) for value in spectrum(plant(data)["A"])]
        largest = max(sizes, key=lambda x: float(x.mid()))
        return Result(
            Statement({f"a - b minus modulus {k}": edge - x for k, x in enumerate(sizes, start=1)}),
            evidence={"largest modulus [rad/s]": largest},
        )


def open_loop_right(data: Any) -> Result:
    """Some open-loop poles have a positive real part."""
    with precision(128):
        parts = [value.real for value in spectrum(plant(data)["A"])]
    count = sum(bool(part > 0) for part in parts)
    margins = {f"real part {k}": part for k, part in enumerate(parts, start=1)}
    return Result(Statement.any_of(margins), evidence={"poles in the right half plane": count})


def disk(data: Any) -> Result:
    """One P proves D(1.01, 1) for every controller and plant that round to the print."""
    A = boxed_loop(data, "proposed")
    radii = {r: prove_in_disk(A, data["disk_a"], r) is not None for r in ("0.9", "0.8")}
    P = prove_in_disk(A, data["disk_a"], data["disk_b"])
    with precision(200):
        margins: Any = undecided()
        if P is not None:
            margins = pivots(P, "P") | pivots(shifted_gap(A, P, data["disk_a"], data["disk_b"]), "P - Ad'P Ad")
        return Result(Statement(margins), evidence={"smaller radii proven for the box": radii})


def disk_robust(certificates: Any) -> Result:
    """Frozen gain drift up to 5 % and every Delta H."""
    return proven_as_printed(certificates, "disk-drift")


def stable_rigid(data: Any) -> Result:
    """Enclosed poles of the rigid loop."""
    return _stable(loop(plant(data), controller(data, "proposed"))["A"])


def stable_flexible(data: Any) -> Result:
    """Enclosed poles of the loop with its four modes (20 states)."""
    return _stable(flexible_loop(data, "proposed"))


def flexible_loop(data: Any, name: str) -> Array:
    """Exact loop (20, 20) of the flexible model and a printed controller."""
    args = (np.ravel(data["J0"]), data["F"], np.ravel(data["modal_frequency"]), np.ravel(data["damping_ratio"]))
    A, B = linear_model(*args, data["orbital_rate"])
    C = zeros(3, 14)
    for i in range(3):
        C[i, i] = fmpq(1)
    return closed_loop(A, B, C, controller(data, name))


def _stable(A: Array) -> Result:
    with precision(128):
        values = spectrum(A)
        slowest = max((value.real for value in values), key=lambda x: float(x.mid()))
        margins = {f"-Re of pole {k}": -value.real for k, value in enumerate(values, start=1)}
    return Result(Statement(margins), evidence={"largest real part [1/s]": slowest})


def hinf(data: Any) -> Result:
    """Enclosed H-infinity norm from d~ to y of the rigid nominal loop."""
    m = {k: to_ball(M) for k, M in loop(plant(data), controller(data, "proposed")).items()}
    found = hinf_norm(m["A"], m["B"], m["C"], to_ball(zeros(3, 3)))
    return Result(found.value, evidence={"peak frequency [rad/s]": str(found.frequency)})


def hinf_robust(data: Any, certificates: Any) -> Result:
    """A bound for all gain drift, Delta J and Delta H, at any speed of variation; gamma of Table 1 has to keep it."""
    changed = changes(certificates, "hinf-drift")
    bound = decimal(changed.pop("gamma"))
    if changed or bound > data["gamma"]:
        return Result(Statement(undecided()), evidence={**changed, "proven bound [rad/(N m)]": bound})
    return proven(certificates, "hinf-drift", evidence={"gamma minus the proven bound": data["gamma"] - bound})
