"""Loops with a sampled state feedback held between the samples: x' = A x + G x(t_k) + E d on [t_k, t_{k+1}).

`G` is B K. Everything rests on one matrix exponential per interval, so the discretisation is exact: numpy arrays give
floats, object arrays of rationals or balls (with a rational `h`) give enclosures that hold for every matrix of the box.

Source: T. Chen, B. Francis, Optimal Sampled-Data Control Systems (1995), ch. 3 and 10; C. F. Van Loan, IEEE Trans.
Automatic Control 23 (1978) for the integrals.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat, fmpq

from recontrol.exact.ball import to_ball
from recontrol.exact.rational import from_float, zeros


class SampledError(ValueError):
    """Matrices that do not fit, or a search whose ends do not bracket what is looked for."""


def exponential(F: np.ndarray, h: Any) -> np.ndarray:
    """exp(F h) (n, n): float for a float matrix, enclosure for a rational or ball matrix and rational `h`."""
    if F.dtype != object:
        from scipy.linalg import expm

        return expm(F * h)
    flint = arb_mat(to_ball(F * h).tolist()).exp()
    out = np.empty(F.shape, dtype=object)
    out[...] = flint.tolist()
    return out


def _zeros(like: np.ndarray, m: int, n: int) -> np.ndarray:
    return zeros(m, n) if like.dtype == object else np.zeros((m, n))


def _held(A: np.ndarray, G: np.ndarray) -> np.ndarray:
    """Generator [[A, G], [0, 0]] of the pair (state, held vector)."""
    if A.ndim != 2 or A.shape[0] != A.shape[1] or G.ndim != 2 or G.shape[0] != A.shape[0]:
        raise SampledError(f"A and G: expected shapes (n, n) and (n, m), found {A.shape} and {G.shape}")
    n, m = G.shape
    return np.vstack([np.hstack([A, G]), _zeros(A, m, n + m)])


def zero_order_hold(A: np.ndarray, B: np.ndarray, h: Any) -> tuple[np.ndarray, np.ndarray]:
    """exp(A h) (n, n) and the integral of exp(A s) B over [0, h] (n, m)."""
    n = A.shape[0]
    both = exponential(_held(A, B), h)
    return both[:n, :n], both[:n, n:]


def integral_action(A: np.ndarray, B: np.ndarray, C: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """State, input and exogenous matrices of the plant with e' = C x - y_r appended.

    A (n, n), B (n, m), C (p, n) give (n + p, n + p), (n + p, m), and (n + p, m + p) for the input [d; y_r] where the
    disturbance d enters like the control.
    """
    (n, m), p = B.shape, C.shape[0]
    one = -np.eye(p) if A.dtype != object else -np.array([[fmpq(int(i == j)) for j in range(p)] for i in range(p)])
    state = np.vstack([np.hstack([A, _zeros(A, n, p)]), np.hstack([C, _zeros(A, p, p)])])
    control = np.vstack([B, _zeros(A, p, m)])
    return state, control, np.hstack([control, np.vstack([_zeros(A, n, p), one])])


def monodromy(A: np.ndarray, G: np.ndarray, h: Any) -> np.ndarray:
    """Map (n, n) from x(t_k) to x(t_k + h): exp(A h) plus the integral of exp(A s) G."""
    free, forced = zero_order_hold(A, G, h)
    return free + forced


def transition(A: np.ndarray, G: np.ndarray, intervals: Iterable[Any]) -> np.ndarray:
    """Map (n, n) over a sequence of sampling intervals, the first one first."""
    total: np.ndarray | None = None
    for h in intervals:
        step = monodromy(A, G, h)
        total = step if total is None else step @ total
    if total is None:
        raise SampledError("expected at least one sampling interval, found none")
    return total


def spectral_radius(M: np.ndarray) -> Any:
    """Largest modulus of an eigenvalue: float, or for rational and ball matrices an arb that encloses it.

    Raises SampledError if the enclosure fails (balls too wide for the cluster of eigenvalues).
    """
    if M.dtype != object:
        return float(np.max(np.abs(np.linalg.eigvals(M))))
    try:
        values = acb_mat([[acb(x) for x in row] for row in to_ball(M).tolist()]).eig(multiple=True)
    except ValueError as error:
        raise SampledError(f"no enclosure of the eigenvalues: {error}") from error
    return _ball_max([abs(value) for value in values])


def _ball_max(balls: list[arb]) -> arb:
    low = max(float(b.lower()) for b in balls)
    out = None
    for b in balls:
        if float(b.upper()) >= low:
            out = b if out is None else out.max(b)
    assert out is not None
    return out


def decay_rate(A: np.ndarray, G: np.ndarray, h: Any) -> Any:
    """Exact exponential rate -ln(radius of the monodromy) / h [1/time] of periodic sampling; negative if unstable."""
    radius = spectral_radius(monodromy(A, G, h))
    return -np.log(radius) / h if isinstance(radius, float) else -radius.log() / h


def contracts(M: np.ndarray, factor: Any, decimals: int = 12) -> bool:
    """Proof that the spectral radius of every matrix of the box `M` is below the rational or ball `factor`.

    A Lyapunov matrix X of the midpoint, rounded to rationals, is checked in balls: X > 0, factor^2 X - M' X M > 0.
    False means "not proven".
    """
    from scipy.linalg import solve_discrete_lyapunov

    from recontrol.exact.ball import midpoint
    from recontrol.exact.linalg import is_positive_definite
    from recontrol.exact.rational import rounded, symmetric_part

    scaled = midpoint(M) / float(to_ball(factor).mid())
    if spectral_radius(scaled) >= 1:
        return False
    X_float = solve_discrete_lyapunov(scaled.T, np.eye(len(scaled)))
    X = symmetric_part(rounded(X_float, decimals))
    decrease = factor * factor * X - M.T @ X @ M
    return is_positive_definite(X) and is_positive_definite((decrease + decrease.T) * fmpq(1, 2))


@dataclass(frozen=True)
class Bracket:
    """A sign change between two exact points; `proven` says whether balls confirm both sides."""

    low: fmpq
    high: fmpq
    proven: bool

    @property
    def middle(self) -> float:
        return float((self.low + self.high).p) / float((self.low + self.high).q) / 2


def largest_period(
    A: np.ndarray, G: np.ndarray, alpha: Any = 0, *, start: float, stop: float, width: float, grid: int = 200
) -> Bracket:
    """Bracket of the least period at which the exact decay rate of the rational loop falls to `alpha`.

    The crossing is found in floats on a grid of [start, stop], refined to `width`, and both ends are then decided in
    balls: rate > alpha at `low`, rate < alpha at `high`. Raises SampledError if the grid shows no crossing.
    """
    from recontrol.exact.rational import to_float

    A_float, G_float, target = to_float(A), to_float(G), to_float(alpha)

    def excess(h: float) -> float:
        return decay_rate(A_float, G_float, h) - target

    points = np.linspace(start, stop, grid)
    bad = next((k for k, h in enumerate(points) if excess(h) <= 0), None)
    if not bad:
        raise SampledError(f"no loss of the rate {target} between periods {start} and {stop}")
    low, high = float(points[bad - 1]), float(points[bad])
    while high - low > width:
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    ends = from_float(low), from_float(high)
    above, below = (decay_rate(A, G, h) - alpha for h in ends)
    return Bracket(*ends, proven=bool(above > 0 and below < 0))


def interval_cost(F: np.ndarray, Q: np.ndarray, h: Any) -> np.ndarray:
    """Integral over [0, h] of exp(F's) Q exp(F s) (n, n), symmetric `Q`; Van Loan's block exponential."""
    n = F.shape[0]
    both = exponential(np.vstack([np.hstack([-F.T, Q]), np.hstack([_zeros(F, n, n), F])]), h)
    return both[n:, n:].T @ both[:n, n:]


def held_cost(A: np.ndarray, G: np.ndarray, C: np.ndarray, h: Any) -> np.ndarray:
    """W (n, n) with x_k' W x_k = integral of |C x|^2 over one interval that starts at x_k with x_k held."""
    n = A.shape[0]
    Q = np.vstack([np.hstack([C.T @ C, _zeros(A, n, n)]), _zeros(A, n, 2 * n)])
    half = interval_cost(_held(A, G), Q, h)
    return half[:n, :n] + half[:n, n:] + half[n:, :n] + half[n:, n:]


@dataclass(frozen=True)
class Lifted:
    """One sampling interval as a discrete system: input and output piecewise constant on equal parts of it."""

    M: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray

    def gain(self, angle: float) -> float:
        """Largest singular value at exp(i angle)."""
        resolvent = np.linalg.solve(np.exp(1j * angle) * np.eye(len(self.M)) - self.M, self.B)
        return float(np.linalg.norm(self.C @ resolvent + self.D, 2))


def lifted(A: np.ndarray, G: np.ndarray, E: np.ndarray, C: np.ndarray, h: float, parts: int) -> Lifted:
    """Lift x' = A x + G x(t_k) + E d, z = C x over one interval of length `h` cut into `parts`.

    The input is constant on each part; the output of a part is the mean of its end values.
    """
    n, q = E.shape
    free, forced = zero_order_hold(A, np.hstack([G, E]), h / parts)
    held, driven = forced[:, :n], forced[:, n:]
    state, inputs = np.eye(n), np.zeros((n, parts * q))
    rows_x, rows_d = [], []
    for j in range(parts):
        next_state, next_inputs = free @ state + held, free @ inputs
        next_inputs[:, j * q : (j + 1) * q] += driven
        rows_x.append(C @ (state + next_state) / 2)
        rows_d.append(C @ (inputs + next_inputs) / 2)
        state, inputs = next_state, next_inputs
    return Lifted(state, inputs, np.vstack(rows_x), np.vstack(rows_d))


def sampled_gain(system: Lifted, grid: int = 60, rounds: int = 30) -> tuple[float, float]:
    """Largest gain over frequency and the angle [rad per interval] where it occurs (zero included).

    Logarithmic grid, then golden-section search beside the best point. Equal weights of the parts on both sides make
    this the L2 gain for such inputs. Raises SampledError for an unstable loop.
    """
    if spectral_radius(system.M) >= 1:
        raise SampledError("the loop is unstable: its gain is infinite")
    angles = np.concatenate([[0.0], np.geomspace(1e-4, np.pi, grid)])
    values = [system.gain(a) for a in angles]
    best = int(np.argmax(values))
    low, high = angles[max(best - 1, 0)], angles[min(best + 1, len(angles) - 1)]
    golden = (np.sqrt(5) - 1) / 2
    for _ in range(rounds):
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if system.gain(a) > system.gain(b) else (a, high)
    middle = (low + high) / 2
    candidates = [(values[best], float(angles[best])), (system.gain(middle), float(middle))]
    return max(candidates)
