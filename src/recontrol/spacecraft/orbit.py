"""Motion of a chaser relative to a target on a Kepler orbit.

Everything is written in the target's rotating frame: x along the radius (outward), z along the orbital angular
momentum, y completing the right-handed frame, so y points along the flight direction of a circular orbit. Units are
free but must be consistent; with metres and seconds `gm` is in m^3/s^2.

Sources: W. H. Clohessy, R. S. Wiltshire, J. Aerospace Sci. 27 (1960); R. G. Melton, J. Guidance 23 (2000);
K. Alfriend et al., Spacecraft Formation Flying (2010), ch. 4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[Any]


class OrbitError(ValueError):
    """An orbit or a relative state that the two-body formulas cannot take."""


@dataclass(frozen=True)
class KeplerOrbit:
    """An elliptic two-body orbit, perigee at time 0.

    Parameters
    ----------
    gm : gravitational parameter [length^3/time^2]
    perigee_radius : distance of the perigee from the centre [length]
    eccentricity : 0 <= e < 1

    Raises
    ------
    OrbitError
        if a parameter is out of range.
    """

    gm: float
    perigee_radius: float
    eccentricity: float

    def __post_init__(self) -> None:
        if not (self.gm > 0 and self.perigee_radius > 0):
            raise OrbitError(f"gm and perigee_radius must be positive, found {self.gm} and {self.perigee_radius}")
        if not 0 <= self.eccentricity < 1:
            raise OrbitError(f"an elliptic orbit needs 0 <= eccentricity < 1, found {self.eccentricity}")

    @property
    def semi_major_axis(self) -> float:
        return self.perigee_radius / (1 - self.eccentricity)

    @property
    def mean_motion(self) -> float:
        return float(np.sqrt(self.gm / self.semi_major_axis**3))

    @property
    def period(self) -> float:
        return 2 * np.pi / self.mean_motion

    @property
    def angular_momentum(self) -> float:
        """Specific angular momentum h = r^2 theta' [length^2/time]."""
        return float(np.sqrt(self.gm * self.perigee_radius * (1 + self.eccentricity)))

    def radial_state(self, true_anomaly: Any) -> tuple[Any, Any, Any]:
        """Radius, radial rate and angular rate at a true anomaly [rad]."""
        h, e = self.angular_momentum, self.eccentricity
        radius = h**2 / self.gm / (1 + e * np.cos(true_anomaly))
        return radius, self.gm / h * e * np.sin(true_anomaly), h / radius**2

    def true_anomaly(self, time: Any) -> Any:
        """True anomaly [rad] at times since perigee, on the same revolution as the mean anomaly.

        Kepler's equation by Newton's method from E = M + e sin M.
        """
        e = self.eccentricity
        mean = self.mean_motion * np.asarray(time, dtype=float)
        eccentric = mean + e * np.sin(mean)
        for _ in range(50):
            step = (eccentric - e * np.sin(eccentric) - mean) / (1 - e * np.cos(eccentric))
            eccentric = eccentric - step
            if np.all(np.abs(step) <= 4e-16 * (1 + np.abs(eccentric))):
                break
        beta = e / (1 + np.sqrt(1 - e**2))
        return eccentric + 2 * np.arctan2(beta * np.sin(eccentric), 1 - beta * np.cos(eccentric))

    def inertial_state(self, true_anomaly: float) -> tuple[Matrix, Matrix]:
        """Position and velocity (3,) in the perifocal frame (x to perigee, z along h)."""
        radius, radial_rate, angular_rate = self.radial_state(true_anomaly)
        frame = rotating_frame(true_anomaly)
        return frame @ [radius, 0.0, 0.0], frame @ [radial_rate, radius * angular_rate, 0.0]


def rotating_frame(angle: float) -> Matrix:
    """Rotation matrix (3, 3): columns are the axes of the target frame in the perifocal frame."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def to_inertial(orbit: KeplerOrbit, true_anomaly: float, relative: Matrix) -> tuple[Matrix, Matrix]:
    """Inertial position and velocity (3,) of the chaser from its relative state (6,) in the rotating frame."""
    position, velocity = orbit.inertial_state(true_anomaly)
    frame, rate = rotating_frame(true_anomaly), orbit.radial_state(true_anomaly)[2]
    spin = np.array([0.0, 0.0, rate])
    relative = np.asarray(relative, dtype=float)
    turned = relative[3:] + np.cross(spin, relative[:3])
    return position + frame @ relative[:3], velocity + frame @ turned


def to_rotating(orbit: KeplerOrbit, true_anomaly: float, position: Matrix, velocity: Matrix) -> Matrix:
    """Relative state (6,) in the rotating frame from the chaser's inertial position and velocity (3,)."""
    target_position, target_velocity = orbit.inertial_state(true_anomaly)
    frame, rate = rotating_frame(true_anomaly), orbit.radial_state(true_anomaly)[2]
    offset = frame.T @ (np.asarray(position) - target_position)
    drift = frame.T @ (np.asarray(velocity) - target_velocity) - np.cross([0.0, 0.0, rate], offset)
    return np.concatenate([offset, drift])


def propagate_kepler(gm: float, position: Matrix, velocity: Matrix, time: float) -> tuple[Matrix, Matrix]:
    """Inertial position and velocity (3,) after `time` on an elliptic orbit, by Kepler's equation.

    Lagrange's f and g functions in the change of eccentric anomaly; the oracle for the integrated equations.

    Raises
    ------
    OrbitError
        if the orbit is not elliptic.
    """
    position, velocity = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    radius = float(np.linalg.norm(position))
    axis = 1 / (2 / radius - velocity @ velocity / gm)
    if axis <= 0:
        raise OrbitError("the orbit is not elliptic: its energy is not negative")
    rate, sigma = np.sqrt(gm / axis**3), float(position @ velocity) / np.sqrt(gm * axis)
    near = 1 - radius / axis
    change = rate * time
    for _ in range(100):
        residual = change - near * np.sin(change) + sigma * (1 - np.cos(change)) - rate * time
        step = residual / (1 - near * np.cos(change) + sigma * np.sin(change))
        change -= step
        if abs(step) <= 4e-16 * (1 + abs(change)):
            break
    new_radius = axis * (1 - near * np.cos(change) + sigma * np.sin(change))
    f = 1 - axis / radius * (1 - np.cos(change))
    g = time - (change - np.sin(change)) / rate
    f_rate = -np.sqrt(gm * axis) / (radius * new_radius) * np.sin(change)
    g_rate = 1 - axis / new_radius * (1 - np.cos(change))
    return f * position + g * velocity, f_rate * position + g_rate * velocity


def relative_acceleration(
    position: Any, velocity: Any, radius: Any, radial_rate: Any, angular_rate: Any, gm: Any, norm_cubed: Any = None
) -> tuple[Any, Any, Any]:
    """Exact two-body acceleration (x'', y'', z'') of the free chaser in the target's rotating frame.

    x'' = w^2 x + w' y + 2 w y' - gm (r + x)/d^3 + gm/r^2,  y'' = w^2 y - w' x - 2 w x' - gm y/d^3,  z'' = -gm z/d^3
    with w = theta', w' = -2 r' w / r and d = |(r + x, y, z)|.

    Parameters
    ----------
    position, velocity : three components each; numbers, arrays of equal shape or symbols
    radius, radial_rate, angular_rate : of the target
    norm_cubed : d^3, where it is already known or symbolic
    """
    x, y, z = position
    vx, vy, _ = velocity
    slew = -2 * radial_rate * angular_rate / radius
    cube = ((radius + x) ** 2 + y**2 + z**2) ** 1.5 if norm_cubed is None else norm_cubed
    return (
        angular_rate**2 * x + slew * y + 2 * angular_rate * vy - gm * (radius + x) / cube + gm / radius**2,
        angular_rate**2 * y - slew * x - 2 * angular_rate * vx - gm * y / cube,
        -gm * z / cube,
    )


def _matrix(rows: list[list[Any]], kind: Any) -> Matrix:
    exact = not isinstance(kind, (float, int, np.floating))
    return np.array([[0 * kind + entry for entry in row] for row in rows], dtype=object if exact else float)


def clohessy_wiltshire(n: Any) -> Matrix:
    """State matrix (6, 6) of the relative motion about a circular orbit; state (x, y, z, x', y', z').

    `n` is the mean motion [rad/time] as a float, an exact rational, a ball or a symbol; the entries keep its type.
    """
    return _matrix(
        [
            [0, 0, 0, 1, 0, 0],
            [0, 0, 0, 0, 1, 0],
            [0, 0, 0, 0, 0, 1],
            [3 * n**2, 0, 0, 0, 2 * n, 0],
            [0, 0, 0, -2 * n, 0, 0],
            [0, 0, -(n**2), 0, 0, 0],
        ],
        n,
    )


def thrust_input(mass: Any) -> Matrix:
    """Input matrix (6, 3) of three thrusts along the axes of the rotating frame [1/mass]."""
    inverse = 1 / mass
    return _matrix([[0] * 3] * 3 + [[inverse if i == j else 0 for j in range(3)] for i in range(3)], mass)


def near_circular(n: Any, e: Any, cos_m: Any, sin_m: Any) -> Matrix:
    """First-order term (6, 6) in the eccentricity that is added to `clohessy_wiltshire(n)` (Melton 2000).

    Parameters
    ----------
    n, e : mean motion [rad/time] and eccentricity
    cos_m, sin_m : of the target's mean anomaly
    """
    return _matrix(
        [
            [0] * 6,
            [0] * 6,
            [0] * 6,
            [10 * e * n**2 * cos_m, -2 * e * n**2 * sin_m, 0, 0, 4 * e * n * cos_m, 0],
            [2 * e * n**2 * sin_m, e * n**2 * cos_m, 0, -4 * e * n * cos_m, 0, 0],
            [0, 0, -3 * e * n**2 * cos_m, 0, 0, 0],
        ],
        n,
    )


def linear_relative(orbit: KeplerOrbit, true_anomaly: float) -> Matrix:
    """Exact linearisation (6, 6) of the relative motion about an elliptic orbit (Tschauner-Hempel)."""
    radius, radial_rate, rate = orbit.radial_state(true_anomaly)
    slew, pull = -2 * radial_rate * rate / radius, orbit.gm / radius**3
    lower = [
        [rate**2 + 2 * pull, slew, 0, 0, 2 * rate, 0],
        [-slew, rate**2 - pull, 0, -2 * rate, 0, 0],
        [0, 0, -pull, 0, 0, 0],
    ]
    return np.vstack([np.hstack([np.zeros((3, 3)), np.eye(3)]), np.array(lower, dtype=float)])
