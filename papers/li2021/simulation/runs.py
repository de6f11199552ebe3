"""Figs 4-7 and their variations (S1, S2), the comparison of integrators, and one orbit (S3)."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.rk4 import rk4
from recontrol.simulate.sampled import last_outside
from recontrol.systems.output_feedback import Controller

from ..plant import controller, float_controller
from .loops import OFF, Ensemble, Run, sine_drift

Array = np.ndarray
STEP, HORIZON, LATE = 0.01, 200.0, 180.0
BANDS = (0.01, 0.005, 0.002)
SERIES = ("base", "control-off", "ref39")


def cases(data: Any, synthesis: Any) -> dict[str, Run]:
    """The runs of S1 and S2 by name; ``linear`` is added by `attitude`."""
    proposed, ref39 = (float_controller(controller(data, name)) for name in ("proposed", "ref39"))
    designs = {
        "design-convex": synthesis["nominal"]["designs"]["min-gamma"],
        "design-two-step": synthesis["two-step"]["design"],
        "design-torque": synthesis["torque"]["design"],
    }
    return {
        "base": Run(proposed),
        "delta+++": Run(proposed, delta=(1, 1, 1)),
        "delta---": Run(proposed, delta=(-1, -1, -1)),
        "delta+--": Run(proposed, delta=(1, -1, -1)),
        "undisturbed": Run(proposed, disturbed=0.0),
        "no-drift": Run(proposed, drift=0.0),
        "zeta3": Run(proposed, zeta3=0.0064),
        "informed": Run(proposed, informed=True),
        "ref39": Run(ref39),
        "ref39-no-drift": Run(ref39, drift=0.0),
        **{name: Run(Controller(c["A"], c["B"], c["C"])) for name, c in designs.items()},
        "control-off": Run(OFF),
    }


def attitude(data: Any, synthesis: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """S1 and S2: values of every case, series of the cases that the figures show."""
    runs = cases(data, synthesis)
    amplitude = data.float("drift_bound")
    values: dict[str, Any] = {}
    series: dict[str, Array] = {}
    for linear, chosen in ((False, runs), (True, {"linear": runs["base"]})):
        ensemble = Ensemble(list(chosen.values()), data, linear=linear)
        t, x = rk4(ensemble.rhs(sine_drift(amplitude)), ensemble.initial(), STEP, round(HORIZON / STEP))
        for k, name in enumerate(chosen):
            histories = _histories(ensemble, t, x, k, amplitude)
            values[name] = _measures(t, histories)
            if name in SERIES:
                series |= {f"{name}/{what}": history for what, history in histories.items()}
    series["time"] = t
    values["offset"] = {name: _offset(data, name) for name in ("proposed", "ref39")}
    return values, series


def _histories(ensemble: Ensemble, t: Array, x: Array, k: int, amplitude: float) -> dict[str, Array]:
    """Angles, rates, torque (samples, 3) and modes (samples, 4) of run k."""
    states = np.moveaxis(x, 1, 0)
    drift = amplitude * np.sin(2 * np.pi * t) * ensemble.drifting[k]
    torque = (x[:, 14:, k] @ ensemble.C[k].T) * (1 + drift)[:, None]
    rates = ensemble.plant.angle_rates(states[:14])[:, :, k].T
    return {"angles": x[:, :3, k], "rates": rates, "torque": torque, "modes": x[:, 6:10, k]}


def _measures(t: Array, h: dict[str, Array]) -> dict[str, Any]:
    """What S1 asks for one run."""
    norm = np.linalg.norm(h["torque"], axis=1)
    half, late = t >= HORIZON / 2, t >= LATE
    angles, modes = np.abs(h["angles"]), np.abs(h["modes"])
    return {
        "peak_torque": float(norm.max()),
        "peak_torque_time": float(t[norm.argmax()]),
        "peak_torque_axes": np.abs(h["torque"]).max(axis=0),
        "final_angles": h["angles"][-1],
        "late_angles": angles[half].max(axis=0),
        "late_rates": np.abs(h["rates"])[half].max(axis=0),
        "peak_rates": np.abs(h["rates"]).max(axis=0),
        "settling": {f"{band:g}": [_settling(t, angle, band) for angle in angles.T] for band in BANDS},
        "peak_modes": modes.max(axis=0),
        "late_modes": modes[late].max(axis=0),
    }


def _settling(t: Array, size: Array, band: float) -> Any:
    """First sample time after the last exit from the band, 0 if there is none, "never" if still outside."""
    found = last_outside(t, size, band)
    return "never" if found is None else found


def _offset(data: Any, name: str) -> Array:
    """Angles (3,) [rad] at which the rigid loop balances the disturbance torque of time 0."""
    from ..plant import floats, loop, plant

    m = floats(loop(plant(data), controller(data, name)))
    torque = data.float("disturbance") * np.ravel(data.float("J0")) * np.array([4.0, 3.0, 1.0])
    return -m["C"] @ np.linalg.solve(m["A"], m["B"] @ torque)


def integrators(data: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """Base case over 100 s: RK4 at half the step, DOP853 and Radau against RK4 at 0.01 s."""
    from recontrol.simulate.ode import integrate

    ensemble = Ensemble([Run(float_controller(controller(data, "proposed")))], data)
    rhs, x0 = ensemble.rhs(sine_drift(data.float("drift_bound"))), ensemble.initial()
    t, x = rk4(rhs, x0, STEP, 10000, every=100)
    _, fine = rk4(rhs, x0, STEP / 2, 20000, every=200)

    def flat(time: float, state: Array) -> Array:
        return rhs(0, time, state[:, None])[:, 0]

    found = {"rk4-half-step": fine[:, :, 0]}
    for method, rtol, atol in (("DOP853", 1e-11, 1e-13), ("Radau", 1e-9, 1e-12)):
        found[method] = integrate(flat, x0[:, 0], t, method=method, rtol=rtol, atol=atol)
    return {name: float(np.abs(y - x[:, :, 0]).max()) for name, y in found.items()}, {}


def orbit(data: Any) -> tuple[dict[str, Any], dict[str, Array]]:
    """S3: one orbital period, printed controller with nominal gains; largest angles after 200 s.

    Radau at rtol 1e-7 takes the place of 3.5 million evaluations at a fixed step of 0.1 s; `integrators` compares both
    kinds over 100 s.
    """
    from recontrol.simulate.ode import integrate

    times = np.linspace(0.0, 2 * np.pi / data.float("orbital_rate"), 8641)
    ensemble = Ensemble([Run(float_controller(controller(data, "proposed")), drift=0.0)], data)
    rhs = ensemble.rhs(sine_drift(0.0))

    def flat(t: float, state: Array) -> Array:
        return rhs(0, t, state[:, None])[:, 0]

    x = integrate(flat, ensemble.initial()[:, 0], times, method="Radau", rtol=1e-7, atol=1e-10)
    largest = np.abs(x[times > 200.0, :3]).max(axis=0)
    return {"proposed": largest}, {"time": times[::8], "angles": x[::8, :3]}
