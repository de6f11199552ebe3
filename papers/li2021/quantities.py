"""Every number beyond the claims, by name and case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.values import Approx
from recontrol.systems.norms import hinf_norm_float
from recontrol.systems.output_feedback import Controller, closed_loop, drifted, entry_distances, response_distance
from recontrol.systems.regions import disk_radius
from recontrol.systems.vertices import sign_vertices

from .certificates.theorem import DRIFT_LIMITS
from .loops import rigid_loops
from .plant import PRINTED, controller, float_controller, floats, plant

SOLVED = 1e-4  # relative: what two interior-point solvers agree on here
EIGEN = 1e-9
OMEGA = np.concatenate([[0.0], np.logspace(-3, 2, 200)])


def quantities(data: Any, model: Any, synthesis: Any, certificates: Any, simulation: Any) -> dict[str, Any]:
    """All of them."""
    return {
        **_solved(synthesis, certificates),
        **_loops(synthesis),
        **_designs(data, model, synthesis),
        **_drift(data, synthesis),
        **_runs(simulation),
        **_random(simulation),
    }


def _solver(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: Approx(float(v), SOLVED * abs(float(v))) for name, v in values.items()}


def _eigen(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: Approx(v, EIGEN) for name, v in values.items()}


def _solved(synthesis: Any, certificates: Any) -> dict[str, Any]:
    """Optima and intervals of the matrix inequalities."""
    lemma = synthesis["printed"]["lemma"]
    pairs = synthesis["torque"]["pairs"]
    ends = {
        side: fmpq(*map(int, certificates[f"nominal-{side}"]["bound"]["value"].split("/")))
        for side in ("lower", "upper")
    }
    agreement = synthesis["nominal"]["agreement"]
    return {
        "gamma_convex": _solver(synthesis["nominal"]["gamma"]),
        "gamma_squared_convex_bounds": ends,
        "solver_spread_convex": agreement["spread"],
        "gamma_printed": _solver({k: v["gamma"] for k, v in lemma.items()}),
        "lambda_squared_printed": {k: Approx(float(v["tau"]), 0.01 * float(v["tau"])) for k, v in lemma.items()},
        "lambda_squared_lowest": _solver({k: v["tau-interval"][0] for k, v in lemma.items()}),
        "lambda_squared_highest": {
            k: Approx(float(v["tau-interval"][1]), 0.01 * float(v["tau-interval"][1])) for k, v in lemma.items()
        },
        "lambda_squared_lowest_gamma1000": _solver({k: v["tau-low-1000"] for k, v in lemma.items()}),
        "gamma_ref39_lambda1": Approx(float(lemma["ref39"]["gamma-lambda-1"]), 2e-4),
        "gamma_torque_conditions": _solver(synthesis["printed"]["torque-sets"]),
        "gamma_state_feedback": _solver(synthesis["state-feedback"]["gamma"]),
        "gamma_two_step": Approx(float(synthesis["two-step"]["gamma"]), 1e-2),
        "gamma_torque_first": _solver({k: v["gamma-first"] for k, v in pairs.items()}),
        "gamma_torque_second": {k: Approx(float(v["gamma"]), 1e-2) for k, v in pairs.items()},
        "torque_bound_lyapunov": _solver(synthesis["printed"]["bounds"]["lyapunov"]),
        "torque_bound_lemma4": _solver(synthesis["printed"]["bounds"]["lemma4"]),
        "observer_residual": Approx(float(synthesis["analysis"]["structure"]["observer-residual"]), EIGEN),
    }


def _loops(synthesis: Any) -> dict[str, Any]:
    """Poles, modes and norms of the printed loops."""
    loops, opened = synthesis["analysis"]["loops"], synthesis["analysis"]["open"]
    decay = {"open": opened["mode"], "open, zeta3 = 0.0064": opened["mode-zeta3"]}
    for name, loop in loops.items():
        decay |= {name: loop["mode"], f"{name}, zeta3 = 0.0064": loop["mode-zeta3"]}
    table = {
        "abscissa_rigid": "abscissa",
        "disk_radius_flexible": "flexible-radius",
        "abscissa_flexible": "flexible-abscissa",
        "static_gain": "static-gain",
        "hinf_rigid": "hinf",
        "hinf_rigid_sweep": "hinf-sweep",
        "hinf_flexible": "hinf-flexible",
        "hinf_flexible_sweep": "hinf-flexible-sweep",
        "abscissa_reversed_sign": "reversed-abscissa",
    }
    out = {q: _eigen({n: float(loop[key]) for n, loop in loops.items()}) for q, key in table.items()}
    rounding = {f"{n}, {k}": float(loop["rounding"][k]) for n, loop in loops.items() for k in ("linearised", "random")}
    proven = {f"{n}, {r}": bool(v) for n, loop in loops.items() for r, v in loop["rounding"]["proven"].items()}
    return out | {
        "mode_decay_rate": _eigen({n: -complex(v).real for n, v in decay.items()}),
        "rounding_radius": _eigen(rounding),
        "rounding_radius_proven": proven,
    }


def design_controllers(data: Any, synthesis: Any) -> dict[str, Controller]:
    """Every controller of the design table in floats."""
    nominal = synthesis["nominal"]["designs"]
    found = {
        "P1 min gamma": nominal["min-gamma"],
        "P1 max margin": nominal["max-margin"],
        "P1 min trace": nominal["min-trace"],
        "P4 two-step": synthesis["two-step"]["design"],
        "P5 torque": synthesis["torque"]["design"],
        "P7 early stop": synthesis["early-stop"]["controller"],
        "[39], structured": synthesis["analysis"]["ref39-structured"],
    }
    printed = {name: float_controller(controller(data, name)) for name in PRINTED}
    return printed | {n: Controller(*(np.asarray(c[k], dtype=float) for k in "ABC")) for n, c in found.items()}


def _designs(data: Any, model: Any, synthesis: Any) -> dict[str, Any]:
    """The design table: distances, disk, norm, vertices, flexible loop."""
    p = floats(plant(data))
    a, bound = data.float("disk_a"), data.float("drift_bound")
    corners = bound * sign_vertices(12)
    flexible = {k: np.asarray(model["flexible"][k]) for k in "AB"}
    outputs = np.hstack([np.eye(3), np.zeros((3, 11))])
    B, C = np.vstack([p["B"], np.zeros((6, 3))]), np.hstack([p["C"], np.zeros((3, 6))])
    controllers = design_controllers(data, synthesis)
    names = ("distance_A", "distance_B", "distance_C", "response_distance_print", "response_distance_ref39",
    "disk_radius",
             "hinf_design", "vertex_radius_gains", "abscissa_flexible_design")  # fmt: skip
    out: dict[str, Any] = {name: {} for name in names}
    for name, c in controllers.items():
        A = closed_loop(p["A"], p["B"], p["C"], c)
        loop = closed_loop(flexible["A"], flexible["B"], outputs, c)
        entries = entry_distances(c, controllers["proposed"])
        row = [*(entries[k] for k in "ABC")]
        row += [response_distance(c, controllers[printed], OMEGA) for printed in PRINTED]
        row.append(float(disk_radius(np.linalg.eigvals(A), a)))
        row.append(hinf_norm_float(A, B, C, np.zeros((3, 3))))
        row.append(float(disk_radius(np.linalg.eigvals(rigid_loops(p, drifted(c, corners))), a).max()))
        row.append(float(np.linalg.eigvals(loop).real.max()))
        for quantity, value in zip(names, row, strict=True):
            out[quantity][name] = Approx(value, 1e-4)
    return out


def _drift(data: Any, synthesis: Any) -> dict[str, Any]:
    """Gain drift and inertia error: vertices, limits, scaled inequalities."""
    v, s = synthesis["vertices"], synthesis["scaled"]
    worst = {q: _eigen({n: float(v[n][key]) for n in PRINTED}) for q, key in (
        ("vertex_radius", "radius"), ("vertex_abscissa", "abscissa"), ("vertex_static_gain", "static-gain"),
        ("vertex_abscissa_flexible", "flexible-abscissa"), ("interior_radius", "interior-radius"))}  # fmt: skip
    limits = {
        f"drift_limit_{what}": {n: Approx(float(np.mean(v[n]["limits"][what])), 5e-5) for n in PRINTED}
        for what in ("disk", "stability")
    }
    p = floats(plant(data))
    disk = s["disk-with-inertia"]
    return {
        **worst,
        **limits,
        "drift_limit_eq13": {
            f"{kind}, {side}": fmpq(*_decimal(end))
            for kind, ends in DRIFT_LIMITS.items()
            for side, end in zip(("holds", "empty"), ends, strict=True)
        },
        "gamma_scaled": _solver(s["hinf"]["gamma"]),
        "disk_scaled_margin": Approx(float(s["disk"]["margin"]), 1e-7),
        "drift_limit_scaled_disk_with_inertia": Approx((disk["reached"] + disk["refused"]) / 2, 1e-3),
        "delta_A_norm": Approx(float(np.linalg.norm(p["L"], 2) * np.linalg.norm(p["K"], 2)), 1e-12),
    }


def _decimal(text: str) -> tuple[int, int]:
    whole, _, fraction = text.partition(".")
    return int(whole + fraction), 10 ** len(fraction)


def _runs(simulation: Any) -> dict[str, Any]:
    """S1 to S3 and the integrators."""
    cases = {n: v for n, v in simulation["attitude"]["values"].items() if n != "offset"}

    def collect(key: str, error: float) -> dict[str, Any]:
        return {n: Approx(np.asarray(v[key], dtype=float), error) for n, v in cases.items()}

    settling = {
        f"{n}, {band} rad": [x if isinstance(x, str) else Approx(float(x), 0.01) for x in list(times)]
        for n, v in cases.items()
        for band, times in v["settling"].items()
    }
    return {
        "peak_torque": {n: Approx(float(v["peak_torque"]), 1e-6) for n, v in cases.items()},
        "peak_torque_time": {n: Approx(float(v["peak_torque_time"]), 0.01) for n, v in cases.items()},
        "peak_torque_axes": collect("peak_torque_axes", 1e-6),
        "final_angles": collect("final_angles", 1e-8),
        "peak_modes": collect("peak_modes", 1e-8),
        "late_modes": collect("late_modes", 1e-8),
        "settling_time": settling,
        "predicted_offset": {
            n: Approx(np.asarray(v), EIGEN) for n, v in simulation["attitude"]["values"]["offset"].items()
        },
        "orbit_angles": {n: Approx(np.asarray(v), 1e-6) for n, v in simulation["orbit"]["values"].items()},
        "integrator_difference": {n: Approx(float(v), 1e-12) for n, v in simulation["integrators"]["values"].items()},
    }


def _random(simulation: Any) -> dict[str, Any]:
    """S4 and S5."""
    table, constant = simulation["draws"]["values"], simulation["constant-gains"]["values"]
    by_run = {f"{case}, {n}": cell[n] for case, cell in table.items() for n in PRINTED}
    share = {
        f"{n}, {what}": Approx(float(v["share"]), 2 * float(v["standard-error"]) + 1e-4)
        for n, cell in constant.items()
        for what, v in cell.items()
    }
    return {
        "draws_diverged": {k: int(v["diverged"]) for k, v in by_run.items()},
        "draws_residual": {
            k: None if v["median"] is None else Approx(float(v["median"]), 1e-6) for k, v in by_run.items()
        },
        "draws_torque": {
            k: None if v["torque"] is None else Approx(float(v["torque"]), 1e-4) for k, v in by_run.items()
        },
        "draws_proposed_smaller": {case: int(cell["proposed-smaller"]) for case, cell in table.items()},
        "constant_gains": share,
    }
