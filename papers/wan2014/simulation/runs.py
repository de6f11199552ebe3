"""The published loop around the two-body motion: main cases, routes, other gains, and the free drift of the models."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..loop import Array, simulate, simulate_inertial, time_grid
from .metrics import HORIZON, STARTS, make_batch, metrics, target_orbit


def main(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """Three xhat(0), unclipped and clipped, with the printed K and L corrected, over 6000 s."""
    runs = [{"estimate": start, "clip": clip} for clip in (False, True) for start in STARTS]
    names = [f"{run['estimate']}{'_clipped' if run['clip'] else ''}" for run in runs]
    times = time_grid(HORIZON)
    found = simulate(make_batch(data, model, runs), times)
    values = {name: metrics(times, found, k) for k, name in enumerate(names)}
    reference = found["command"][:, :, 0]
    for k, name in enumerate(names[: len(STARTS)]):
        values[name] |= _fluctuation(times, found["command"][:, :, k], reference)
    keep = _decimated(times)
    series = {"time": times[keep]}
    for k, name in enumerate(names):
        series[f"{name}_state"] = found["state"][:, keep, k]
        series[f"{name}_velocity_error"] = (found["state"] - found["estimate"])[3:, keep, k]
        series[f"{name}_command"] = found["command"][:, keep, k]
        series[f"{name}_applied"] = found["applied"][:, keep, k]
    return values, series


def _fluctuation(times: Array, command: Array, reference: Array) -> dict[str, float]:
    """Thrust minus that without observer error, per axis over the latter's peak: largest in 0-10 s, from 20 s on."""
    ratio = (np.abs(command - reference) / np.abs(reference).max(axis=1)[:, None]).max(axis=0)
    return {"fluctuation_10s": float(ratio[times <= 10].max()), "fluctuation_later": float(ratio[times >= 20].max())}


def _decimated(times: Array) -> Array:
    """Indices kept for figures: every 0.05 s to 60 s, then every 5 s."""
    fine = np.flatnonzero(times < 60)[::5]
    coarse = np.flatnonzero(times >= 60)[::10]
    return np.concatenate([fine, coarse])


def routes(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """Position at 3000 s by DOP853, Radau and two inertial Kepler bodies; largest difference of each pair [m]."""
    runs = [{"estimate": start, "clip": clip} for clip in (False, True) for start in STARTS]
    times = np.array([0.0, 1500.0, 3000.0])
    batch = make_batch(data, model, runs)
    first = simulate(batch, times)["state"]
    inertial = simulate_inertial(batch, times)
    radau = np.stack(
        [simulate(make_batch(data, model, [run]), times, "Radau", 1e-8)["state"][:, :, 0] for run in runs], axis=2
    )
    gaps = {"inertial": inertial, "radau": radau}
    values = {
        f"{name}_{run['estimate']}{'_clipped' if run['clip'] else ''}": float(np.abs(other - first)[:3, -1, k].max())
        for name, other in gaps.items()
        for k, run in enumerate(runs)
    }
    return {"gap": values, "largest": max(values.values())}, {"times": times, "dop853": first, **gaps}


def gains(data: Any, model: Any, synthesis: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """Other gains in the loop, observer started from the measured position, unclipped."""
    placed = synthesis["placement"]
    options: dict[str, dict[str, Any]] = {
        "printed": {},
        "L_printed": {"L": data.float("L_printed")},
        "L_yang_tits": {"L": placed["yang_tits"]},
        "K_YX": {"K": model["K0_YX"]},
        "K_SF": {"K": synthesis["SF"]["R2"]["K"]},
        "K_CO": {"K": synthesis["CO"]["n_orbit_R2"]["K"]},
        "K_kappa1": {"K": synthesis["variants"]["kappa1_R1"]["K"]},
    }
    runs = [{"estimate": "xhat0_r0", **option} for option in options.values()]
    times = time_grid(HORIZON)
    found = simulate(make_batch(data, model, runs), times)
    return {name: metrics(times, found, k) for k, name in enumerate(options)}, {"time": times[:1]}


DRIFT_TIMES = (600.0, 1000.0, 2000.0, 3000.0)


def drift(data: Any, model: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """Free drift from x(0): position error [m] of the circular and the near-circular model against two bodies."""
    from recontrol.exact.rational import to_float
    from recontrol.simulate.ode import integrate
    from recontrol.spacecraft import orbit

    target, x0, e = target_orbit(data), data.float("x0")[:, 0], data.float("e")
    times = np.array([0.0, *DRIFT_TIMES, target.period])
    truth = []
    for t in times:
        position, velocity = orbit.to_inertial(target, 0.0, x0)
        body = orbit.propagate_kepler(target.gm, position, velocity, float(t))
        truth.append(orbit.to_rotating(target, float(target.true_anomaly(t)), *body)[:3])
    values: dict[str, Any] = {"times": times[1:]}
    for name in ("n_orbit", "n_printed"):
        n = float(to_float(model["n"][name]))
        for label, eccentricity in (("circular", 0.0), ("near_circular", e)):

            def rhs(t: float, x: Array, n: float = n, e: float = eccentricity) -> Array:
                return (orbit.clohessy_wiltshire(n) + orbit.near_circular(n, e, np.cos(n * t), np.sin(n * t))) @ x

            states = integrate(rhs, x0, times, rtol=1e-11, atol=1e-8)
            values[f"{name}_{label}"] = np.linalg.norm(states[1:, :3] - np.array(truth)[1:], axis=1)
    return values, {"times": times}
