"""What the conditions say about V(0): infimum, range under (55), least rho; V(0) couples the plane and z."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from recontrol.exact import rational

from .. import conditions as c
from .. import problems as pr
from ..sweeps import call, cvxpy_unknowns, floats, run, values_of


def model(
    data: Any, case: str, orbit: str, faults: str, *, decay: bool, gamma2: float | None = None, rho: Any = None,
    start: np.ndarray | None = None, value: float = 100.0, strict: float = 0.0,
) -> tuple[list[Any], Any, Mapping[str, Any]]:  # fmt: skip
    """CVXPY constraints, V(0) in units of `value`, and the unknowns, all in the scaled units of the case.

    `rho` may be a CVXPY variable (in units of `value`); `start` (9,) replaces xi(0).
    """
    exact = pr.exact_data(data, case)
    scale = np.array([float(rational.to_float(rational.decimal(s))) for s in pr.SCALES[pr.tokens(case)["units"]]])
    v = floats(data, case)
    scaled = {**v, "A": v[pr.ORBITS[orbit]] * scale / scale[:, None], "B": v["B"] / scale[:, None], "K": v["K"] * scale}
    scaled |= {"B1": v["B1"] / scale[:, None] * np.sqrt(value), "C2": v["C2"] * scale / np.sqrt(value)}
    unknown = cvxpy_unknowns(9)
    bound = {**scaled, **unknown, "faults": faults, "schur": True, "zero": 0.0}
    matrices = [call(f, bound) for f in ((c.phi, c.phi_hat) if decay else ())]
    if gamma2 is not None:
        # d in units of 100 N keeps the weight of the inputs near that of the states.
        given = {"B1": scaled["B1"] * 100.0 / np.sqrt(value), "gamma2": gamma2 * 100.0**2 / value}
        matrices += [call(f, {**bound, **given}) for f in (c.performance, c.performance_hat)]
    constraints = [(M + M.T) / 2 + strict * np.eye(M.shape[0]) << 0 for M in matrices]
    constraints += [unknown[name] - strict * np.eye(9) >> 0 for name in ("P1", "P2", "P3")]
    bound_on_V = v["rho"] / value if rho is None else rho
    for axis in range(3):
        row = scaled["K"][axis : axis + 1]
        form = bound_on_V * (row.T @ row / v["u_max"] ** 2)
        constraints.append(unknown["P1"] - form - strict * np.eye(9) >> 0)
    xi0 = (rational.to_float(exact["xi0"])[:, 0] if start is None else start) / scale
    return constraints, xi0 @ unknown["P1"] @ xi0, unknown


def _optimum(constraints: list[Any], objective: Any, sense: str, value: float, solver: str = "CLARABEL") -> float:
    import cvxpy

    wrapper = {"min": cvxpy.Minimize, "max": cvxpy.Maximize}[sense]
    problem = cvxpy.Problem(wrapper(objective), constraints)
    found = run(problem, solver)
    for variable in problem.variables():
        variable.value = values_of(problem, found)[variable.id]
    return float(objective.value) * value


def infimum(data: Any, orbit: str, faults: str, alpha: str, start: np.ndarray | None = None, **options: Any) -> float:
    """inf V(0) over (21), (22) with strictness 1e-7 in isotropic units."""
    parts = model(data, f"units=iso alpha={alpha}", orbit, faults, decay=True, start=start, strict=1e-7)
    return _optimum(parts[0], parts[1], "min", 100.0, **options)


def value_range(data: Any, alpha: str, gamma2: float) -> dict[str, float]:
    """Least and largest V(0) under derived (21), (22), (55) for d alone, w-print; alpha = 0: (55) implies (21)."""
    out = {}
    for sense in ("min", "max"):
        constraints, V0, _ = model(
            data, f"channel=d-only alpha={alpha}", "w-print", c.DERIVED, decay=alpha != "0", gamma2=gamma2, value=1e4
        )
        out[sense] = _optimum(constraints, V0, sense, 1e4)
    return out


def least_rho(data: Any, alpha: str, gamma2: float) -> float:
    """Least rho for which (21), (22), (47), (55) for d alone have a common solution."""
    import cvxpy

    rho = cvxpy.Variable()
    constraints, V0, _ = model(
        data, f"channel=d-only alpha={alpha}", "w-print", c.DERIVED, decay=alpha != "0", gamma2=gamma2, rho=rho,
        value=1e4,
    )  # fmt: skip
    return _optimum([*constraints, rho >= V0], rho, "min", 1e4)


def initial(data: Any) -> dict[str, Any]:
    """infimum: blocks -> orbit -> alpha -> inf V(0), with a second solver; shifted: orbit -> inf with xi(0) - xi_ss;
    thrust_bound: the least bound on |u_i| [N] that (22), (47) can give; range, least_rho under (55), d alone.
    """
    gamma2 = float(rational.to_float(data["gamma"])) ** 2
    blocks = {"derived": c.DERIVED, "printed": c.PRINTED}
    found = {
        name: {orbit: {"a02": infimum(data, orbit, faults, "0.02")} for orbit in pr.ORBITS}
        for name, faults in blocks.items()
    }
    for name, faults in blocks.items():
        found[name]["w-print"]["a0"] = infimum(data, "w-print", faults, "0")
    shifted = {}
    for orbit, A in pr.ORBITS.items():
        exact = pr.exact_data(data, "")
        rest = rational.to_float(exact["xi0"] - pr.equilibrium(exact, A, data["y_r"].T))[:, 0]
        shifted[orbit] = infimum(data, orbit, c.DERIVED, "0.02", rest)
    rho, u_max = (float(rational.to_float(data[name])) for name in ("rho", "thrust_max"))
    return {
        "infimum": found,
        "shifted": shifted,
        "thrust_bound": {orbit: u_max * float(np.sqrt(found["derived"][orbit]["a02"] / rho)) for orbit in pr.ORBITS},
        "range": {
            "a02": value_range(data, "0.02", gamma2),
            "a0": value_range(data, "0", gamma2),
            "a0-linear": value_range(data, "0", float(np.sqrt(gamma2))),
            "a0-gamma-10": value_range(data, "0", 100.0),
        },
        "least_rho": {"a02": least_rho(data, "0.02", gamma2), "a0": least_rho(data, "0", gamma2)},
    }
