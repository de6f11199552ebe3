"""The repaired analysis: for given gains, a free Lyapunov matrix bounds the cost and the thrust of the linear loop.

The state is (x, e); the uncertainty enters both parts alike, a = [E1; E1], b = [E2 0], without the unused sixth pair.
A case names the gains and e(0): "L_corrected, e0_velocity"; `source` rebuilds the data. The mean motion is n_printed.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi.conditions import condition, minimise
from recontrol.lmi.problem import Problem
from recontrol.lmi.scaling import power_of_two
from recontrol.lmi.variables import Variable, block_diagonal, diagonal, repeated, scalar, symmetric

from . import conditions, model
from .problems import AXES, Scale

SOURCE = "papers.wan2014.repaired:source"
CHANNELS = 5


def loop_data(data: Any, K: np.ndarray, L: np.ndarray) -> dict[str, np.ndarray]:
    """Acl (12, 12), a (12, 5), b (5, 12), Qbar (12, 12) and the rows k_x, k_y, k_z (1, 12) of thrust over its limit."""
    p = model.plant(data, data["n_printed"])
    row = np.hstack([K, -K])
    E1, E2 = p["E1"][:, :CHANNELS], p["E2"][:CHANNELS]
    weights = rational.zeros(12)
    weights[:6, :6] = rational.identity(6)
    found = {
        "Acl": conditions.loop_matrices(p["A"], p["B"], data["C"], K, L),
        "a": np.vstack([E1, E1]),
        "b": np.hstack([E2, rational.zeros(CHANNELS, 6)]),
        "Qbar": weights + row.T @ row,
    }
    return found | {f"k_{axis}": row[i : i + 1] / data["u_max"][0, i] for i, axis in enumerate(AXES)}


def source(data: Any, case: str) -> dict[str, Any]:
    """Every datum of one case with the printed K."""
    words = case.split(", ")
    gain = next(w for w in words if w in ("L_printed", "L_corrected"))
    found: dict[str, Any] = loop_data(data, data["K"], data[gain]) | {"cost_unit": Scale.cost}
    for word in words:
        if word in (starts := model.initial_errors(data)):
            found["xi0"] = np.vstack([data["x0"], starts[word]])
    return found


def state_units(e0_has_position: bool) -> list[fmpq]:
    """Units of (x, e): e in position, and velocity at 0.6 1/s, over 300 unless the error starts with a position."""
    f = fmpq(1) if e0_has_position else fmpq(300)
    return Scale.state + [Scale.length / f] * 3 + [fmpq(3, 5) * Scale.length / f] * 3


def lyapunov_variable(shape: str) -> Variable:
    """P as `same` diag(P, P) of the paper, `block` diag(Px, Pe), or `full`."""
    if shape == "full":
        return symmetric(12)
    if shape == "block":
        return block_diagonal([symmetric(6), symmetric(6)])
    one = symmetric(6)
    twice = one.entries + tuple((i + 6, j + 6, k, s) for i, j, k, s in one.entries)
    return Variable((12, 12), twice, one.size, is_symmetric=True)


def start_cost(P: Any, xi0: Any, cost_unit: Any) -> Any:
    """V(0) over the unit of cost."""
    return (xi0.T @ P @ xi0) / cost_unit


def squared_thrust(gamma: Any) -> Any:
    """Square of the largest thrust over its limit."""
    return gamma


def _units(values: dict[str, Any], e0_has_position: bool, cost: fmpq) -> dict[str, Any]:
    state = state_units(e0_has_position)
    scaled = rational.to_float(values["b"]) * rational.to_float(np.array(state, dtype=object))
    channels = [power_of_two(float(cost) / float(row @ row * rational.to_float(1 / Scale.rate))) for row in scaled]
    return {"P": ([cost / s for s in state], [1 / s for s in state]), "D": (channels, [fmpq(1)] * CHANNELS)}


def cost_problem(data: Any, case: str, *, shape: str, spread: bool, values: dict[str, Any] | None = None) -> Problem:
    """Minimise V(0); `spread`: one multiplier for each channel, else a single one. `values` for other gains."""
    values = values or source(data, case)
    moved = any(x != 0 for x in values["xi0"][6:9, 0])
    used = [condition(conditions.repaired), condition(conditions.lyapunov)]
    names = ("Acl", "Qbar", "a", "b", "xi0", "cost_unit")
    return Problem(
        f"REP cost, {shape}, {'diagonal' if spread else 'scalar'}",
        {"P": lyapunov_variable(shape), "D": diagonal(CHANNELS) if spread else repeated([CHANNELS])},
        used,
        {k: values[k] for k in names},
        minimise(start_cost),
        _even(_units(values, moved, Scale.cost), spread) | _common(shape),
        paper="wan2014",
        case=case,
        source=SOURCE,
    )


def _common(shape: str) -> dict[str, Any]:
    """x and e share their units where they share P."""
    both = Scale.state * 2
    return {"P": ([Scale.cost / s for s in both], [1 / s for s in both])} if shape == "same" else {}


def _even(units: dict[str, Any], spread: bool) -> dict[str, Any]:
    """One unit for all channels where they share a multiplier."""
    if not spread:
        channels = units["D"][0]
        units["D"] = ([sorted(channels)[CHANNELS // 2]] * CHANNELS, units["D"][1])
    return units


def thrust_problem(data: Any, case: str, axis: str, values: dict[str, Any] | None = None) -> Problem:
    """Minimise gamma, the square of the proven bound of one axis over its limit; P block, D diagonal."""
    values = values or source(data, case)
    moved = any(x != 0 for x in values["xi0"][6:9, 0])
    used = [
        condition(conditions.decreasing),
        condition(conditions.inside),
        condition(conditions.thrust, rename={"k": f"k_{axis}"}),
    ]
    names = ("Acl", "a", "b", "xi0", f"k_{axis}")
    units = _units(values, moved, fmpq(1)) | {"gamma": 1}
    return Problem(
        f"REP thrust {axis}",
        {"P": lyapunov_variable("block"), "D": diagonal(CHANNELS), "gamma": scalar()},
        used,
        {k: values[k] for k in names},
        minimise(squared_thrust),
        units,
        paper="wan2014",
        case=case,
        source=SOURCE,
    )


def stability_problem(data: Any, case: str) -> Problem:
    """V decreasing and P > 0 for every admissible uncertainty; P block, D diagonal. A case needs no e(0)."""
    values = source(data, case)
    used = [condition(conditions.repaired), condition(conditions.lyapunov)]
    return Problem(
        "REP stability",
        {"P": lyapunov_variable("block"), "D": diagonal(CHANNELS)},
        used,
        {k: values[k] for k in ("Acl", "Qbar", "a", "b")},
        None,
        _units(values, False, Scale.cost),
        paper="wan2014",
        case=case,
        source=SOURCE,
    )
