"""Theorems 2 and 3, Lemma 4 and the printed gains, by certificates."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, arb_mat, fmpq

from recontrol.claims.proofs import provided, undecided, verified
from recontrol.claims.values import Approx, Result, Statement
from recontrol.exact.ball import precision, to_ball
from recontrol.exact.linalg import determinant
from recontrol.exact.rational import decimal, identity, to_float, zeros

from ..plant import controller, float_controller, initial_state, loop, plant
from .support import changes, drift_limit, proven_as_printed, refuted


def open_loop_determinant(data: Any) -> Result:
    """C1: (17) puts the open-loop poles in D(a, b), so |det(A0 + aI)| < b^6; exact."""
    p = plant(data)
    value = determinant(p["A"] + identity(6) * data["disk_a"])
    poles = np.linalg.eigvals(to_float(p["A"]))
    a, b = data.float("disk_a"), data.float("disk_b")
    factor = (np.abs(poles + a) ** 2 - b**2) / a
    return Result(
        Statement({"b^6 - det(A0 + aI)": data["disk_b"] ** 6 - value}),
        evidence={
            "(|mu + a|^2 - b^2)/a of the test vectors": Approx(np.sort(factor), 1e-9),
            "open-loop poles with a positive value": int((factor > 0).sum()),
        },
    )


def eq17_contradiction(certificates: Any) -> Result:
    """C1 as multipliers of rows 1-1 and 5-1; with b = 2 the same code finds (17) feasible."""
    control = certificates["eq17-control"]["says"] if verified(certificates, "eq17-control") else "not verified"
    return refuted(certificates, "eq17-empty", evidence={"control": control})


SMALL_DRIFT = "0.001"


def thm2_equiv(certificates: Any) -> Result:
    """The printed gains satisfy (13) at 0.1 % drift, while (17) is empty."""
    return _at_small_drift(certificates)


def _at_small_drift(certificates: Any) -> Result:
    """Both certificates refute; a point of (13) for some drift is one for every smaller drift."""
    limit = drift_limit(certificates, "drift-one-below")
    evidence = {"(13), two scalars: a point up to delta_m": limit}
    if decimal(limit) < decimal(SMALL_DRIFT):
        return Result(Statement(undecided()), evidence=evidence)
    return refuted(certificates, "drift-one-below", "eq17-empty", evidence=evidence, but=["delta_m"])


def less_conservative(certificates: Any) -> Result:
    """The two-step set at the printed C_f is not empty at 0.1 % drift; that of Theorem 2 is."""
    return _at_small_drift(certificates)


def torque_at(data: Any, times: int, seconds: fmpq) -> arb:
    """Torque norm of the rigid undisturbed loop after a multiple of the initial state of Table 1, in a ball."""
    gains = controller(data, "proposed")
    m = loop(plant(data), gains)
    with precision(128):
        flow = arb_mat(to_ball(m["A"] * seconds).tolist()).exp()
        xi0 = arb_mat(to_ball(np.vstack([initial_state(data) * fmpq(times), zeros(6, 1)])).tolist())
        u = arb_mat(to_ball(np.hstack([zeros(3, 6), gains.C])).tolist()) * flow * xi0
        return sum((u[i, 0] ** 2 for i in range(3)), arb(0)).sqrt()


PEAK = fmpq(6, 10)  # s, near the peak of the torque


def lemma4(data: Any, certificates: Any) -> Result:
    """C7: (12), (19), (20 printed) accept multiples of the initial state of Table 1; the torque then exceeds 2 N m."""
    names = "start-times10", "start-times100"
    holds = verified(certificates, *names)
    accepted = [int(changes(certificates, name)["times"]) for name in names]
    found = {f"{times} times": torque_at(data, times, PEAK) for times in (1, *accepted)}
    margins = {
        f"u_max - torque, {times} times": provided(holds, data["u_max"] - found[f"{times} times"]) for times in accepted
    }
    return Result(Statement(margins), evidence={"torque at 0.6 s": found}, certificate="start-times10")


def gains_eq17(certificates: Any) -> Result:
    """Theorem 2: nothing solves (17)."""
    return refuted(certificates, "eq17-empty")


def gains_eq13(certificates: Any) -> Result:
    """(13), Table 1 in both readings, and any lambda and multipliers: C_f excludes every A_f, B_f."""
    return refuted(certificates, "gain-diag-empty", "gain-r1-empty", "gain-r2-empty", but=["e2"])


def gains_lemma3(certificates: Any) -> Result:
    """Nominal (12) at lambda = 1, whatever gamma is."""
    return refuted(certificates, "lemma-empty")


def gains_start(certificates: Any) -> Result:
    """(12), (19) and (20) at gamma = 10: empty with (20) as printed and as derived."""
    return refuted(certificates, "start-printed-gamma10-empty", "start-derived-empty")


DESIGNS = {
    "convex": lambda s: s["nominal"]["designs"]["min-gamma"],
    "two-step": lambda s: s["two-step"]["design"],
    "torque": lambda s: s["torque"]["design"],
}
SOLVER_ERROR = 1e-4  # entries of a solver's point; no digit of the print is near


def _entries(synthesis: Any, design: str, part: str) -> Result:
    return Result(Approx(np.asarray(DESIGNS[design](synthesis)[part], dtype=float), SOLVER_ERROR))


def convex_A(synthesis: Any) -> Result:
    """A_f of P1, least gamma, lambda = 1."""
    return _entries(synthesis, "convex", "A")


def convex_B(synthesis: Any) -> Result:
    """B_f of P1."""
    return _entries(synthesis, "convex", "B")


def convex_C(synthesis: Any) -> Result:
    """C_f of P1."""
    return _entries(synthesis, "convex", "C")


def two_step_A(synthesis: Any) -> Result:
    """A_f of P4."""
    return _entries(synthesis, "two-step", "A")


def two_step_B(synthesis: Any) -> Result:
    """B_f of P4."""
    return _entries(synthesis, "two-step", "B")


def two_step_C(synthesis: Any) -> Result:
    """C_f of P4, the analytic centre."""
    return _entries(synthesis, "two-step", "C")


def torque_A(synthesis: Any) -> Result:
    """A_f of P5."""
    return _entries(synthesis, "torque", "A")


def torque_B(synthesis: Any) -> Result:
    """B_f of P5."""
    return _entries(synthesis, "torque", "B")


def torque_C(synthesis: Any) -> Result:
    """C_f of P5."""
    return _entries(synthesis, "torque", "C")


def early_stop(data: Any, synthesis: Any) -> Result:
    """P7: distance of the frequency response of an early-stopped feasibility solve from that of [39]; shown only."""
    from recontrol.systems.output_feedback import Controller, response_distance

    found = synthesis["early-stop"]
    stopped = Controller(*(np.asarray(found["controller"][k], dtype=float) for k in "ABC"))
    omega = np.concatenate([[0.0], np.logspace(-3, 2, 200)])
    distance = response_distance(stopped, float_controller(controller(data, "ref39")), omega)
    return Result(Approx(distance, 1e-6), evidence={"Newton steps": found["steps"]})


def index39(certificates: Any) -> Result:
    """(12) with F = 0, Delta H = 0 and the scalars of Table 1, P free, at the printed gains of [39]."""
    return proven_as_printed(certificates, "lemma-ref39")
