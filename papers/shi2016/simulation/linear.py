"""Linear runs x' = A x + B1 (K + Delta K(t)) x + B2 d(t) from the printed initial state, 600 s, sampled every 0.01 s.

Without Delta K the run is exact stepping of the plant with its oscillator; with Delta K it is DOP853 (rtol 1e-11).
Default Earth radius; d cases for the runs without Delta K.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.simulate.linear import propagate
from recontrol.simulate.ode import integrate

from .. import plant
from .measures import measures

STEP, HORIZON, ENERGY_HORIZON = 0.01, 600.0, 1200.0
DISTURBANCES = {"d-omega0": 1.0, "d-10omega0": 10.0, "d-100omega0": 100.0, "d-1": None}
"""Case -> angular frequency of d in orbital rates (None: 1 rad/s)."""

DEFAULT_DISTURBANCE = "d-omega0"
PERTURBED = ("N-printed", "N-interleaved")
WINDOWS = {"ext": 60.0, "trad": 400.0, "ext-N-printed": 60.0, "trad-N-printed": 200.0}
"""Run -> end of its figures [s]."""


def linear(data: Any) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Values per run (and per d case for the runs without Delta K), series for the figures."""
    values: dict[str, Any] = {"runs": {}, "disturbance": {}, "crosscheck": {}}
    series: dict[str, np.ndarray] = {}
    for gain in plant.GAINS:
        loop = Loop(data, gain)
        for case in DISTURBANCES:
            x = loop.free(case, HORIZON)
            found = loop.measures(x, None, case)
            found["energy"] = loop.energy(case)
            found["steady_amplitude"] = loop.steady_amplitude(case)
            values["disturbance"].setdefault(gain, {})[case] = found
            if case == DEFAULT_DISTURBANCE:
                _store(values, series, loop, gain, x, None)
        values["crosscheck"][gain] = loop.crosscheck()
        for shape in PERTURBED:
            _store(values, series, loop, f"{gain}-{shape}", loop.perturbed(shape), shape)
    return values, series


def _store(values: dict, series: dict, loop: Loop, name: str, x: np.ndarray, shape: str | None) -> None:
    found = loop.measures(x, shape, DEFAULT_DISTURBANCE)
    if shape is not None:
        found["growth_per_period"] = loop.growth(x)
        found["crosscheck"] = loop.stiff_difference(x, shape)
    values["runs"][name] = found
    every = slice(None, None, 25)
    series[f"{name}.t_all"] = loop.times[every]
    series[f"{name}.largest"] = np.abs(x[every, :3]).max(axis=1)
    if name in WINDOWS:
        last = round(WINDOWS[name] / STEP)
        part = slice(0, last + 1, max(1, last // 1200))
        u, z = loop.outputs(x, shape, DEFAULT_DISTURBANCE)
        series |= {f"{name}.t": loop.times[part], f"{name}.x": x[part], f"{name}.u": u[part], f"{name}.z_inf": z[part]}


class Loop:
    """One gain with the plant of the default case, floats, SI units."""

    def __init__(self, data: Any, gain: str):
        self.plant = plant.float_plant(data)
        self.K = self.plant[plant.GAINS[gain]]
        self.A = self.plant["A"] + self.plant["B1"] @ self.K
        self.x0 = data.float("x0")[0]
        self.largest_angle = float(np.abs(self.x0[:3]).max())
        self.times = np.linspace(0.0, HORIZON, round(HORIZON / STEP) + 1)
        self.amplitude = float(data["d_amplitude"])
        self.d_phases = np.pi * data.float("d_phases")[0]
        self.frequency = float(data["F_factor"]) * self.plant["rate"]
        self.phase = np.pi * float(data["F_phase"])
        self.rows = {shape: data.float("M") @ data.float(name) for shape, name in plant.SHAPES.items()}
        self.weight = float(data["z_weight"])

    def omega(self, case: str) -> float:
        """Angular frequency of d [rad/s]."""
        factor = DISTURBANCES[case]
        return 1.0 if factor is None else factor * self.plant["rate"]

    def d(self, t: Any, case: str) -> np.ndarray:
        """Disturbance torque [N m], (3,) or (N, 3)."""
        return self.amplitude * np.sin(self.omega(case) * np.asarray(t)[..., None] + self.d_phases)

    def free(self, case: str, horizon: float) -> np.ndarray:
        """States (N, 6) without Delta K by exact stepping of plant and oscillator (sin wt, cos wt)."""
        w = self.omega(case)
        drive = self.amplitude * np.column_stack([np.cos(self.d_phases), np.sin(self.d_phases)])
        oscillator = np.array([[0.0, w], [-w, 0.0]])
        matrix = np.block([[self.A, self.plant["B2"] @ drive], [np.zeros((2, 6)), oscillator]])
        return propagate(matrix, np.append(self.x0, [0.0, 1.0]), STEP, round(horizon / STEP) + 1)[:, :6]

    def change(self, t: float, shape: str | None) -> np.ndarray:
        """Delta K(t) (3, 6)."""
        if shape is None:
            return np.zeros((3, 6))
        return np.sin(self.frequency * t + self.phase) * self.rows[shape]

    def rhs(self, shape: str | None, case: str) -> Any:
        """Right side of the state equation."""
        return lambda t, x: (
            self.A @ x + self.plant["B1"] @ (self.change(t, shape) @ x) + self.plant["B2"] @ self.d(t, case)
        )

    def perturbed(self, shape: str) -> np.ndarray:
        """States (N, 6) with Delta K."""
        return integrate(self.rhs(shape, DEFAULT_DISTURBANCE), self.x0, self.times, rtol=1e-11, atol=1e-14)

    def outputs(self, x: np.ndarray, shape: str | None, case: str) -> tuple[np.ndarray, np.ndarray]:
        """Torques u and output z_inf, (N, 3) each."""
        u = x @ self.K.T
        if shape is not None:
            u += np.sin(self.frequency * self.times + self.phase)[:, None] * (x @ self.rows[shape].T)
        z = self.weight * (u + x @ self.plant["low"].T + self.d(self.times, case))
        return u, z

    def measures(self, x: np.ndarray, shape: str | None, case: str) -> dict[str, Any]:
        """See `simulation.measures`."""
        return measures(self.times, x, *self.outputs(x, shape, case), self.largest_angle)

    def energy(self, case: str) -> float:
        """Integral of |z2|^2 over 1200 s [rad^2 s], Simpson's rule."""
        from scipy.integrate import simpson

        return float(simpson((self.free(case, ENERGY_HORIZON)[:, :3] ** 2).sum(axis=1), dx=STEP))

    def steady_amplitude(self, case: str) -> np.ndarray:
        """Amplitude of each angle under d in the steady state [rad]."""
        phasor = self.amplitude * np.exp(1j * self.d_phases)
        response = np.linalg.solve(1j * self.omega(case) * np.eye(6) - self.A, self.plant["B2"] @ phasor)
        return np.abs(response[:3])

    def growth(self, x: np.ndarray) -> float:
        """Ratio of the largest angle from one period of F to the next, over the last six periods."""
        period = round(2 * np.pi / self.frequency / STEP)
        largest = np.abs(x[:, :3]).max(axis=1)
        peaks = [largest[len(x) - (k + 1) * period : len(x) - k * period].max() for k in range(6)]
        return float((peaks[0] / peaks[-1]) ** (1 / 5))

    def crosscheck(self) -> dict[str, float]:
        """Largest difference of DOP853 and of Radau from exact stepping [rad, rad/s], no Delta K, 200 s."""
        times = self.times[: round(200.0 / STEP) + 1 : 100]
        exact = self.free(DEFAULT_DISTURBANCE, 200.0)[::100]
        rhs = self.rhs(None, DEFAULT_DISTURBANCE)
        runs = {
            "DOP853": integrate(rhs, self.x0, times, rtol=1e-11, atol=1e-14),
            "Radau": integrate(rhs, self.x0, times, method="Radau", rtol=1e-9, atol=1e-12),
        }
        return {name: float(np.abs(run - exact).max()) for name, run in runs.items()}

    def stiff_difference(self, x: np.ndarray, shape: str) -> float:
        """Difference of Radau (1e-9, 1e-12) from the run over 200 s, over the largest state."""
        part = slice(0, round(200.0 / STEP) + 1, 100)
        rhs = self.rhs(shape, DEFAULT_DISTURBANCE)
        run = integrate(rhs, self.x0, self.times[part], method="Radau", rtol=1e-9, atol=1e-12)
        return float(np.abs(run - x[part]).max() / np.abs(x[part]).max())
