r"""Attitude of a spacecraft with flexible appendages on a circular orbit: modes, gravity gradient, Euler 3-2-1.

.. math::  J \dot w + F' \ddot\eta = -w \times J w + u + T_g, \qquad
           \ddot\eta + C_m \dot\eta + \Lambda \eta + F \dot w = 0

``F`` (n_m, 3) couples the modes to the body [kg^1/2 m], ``C_m = diag(2 zeta omega)``, ``Lambda = diag(omega^2)``.
Frames and angles are those of :mod:`recontrol.spacecraft.attitude`: LVLH turns at ``(0, -orbital_rate, 0)``, the angles
are (roll, pitch, yaw) of the 3-2-1 sequence.

The matrix functions work on float arrays and on exact rationals alike; the simulation classes carry runs as columns.

Source: Di Gennaro, Passive attitude control of flexible spacecraft from quaternion measurements, JOTA 116 (2003), and
Wie, Space Vehicle Dynamics and Control, section 6.10 (gravity gradient).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.systems.generic import diag, eye, inverse, zeros

Array = Any  # arrays of floats, or of rationals


def orbital_matrices(inertia: Array, orbital_rate: Any) -> tuple[Array, Array, Array]:
    """``(D, G, N)``, each (3, 3), of the small-angle model ``J q'' + D q' + G q + F' eta'' = u``.

    ``inertia`` (3,) [kg m^2], ``orbital_rate`` [rad/s]. ``N`` is the transport term of ``w' = q'' + N q'``, which
    drives the modes: ``eta'' + ... + F (q'' + N q') = 0``.
    """
    J = np.ravel(inertia)
    n = orbital_rate
    D, N = zeros(J, 3, 3), zeros(J, 3, 3)
    D[0, 2] = -n * (J[0] + J[2] - J[1])
    D[2, 0] = -D[0, 2]
    N[0, 2], N[2, 0] = -n, n
    G = diag(np.array([4 * (J[1] - J[2]), 3 * (J[0] - J[2]), J[1] - J[0]], dtype=J.dtype)) * (n * n)
    return D, G, N


def rigid_part(inertia: Array, coupling: Array, orbital_rate: Any) -> tuple[Array, Array, Array]:
    """``(A, B, M)`` of ``x' = A x + B (u + modal terms)``, ``x = [q; q']``, after elimination of ``eta''``.

    ``M = J - F'F`` (3, 3) is the mass left to the body; ``A`` (6, 6), ``B`` (6, 3).
    """
    D, G, N = orbital_matrices(inertia, orbital_rate)
    FF = coupling.T @ coupling
    M = diag(inertia) - FF
    Mi = inverse(M)
    zero, one = zeros(M, 3, 3), eye(M, 3)
    A = np.vstack([np.hstack([zero, one]), np.hstack([-Mi @ G, -Mi @ (D - FF @ N)])])
    return A, np.vstack([zero, Mi]), M


def linear_model(
    inertia: Array, coupling: Array, frequency: Array, damping: Array, orbital_rate: Any
) -> tuple[Array, Array]:
    """``(A, B)`` of the small-angle model with its modes, states ``[q; eta; q'; eta']``, input torque [N m].

    ``frequency`` (n_m,) [rad/s], ``damping`` (n_m,) [1].
    """
    D, G, N = orbital_matrices(inertia, orbital_rate)
    F, w, z = coupling, np.ravel(frequency), np.ravel(damping)
    m, k = len(w), 3 + len(w)
    mass = np.vstack([np.hstack([diag(inertia), F.T]), np.hstack([F, eye(F, m)])])
    stiff = np.vstack([np.hstack([G, zeros(F, 3, m)]), np.hstack([zeros(F, m, 3), diag(w * w)])])
    rates = np.vstack([np.hstack([D, zeros(F, 3, m)]), np.hstack([F @ N, diag(2 * z * w)])])
    Wi = inverse(mass)
    A = np.vstack([np.hstack([zeros(F, k, k), eye(F, k)]), np.hstack([-Wi @ stiff, -Wi @ rates])])
    return A, np.vstack([zeros(F, k, 3), Wi[:, :3]])


class FlexibleAttitude:
    """Nonlinear model of many runs at once, state ``[q; w; eta; eta']`` (6 + 2 n_m, runs), ``w`` the inertial rate.

    Parameters: ``inertia`` (3, runs) [kg m^2], ``coupling`` (n_m, 3), ``frequency`` (n_m, runs) [rad/s], ``damping``
    (n_m, runs), ``orbital_rate`` [rad/s].
    """

    def __init__(self, inertia: Array, coupling: Array, frequency: Array, damping: Array, orbital_rate: float) -> None:
        self.inertia, self.coupling, self.orbital_rate = inertia, coupling, orbital_rate
        self.modes = len(coupling)
        self.stiffness, self.friction = frequency**2, 2 * damping * frequency
        mass = np.stack([np.diag(column) for column in inertia.T]) - coupling.T @ coupling
        self.inverse_mass = np.moveaxis(np.linalg.inv(mass), 0, -1)

    def initial(self, angles: Array, angle_rates: Array) -> Array:
        """State (6 + 2 n_m, runs) with resting modes from angles (3, runs) and their time derivatives [rad/s]."""
        from recontrol.spacecraft.attitude import body_rate

        rate = np.stack(np.broadcast_arrays(*body_rate(angles, angle_rates, self.orbital_rate, np)))
        rest = np.zeros((2 * self.modes, angles.shape[1]))
        return np.concatenate([angles, rate, rest])

    def angle_rates(self, state: Array) -> Array:
        """Time derivatives of the angles (3, ...) [rad/s] of states (6 + 2 n_m, ...)."""
        from recontrol.spacecraft.attitude import angle_rates

        return np.stack(angle_rates(state[:3], state[3:6], self.orbital_rate, np))

    def derivative(self, state: Array, torque: Array) -> Array:
        """Time derivative of the states under body torques (3, runs) [N m]; gravity gradient is added inside."""
        m, n0 = self.modes, self.orbital_rate
        (sf, st, sp), (cf, ct, cp) = np.sin(state[:3]), np.cos(state[:3])
        w, eta, etad = state[3:6], state[6 : 6 + m], state[6 + m :]
        # Second and third column of the direction cosines, LVLH to body.
        sfst, cfst = sf * st, cf * st
        a3 = np.stack([-st, sf * ct, cf * ct])
        p = w[0] + n0 * (ct * sp)
        q = w[1] + n0 * (sfst * sp + cf * cp)
        r = w[2] + n0 * (cfst * sp - sf * cp)
        out = np.empty_like(state)
        yaw = (sf * q + cf * r) / ct
        out[0], out[1], out[2] = p + st * yaw, cf * q - sf * r, yaw
        spring = self.friction * etad + self.stiffness * eta
        load = torque + self.coupling.T @ spring + _gyroscopic(self.inertia, a3, w, 3 * n0 * n0)
        wd = (self.inverse_mass * load).sum(axis=1)
        out[3:6], out[6 : 6 + m] = wd, etad
        out[6 + m :] = -spring - self.coupling @ wd
        return out


def _gyroscopic(inertia: Array, a3: Array, w: Array, gradient: float) -> Array:
    """``gradient * a3 x J a3 - w x J w`` for principal inertias."""
    difference = inertia[[2, 0, 1]] - inertia[[1, 2, 0]]
    return difference * (gradient * a3[[1, 2, 0]] * a3[[2, 0, 1]] - w[[1, 2, 0]] * w[[2, 0, 1]])


class LinearFlexibleAttitude:
    """Small-angle counterpart of `FlexibleAttitude` with the same methods, state ``[q; q'; eta; eta']``."""

    def __init__(self, inertia: Array, coupling: Array, frequency: Array, damping: Array, orbital_rate: float) -> None:
        models = [
            linear_model(J, coupling, w, z, orbital_rate)
            for J, w, z in zip(inertia.T, frequency.T, damping.T, strict=True)
        ]
        self.modes = m = len(coupling)
        order = [*range(3), *range(3 + m, 6 + m), *range(3, 3 + m), *range(6 + m, 6 + 2 * m)]
        self._A = np.stack([A[np.ix_(order, order)] for A, _ in models])
        self._B = np.stack([B[order] for _, B in models])

    def initial(self, angles: Array, angle_rates: Array) -> Array:
        """State (6 + 2 n_m, runs) with resting modes."""
        return np.concatenate([angles, angle_rates, np.zeros((2 * self.modes, angles.shape[1]))])

    def angle_rates(self, state: Array) -> Array:
        """Time derivatives of the angles (3, ...) [rad/s]."""
        return state[3:6]

    def derivative(self, state: Array, torque: Array) -> Array:
        """Time derivative of the states under body torques (3, runs) [N m]."""
        return (self._A @ state.T[:, :, None] + self._B @ torque.T[:, :, None])[:, :, 0].T
