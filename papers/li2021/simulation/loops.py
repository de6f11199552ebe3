"""The closed loop of many runs at once: flexible attitude, controllers with drifting gains, disturbance.

State of a run, 20 rows: q (3) [rad], w or q' (3) [rad/s], eta (4), eta' (4), x_f (6). Drift multiplies the columns of
A_f and B_f and the rows of C_f, so u = (I + F3) C_f x_f.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from recontrol.spacecraft.flexible import FlexibleAttitude, LinearFlexibleAttitude
from recontrol.systems.output_feedback import Controller

Array = np.ndarray
Drift = Callable[[int, float], Array]  # number of the step, time [s] -> (12, runs) or a scalar
PLANT_STATES = 14
OFF = Controller(np.zeros((6, 6)), np.zeros((6, 3)), np.zeros((3, 6)))
NOMINAL = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Run:
    """What distinguishes one run: controller, inertia deviations delta_i, and which parts of the experiment act."""

    controller: Controller
    delta: tuple[float, float, float] = NOMINAL
    disturbed: float = 1.0
    drift: float = 1.0
    zeta3: float | None = None
    informed: bool = False  # x_f(0) = [q(0); qdot(0)] instead of 0


def plant_of(runs: Sequence[Run], data: Any, linear: bool) -> Any:
    """The flexible plant of all runs, each with its own inertia and damping."""
    inertia = np.ravel(data.float("J0"))[:, None]
    envelope = np.ravel(data.float("inertia_envelope"))[:, None]
    J = inertia * (1 + envelope * np.array([run.delta for run in runs]).T)
    count = len(runs)
    frequency = np.repeat(data.float("modal_frequency").T, count, axis=1)
    damping = np.repeat(data.float("damping_ratio").T, count, axis=1)
    damping[2] = [damping[2, 0] if run.zeta3 is None else run.zeta3 for run in runs]
    kind = LinearFlexibleAttitude if linear else FlexibleAttitude
    return kind(J, data.float("F"), frequency, damping, data.float("orbital_rate"))


class Ensemble:
    """Right side, initial state and outputs of several runs."""

    def __init__(self, runs: Sequence[Run], data: Any, *, linear: bool = False) -> None:
        self.runs, self.plant = list(runs), plant_of(runs, data, linear)
        self.rate = data.float("orbital_rate")
        inertia = np.ravel(data.float("J0"))[:, None] * (
            1 + data.float("inertia_envelope").T * np.array([run.delta for run in runs]).T
        )
        self.torque = inertia * data.float("disturbance") * np.array([run.disturbed for run in runs])
        self.AB = np.stack([np.hstack([run.controller.A, run.controller.B]) for run in runs])
        self.C = np.stack([run.controller.C for run in runs])
        self.drifting = np.array([run.drift for run in runs])
        self.q0, self.qd0 = data.float("q0").T, data.float("qd0").T

    def initial(self) -> Array:
        """States (20, runs) at time 0: modes at rest."""
        q, qd = (np.repeat(v, len(self.runs), axis=1) for v in (self.q0, self.qd0))
        informed = np.array([run.informed for run in self.runs])
        return np.vstack([self.plant.initial(q, qd), np.vstack([q, qd]) * informed])

    def disturbance(self, t: float) -> Array:
        """Disturbance torque (3, runs) [N m]."""
        c, s = np.cos(self.rate * t), np.sin(self.rate * t)
        return self.torque * np.array([[3 * c + 1], [1.5 * s + 3 * c], [3 * s + 1]])

    def control(self, states: Array, drift: Any) -> Array:
        """Torque (3, runs) [N m] of states (20, runs)."""
        u = np.matmul(self.C, states[PLANT_STATES:].T[:, :, None])[:, :, 0].T
        return u * (1 + (drift[9:] if np.ndim(drift) > 1 else drift))

    def rhs(self, drift: Drift) -> Callable[[int, float, Array], Array]:
        """Right side for `recontrol.simulate.rk4`."""

        def function(k: int, t: float, x: Array) -> Array:
            f = drift(k, t) * self.drifting
            u = self.control(x, f)
            fed = np.concatenate([x[PLANT_STATES:], x[:3]]) * (1 + (f[:9] if np.ndim(f) > 1 else f))
            moved = np.matmul(self.AB, fed.T[:, :, None])[:, :, 0].T
            return np.concatenate([self.plant.derivative(x[:PLANT_STATES], u + self.disturbance(t)), moved])

        return function


def sine_drift(amplitude: float) -> Drift:
    """The drift of Table 1, the same for every gain."""
    return lambda k, t: amplitude * np.sin(2 * np.pi * t)
