"""A gain from the derived conditions: least guaranteed thrust for a given decay rate (the paper gives no synthesis)."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact import rational
from recontrol.simulate.sampled import held_linear, last_outside, periodic
from recontrol.systems.sampled import decay_rate

from .. import conditions as c
from .. import problems as pr
from ..sweeps import SweepError, call, floats, run, search, values_of

RATES = ("0.10", "0.15", "0.20")
SLOPE, LENGTH, FORCE, STRICT = 0.5, 20.0, 100.0, 1e-6  # T2 = SLOPE T1; units of state (SI) and force [N]


def design(data: Any, alpha: float) -> dict[str, Any]:
    """Least u [N] with |u_i| <= u guaranteed from x(0), and the gain (3, 9). Raises SweepError without a point."""
    import cvxpy

    v = floats(data, f"alpha={alpha!r}")
    A, B = v["A_print"], v["B"] * (FORCE / LENGTH)
    unknown = {name: cvxpy.Variable((9, 9), symmetric=True) for name in ("P1", "P2", "P3")}
    unknown |= {name: cvxpy.Variable((9, 9)) for name in ("S1", "S2", "S3", "X")}
    Y, u2 = cvxpy.Variable((3, 9)), cvxpy.Variable()
    bound = {**v, **unknown, "A": A, "B": B, "Y": Y, "u2": u2, "slope": SLOPE, "xi0": v["xi0"] / LENGTH}
    strict = [call(f, bound) for f in (c.synthesis, c.synthesis_hat)]
    constraints = [(M + M.T) / 2 + STRICT * np.eye(M.shape[0]) << 0 for M in strict]
    constraints += [unknown[name] - STRICT * np.eye(9) >> 0 for name in ("P1", "P2", "P3")]
    constraints += [call(c.synthesis_thrust, bound, axis=axis) >> 0 for axis in range(3)]
    constraints.append(call(c.synthesis_start, bound) >> 0)
    model = cvxpy.Problem(cvxpy.Minimize(u2), constraints)
    values = values_of(model, run(model))
    K = np.linalg.solve(values[unknown["X"].id].T, values[Y.id].T).T * FORCE / LENGTH
    return {"u": float(np.sqrt(values[u2.id])) * FORCE, "K": K}


def assess(data: Any, K: np.ndarray) -> dict[str, Any]:
    """Exact decay [1/s] at h, peak |u| [N] per axis and settling to 0.1 m [s] for the zero reference, w-print."""
    v = floats(data, "")
    run_ = held_linear(v["A_print"], v["B"], K, v["xi0"][:, 0], periodic(v["h"], 100.0))
    settle = [last_outside(run_.time, run_.state[:, k], 0.1) for k in range(3)]
    return {
        "decay": decay_rate(v["A_print"], v["B"] @ K, v["h"]),
        "u_peak": np.abs(run_.control).max(axis=0),
        "settle_0.1": [float(s) if s is not None else None for s in settle],
    }


def resynthesis(data: Any) -> dict[str, Any]:
    """designs: alpha -> {u, K, rounded (four decimals, exact), decay, u_peak, settle}; published: the same numbers for
    K_bar; largest: bracket of the largest alpha with u <= 1000 N.
    """
    designs = {}
    for alpha in RATES:
        found = design(data, float(alpha))
        rounded = rational.rounded(found["K"], 4)
        designs[alpha] = {**found, "rounded": rounded, **assess(data, rational.to_float(rounded))}
    limit = float(rational.to_float(data["thrust_max"]))

    def spare(alpha: float) -> float:
        try:
            return limit - design(data, alpha)["u"]
        except SweepError:
            return -limit

    largest = search(spare, 0.10, 0.30, 0.003)
    return {"designs": designs, "published": assess(data, floats(data, "")["K"]), "largest": largest}


def proof_case(alpha: str) -> str:
    """Case in which derived (21) is proven for a rounded gain: nine tenths of the design rate, natural units."""
    tenths = rational.decimal(alpha) * 9 / 10
    return f"units=nat alpha={float(rational.to_float(tenths)):.3f}"


__all__ = ["RATES", "assess", "design", "pr", "proof_case", "resynthesis"]
