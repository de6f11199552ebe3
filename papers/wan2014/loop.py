"""The observer-based loop (7), (10) around the exact relative two-body motion, by three routes.

In: gains, start states, the target orbit. Out: states, estimates and thrusts on a time grid. Runs of a batch are
integrated together as columns, so that one adaptive step serves them all.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recontrol.spacecraft import orbit

Array = NDArray[Any]
FINE_END, FINE_STEP, COARSE_STEP = 60.0, 0.01, 0.5  # s
KINK_STEP = 0.1  # s


@dataclass(frozen=True)
class Batch:
    """N runs that share the controller's model (A, mass) and differ in everything else.

    K (N, 3, 6) [N/m, N s/m]; L (N, 6, 3) [1/s, 1/s^2]; limit (N, 3) [N], infinite where thrust is not clipped;
    start, estimate (6, N) [m, m/s]; orbits: N targets; anomaly (N,) true anomaly at the start [rad].
    """

    A: Array
    mass: float
    K: Array
    L: Array
    limit: Array
    start: Array
    estimate: Array
    orbits: tuple[orbit.KeplerOrbit, ...]
    anomaly: Array

    def thrust(self, estimate: Array) -> tuple[Array, Array]:
        """Commanded and applied thrust (3, ..., N) [N] at estimates (6, ..., N)."""
        command = -np.einsum("nij,j...n->i...n", self.K, estimate)
        bound = self.limit.T.reshape((3,) + (1,) * (command.ndim - 2) + (-1,))
        return command, np.clip(command, -bound, bound)

    def observer(self, estimate: Array, applied: Array, position: Array) -> Array:
        """Right-hand side (6, N) of the observer (7); B u is the applied thrust over the mass."""
        rate = self.A @ estimate + np.einsum("nij,jn->in", self.L, position - estimate[:3])
        rate[3:] += applied / self.mass
        return rate


def time_grid(horizon: float) -> Array:
    """Recording times [s]: every 0.01 s to 60 s, then every 0.5 s."""
    fine = np.arange(round(FINE_END / FINE_STEP)) * FINE_STEP
    return np.concatenate([fine, np.arange(FINE_END, horizon + COARSE_STEP / 2, COARSE_STEP)])


def _integrate(batch: Batch, rhs: Any, first: Array, times: Array, **options: Any) -> Array:
    """States (n_t, n); where thrust is clipped, short steps in the first minute.

    A clipped thrust has kinks, at which the error estimate of a long step is too small by orders of magnitude.
    """
    from recontrol.simulate.ode import integrate

    if not np.isfinite(batch.limit).any() or times[-1] <= FINE_END:
        return integrate(rhs, first, times, **options)
    early = np.append(times[times < FINE_END], FINE_END)
    start = integrate(rhs, first, early, max_step=KINK_STEP, **options)
    rest = integrate(rhs, start[-1], np.append(FINE_END, times[times > FINE_END]), **options)
    kept = rest if FINE_END in times else rest[1:]
    return np.vstack([start[:-1], kept])


def _rotating_rhs(batch: Batch, h: Array, gm: Array) -> Any:
    count = len(h)

    def rhs(_: float, flat: Array) -> Array:
        s = flat.reshape(-1, count)
        radius, radial_rate, rate = s[12], s[13], h / s[12] ** 2
        _, applied = batch.thrust(s[6:12])
        free = orbit.relative_acceleration(s[:3], s[3:6], radius, radial_rate, rate, gm)
        out = np.empty_like(s)
        out[:3], out[3:6] = s[3:6], np.array(free) + applied / batch.mass
        out[6:12] = batch.observer(s[6:12], applied, s[:3])
        out[12], out[13], out[14] = radial_rate, radius * rate**2 - gm / radius**2, rate
        out[15] = (s[:6] ** 2).sum(axis=0) + (applied**2).sum(axis=0)
        out[16] = np.abs(applied).sum(axis=0) / batch.mass
        return out.ravel()

    return rhs


def simulate(batch: Batch, times: Array, method: str = "DOP853", rtol: float = 1e-11) -> dict[str, Array]:
    """States of every run in the rotating frame, the target orbit integrated alongside.

    Returns
    -------
    dict of arrays: `state` and `estimate` (6, n_t, N), `command` and `applied` (3, n_t, N) [N],
    `cost` (n_t, N) = integral of x'x + u'u, `impulse` (n_t, N) = integral of the sum of |u_i| over the mass [m/s].

    Raises
    ------
    IntegrationError
        if the integrator stops before the last time.
    """
    count = batch.start.shape[1]
    h = np.array([o.angular_momentum for o in batch.orbits])
    gm = np.array([o.gm for o in batch.orbits])
    radial = np.array([o.radial_state(a) for o, a in zip(batch.orbits, batch.anomaly, strict=True)])
    zero = np.zeros((2, count))
    first = np.vstack([batch.start, batch.estimate, radial[:, :2].T, batch.anomaly[None], zero])
    lengths = np.array([1e-8] * 3 + [1e-11] * 3)
    atol = np.concatenate([lengths, lengths, [1e-6, 1e-9, 1e-13, 1e-3, 1e-9]])
    rhs = _rotating_rhs(batch, h, gm)
    found = _integrate(batch, rhs, first.ravel(), times, method=method, rtol=rtol, atol=np.repeat(atol, count))
    full = found.reshape(-1, 17, count).transpose(1, 0, 2)
    command, applied = batch.thrust(full[6:12])
    return {
        "state": full[:6], "estimate": full[6:12], "command": command, "applied": applied,
        "cost": full[15], "impulse": full[16],
    }  # fmt: skip


def simulate_inertial(batch: Batch, times: Array, rtol: float = 1e-13) -> Array:
    """State (6, n_t, N) in the rotating frame from two bodies in an inertial frame, the frame change in the loop.

    Target and chaser are integrated as separate bodies; nothing of the relative equations is used.
    """
    count = len(batch.orbits)
    gm = np.array([o.gm for o in batch.orbits])

    def rhs(_: float, flat: Array) -> Array:
        s = flat.reshape(18, count)
        frame = _frame(s[:3], s[3:6])
        offset = np.einsum("jin,jn->in", frame, s[6:9] - s[:3])
        _, applied = batch.thrust(s[12:])
        pull = [-gm * r / (r**2).sum(axis=0) ** 1.5 for r in (s[:3], s[6:9])]
        push = np.einsum("ijn,jn->in", frame, applied) / batch.mass
        return np.concatenate(
            [s[3:6], pull[0], s[9:12], pull[1] + push, batch.observer(s[12:], applied, offset)]
        ).ravel()

    bodies = []
    for k, target in enumerate(batch.orbits):
        angle = float(batch.anomaly[k])
        bodies.append(
            np.concatenate([*target.inertial_state(angle), *orbit.to_inertial(target, angle, batch.start[:, k])])
        )
    first = np.vstack([np.array(bodies).T, batch.estimate])
    # Rounding of 7e6 m leaves 1e-9 m of noise in the offset; a tighter estimate would only chase that noise.
    atol = np.array([1e-7] * 3 + [1e-10] * 3 + [1e-7] * 3 + [1e-10] * 3 + [1e-7] * 3 + [1e-8] * 3)
    found = _integrate(batch, rhs, first.ravel(), times, rtol=rtol, atol=np.repeat(atol, count))
    return _relative(found.reshape(-1, 18, count).transpose(1, 0, 2).reshape(18, -1)).reshape(6, -1, count)


def _frame(position: Array, velocity: Array) -> Array:
    """Axes of the rotating frame (3, 3, N) as columns, from the target's inertial position and velocity (3, N)."""
    x = position / np.sqrt((position**2).sum(axis=0))
    momentum = np.cross(position, velocity, axis=0)
    z = momentum / np.sqrt((momentum**2).sum(axis=0))
    return np.stack([x, np.cross(z, x, axis=0), z], axis=1)


def _relative(s: Array) -> Array:
    """Relative state (6, N) in the rotating frame of two bodies (18, N)."""
    frame = _frame(s[:3], s[3:6])
    spin = np.cross(s[:3], s[3:6], axis=0) / (s[:3] ** 2).sum(axis=0)
    offset = s[6:9] - s[:3]
    drift = s[9:12] - s[3:6] - np.cross(spin, offset, axis=0)
    return np.concatenate([np.einsum("jin,jn->in", frame, v) for v in (offset, drift)])
