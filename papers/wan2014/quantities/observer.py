"""Mean motion, observability, poles and the observer gain."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.exact import ball, rational

from .. import model as plants
from .. import pole_boxes

ENTRY = (1, 0)


def _relative_eigenvalues(data: Any, model: Any) -> dict[str, np.ndarray]:
    """Eigenvalues of the blocks of (14) at the printed X, Y after the congruence with diag(X)^-1/2."""
    X, Y = data.float("X"), data.float("Y")
    A, B = rational.to_float(model["A"]["n_printed"]), rational.to_float(model["B"])
    scale = np.diag(X) ** -0.5
    blocks = {f"(2,2), {case}": (A - data.float(case) @ data.float("C")) @ X for case in ("L_printed", "L_corrected")}
    blocks["(1,1)"] = A @ X - B @ Y
    return {name: np.linalg.eigvalsh(scale[:, None] * (M + M.T) * scale[None, :]) for name, M in blocks.items()}


def _L21(data: Any, A: np.ndarray) -> dict[str, Any]:
    """Entry (2,1) for which some L in the other 17 boxes has the poles: proven inside, float outside."""
    half, found = data.half("L_corrected"), {}
    for name, largest in (("low", False), ("high", True)):
        outer = pole_boxes.range_of_entry(data, A, data["L_corrected"], half, ENTRY, largest=largest, within=1.0)
        inner = pole_boxes.range_of_entry(data, A, data["L_corrected"], half, ENTRY, largest=largest, within=0.999)
        exact = rational.rounded(inner, 14)
        proven, _, _ = pole_boxes.krawczyk(data, A, exact, fixed=ENTRY)
        found[f"{name}, float"] = float(outer[ENTRY])
        found[f"{name}, proven inside"] = exact[ENTRY] if proven else None
    return found


def _condition(M: np.ndarray) -> float:
    return float(np.linalg.cond(np.linalg.eig(M)[1]))


def quantities(data: Any, model: Any, synthesis: Any) -> dict[str, Any]:
    """Quantities of this topic."""
    A, B = rational.to_float(model["A"]["n_printed"]), rational.to_float(model["B"])
    loops = {case: A - data.float(case) @ data.float("C") for case in ("L_printed", "L_corrected")}
    loops["A-BK"] = A - B @ data.float("K")
    exact = plants.plant(data, data["n_printed"])["A"]
    report = synthesis["placement"]["report"]
    with ball.precision(128):
        repairs = pole_boxes.single_entry_repairs(data, exact, data["L_printed"], data.half("L_printed"))
        multiples = {
            case: pole_boxes.nearest(data, exact, data[case], data.half(case))[0]
            for case in ("L_printed", "L_corrected")
        }
        entry = _L21(data, exact)
    return {
        "mean_motion": dict(model["n"]),
        "observable_selections": " ".join(model["observable"]["words"]),
        "observable_frozen": {case: int(count) for case, count in model["observable"]["frozen"].items()},
        "loop_poles": dict(model["poles"]),
        "eigenvector_condition": {case: _condition(M) for case, M in loops.items()},
        "placement_distance": {name: float(entry["distance"]) for name, entry in report.items()},
        "placement_pole_error": {name: float(entry["pole_error"]) for name, entry in report.items()},
        "L_multiple": multiples,
        "L21_interval": entry,
        "single_entry_repairs": {k: "excluded" if v is False else "open" for k, v in repairs.items()},
        "t_star": {name: float(entry["t"]) for name, entry in synthesis["multipliers"].items()},
        "block_eigenvalues": _relative_eigenvalues(data, model),
        "lqr_cost": float(model["lqr"]["cost"]),
        "lqr_thrust": np.asarray(model["lqr"]["thrust"]),
    }
