"""Sections 3 and 4 about the observer and the complete problem: poles, the placed gain, infeasibility."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.proofs import located, proven, provided, verified
from recontrol.claims.values import Approx, Membership, Result, Statement, weakest
from recontrol.exact import ball, rational
from recontrol.lmi import verify

from .. import model as plants
from .. import pole_boxes

BITS = 128


def _plant(data: Any) -> np.ndarray:
    """A at the printed mean motion."""
    return plants.plant(data, data["n_printed"])["A"]


def poles_printed(data: Any) -> Result:
    """No L in the box of the print has the poles: d(s) is away from zero over the whole box at one pole at least."""
    with ball.precision(BITS):
        A = _plant(data)
        bounds = pole_boxes.excluded(data, A, data.ball("L_printed"))
        out = any(value > 0 for value in bounds.values())
        multiple = pole_boxes.nearest(data, A, data["L_printed"], data.half("L_printed"))[0]
    why = "d(s) does not vanish over the box" if out else "d(s) may vanish over the box at every pole"
    inside = Membership(False if out else None, "ball", why)
    return Result(inside, {"abs d(s) at least": bounds, "multiple of all half units needed (float)": multiple})


def poles_corrected(data: Any) -> Result:
    """Some L in the box with L21 = -0.0025 has exactly the poles (Krawczyk)."""
    with ball.precision(BITS):
        A, half = _plant(data), data.half("L_corrected")
        multiple, L = pole_boxes.nearest(data, A, data["L_corrected"], half)
        exact = rational.rounded(L, 14)
        found, moved, _ = pole_boxes.krawczyk(data, A, exact)
        room = min(h - abs(a - b) for a, b, h in zip(exact.flat, data["L_corrected"].flat, half.flat, strict=True))
    holds = found and room > pole_boxes.RADIUS
    why = "no exact placement is proven in the box"
    if holds:
        why = f"an exact placement lies within 1e-9 of a rational L in the box; entries moved: {moved}"
    inside = Membership(True if holds else None, "ball", why)
    return Result(inside, {"multiple of all half units needed (float)": multiple})


def placed_gain(synthesis: Any) -> Result:
    """Three placements, none of which is the printed gain: with three outputs the placement is not unique."""
    report = synthesis["placement"]["report"]
    nearest = min(entry["distance"] for entry in report.values())
    return Result(Approx(float(nearest), 1e-6), {name: dict(entry) for name, entry in report.items()})


def solvable(certificates: Any, synthesis: Any, case: str) -> Result:
    """(38) contains (14), which has no solution for this observer gain."""
    margin = synthesis["multipliers"][case]["t"]
    words = {solver: record["words"] for solver, record in synthesis["P38"][case].items()}
    evidence = {"t* [1/s]": float(margin), "what solvers say": words}
    return located(certificates, f"p38_{case}", evidence)


def solvable_placed(certificates: Any) -> Result:
    """The same for the gains of three placement algorithms."""
    names = ("yang_tits", "varga", "kautsky")
    answers = [Membership.from_certificate(certificates[f"p38_{name}"]) for name in names]
    inside = False if all(answer.inside is False for answer in answers) else None
    strength = weakest([answer.strength for answer in answers])
    return Result(Membership(inside, strength, "; ".join(names)), {}, "p38_yang_tits")


def X_definite(certificates: Any) -> Result:
    """Every X in the rounding box of (43) is positive definite (certificate)."""
    return proven(certificates, "X_definite")


def satisfies_eq14(certificates: Any, case: str) -> Result:
    """Whether some X, Y in the boxes of (43) satisfy (14) with this observer gain (certificate)."""
    return located(certificates, f"eq14_{case}")


def req_i(certificates: Any, case: str) -> Result:
    """One Lyapunov matrix diag(P_x, P_e) for every Lambda of (42), printed K (certificate)."""
    return proven(certificates, f"stable_{case}")


def req_iii(data: Any, certificates: Any, case: str) -> Result:
    """u_max minus the proven bound of each axis, from the certificates; a margin of the squares, exact."""
    margins, evidence = {}, {}
    for axis, limit in zip("xyz", data.float("u_max")[0], strict=True):
        name = f"thrust_{case}_{axis}"
        square = verify.number(certificates[name]["bound"]["value"])
        margins[f"1 - (bound/u_max)^2, {axis}"] = provided(verified(certificates, name), fmpq(1) - square)
        evidence[f"bound {axis} [N]"] = float(limit) * float(rational.to_float(square)) ** 0.5
    return Result(Statement(margins), evidence, f"thrust_{case}_x")


def req_iii_full(data: Any, simulation: Any, synthesis: Any) -> Result:
    """An observer started from zero: the loop itself breaks the limits, and the bound says no more."""
    peak = np.asarray(simulation["main"]["values"]["xhat0_zero"]["peak_thrust"])
    limit = data.float("u_max")[0]
    margins = {f"u_max - peak, {axis} [N]": Approx(float(limit[i] - peak[i]), 1e-3) for i, axis in enumerate("xyz")}
    bounds = {f"bound {axis} [N]": synthesis["repaired"]["thrust"][f"e0_full_{axis}"] for axis in "xyz"}
    return Result(Statement(margins), bounds)
