r"""System norms: floats for plots and search, enclosures for statements.

Object arrays of rationals or balls give rigorous results that hold for every real matrix inside the balls; float arrays
give floats. Stability is decided first: a norm of an unstable system is an error, never a number.

* H2: ``||C (sI - A)^{-1} B||_2^2 = Tr(C X C')`` with ``A X + X A' + B B' = 0``, enclosed in balls.
* H-infinity: the upper bound is a bounded-real certificate P that is verified by L D L' in balls, the lower bound an
  evaluation of the gain at one frequency along one direction (Boyd, El Ghaoui, Feron, Balakrishnan, LMIs in System and
  Control Theory, 1994, section 2.7.3).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, fmpq

from recontrol.exact.ball import exact_midpoint, midpoint, precision, to_ball
from recontrol.exact.linalg import SingularError, inverse, is_positive_definite, lyapunov
from recontrol.exact.rational import from_float, identity
from recontrol.systems.riccati import NoSolutionError, minimal_solution
from recontrol.systems.stability import UndecidedError, require_hurwitz


@dataclass(frozen=True)
class HinfNorm:
    """Enclosure of an H-infinity norm.

    ``lower`` [ball, its lower end proven] is the gain at ``frequency`` [rad/s] (None: at infinity); ``upper`` (fmpq) is
    proven by ``certificate``, the matrix P (n, n) of the bounded-real inequality.
    """

    lower: arb
    upper: fmpq
    frequency: float | None
    certificate: np.ndarray

    @property
    def value(self) -> arb:
        """Ball from the lower to the upper bound."""
        return arb(self.lower.lower()).union(arb(self.upper))


def h2_norm(A: np.ndarray, B: np.ndarray, C: np.ndarray, *, bits: int = 128) -> Any:
    """H2 norm of ``C (sI - A)^{-1} B``: float for float arrays, else a ball that holds for every matrix of the box.

    Parameters: ``A`` (n, n), ``B`` (n, m), ``C`` (p, n). Raises UnstableError, UndecidedError.
    """
    require_hurwitz(A, bits)
    if A.dtype != object:
        from scipy.linalg import solve_continuous_lyapunov

        X = solve_continuous_lyapunov(A, -B @ B.T)
        return float(np.sqrt(np.trace(C @ X @ C.T)))
    with precision(bits):
        A, B, C = to_ball(A), to_ball(B), to_ball(C)
        try:
            X = lyapunov(A, B @ B.T)
        except SingularError as error:
            raise UndecidedError("the Lyapunov equation cannot be enclosed over the box") from error
        return np.trace(C @ X @ C.T).sqrt()


def gain(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, frequency: float) -> float:
    """Largest singular value of ``C (jwI - A)^{-1} B + D`` (float arrays) at one frequency [rad/s]."""
    response = C @ np.linalg.solve(1j * frequency * np.eye(len(A)) - A, B) + D
    return float(np.linalg.norm(response, 2))


def gain_lower_bound(
    A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, frequency: fmpq | None, *, bits: int = 128
) -> arb:
    """Ball whose lower end is below the largest singular value at ``frequency`` (None: at infinity), all of the box.

    The gain along one input direction, the right singular vector of the midpoint, is enclosed.
    """
    with precision(bits):
        response = _response(A, B, C, D, frequency)
        values = np.array([[complex(response[i, j]) for j in range(response.ncols())] for i in range(response.nrows())])
        direction = np.linalg.svd(values)[2][0].conj()
        v = acb_mat([[acb(float(z.real), float(z.imag))] for z in direction])
        refined = _power_step(response, v)
        v = refined if _square(refined) > 0 else v
        image = response * v
        ratio = _square(image) / _square(v)
        return ratio.sqrt() if ratio > 0 else arb(0).union(arb(ratio.upper()).sqrt())


def _power_step(response: acb_mat, v: acb_mat) -> acb_mat:
    """Two steps of the power method at working precision: a better direction than doubles can hold."""
    adjoint = response.conjugate().transpose()
    for _ in range(2):
        v = adjoint * (response * v)
        v = acb_mat([[acb(v[i, 0].real.mid(), v[i, 0].imag.mid())] for i in range(v.nrows())])
    return v


def _square(v: acb_mat) -> arb:
    return sum((v[i, 0].real ** 2 + v[i, 0].imag ** 2 for i in range(v.nrows())), arb(0))


def _response(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, frequency: fmpq | None) -> acb_mat:
    feedthrough = acb_mat(to_ball(D).tolist())
    if frequency is None:
        return feedthrough
    jw = [[acb(0, arb(frequency)) if i == j else acb(0) for j in range(len(A))] for i in range(len(A))]
    resolvent = (acb_mat(jw) - acb_mat(to_ball(A).tolist())).solve(acb_mat(to_ball(B).tolist()))
    return acb_mat(to_ball(C).tolist()) * resolvent + feedthrough


def peak_frequency(
    A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, *, points: int = 400, bits: int = 128
) -> fmpq | None:
    """Frequency [rad/s], zero included, where the gain is (nearly) largest, None for infinity; a search, not a proof.

    A logarithmic sweep five decades either side of the poles, then golden sections at working precision around the best
    point, since the peak may exceed the gain at infinity by less than doubles resolve.
    """
    poles = np.abs(np.linalg.eigvals(midpoint(A)))
    grid = np.geomspace(1e-3 * poles.min(), 1e6 * poles.max(), points)

    a, b, c, d = (exact_midpoint(M) for M in (A, B, C, D))

    def value(log_w: float) -> arb:
        return gain_lower_bound(a, b, c, d, from_float(float(np.exp(log_w))), bits=bits).mid()

    logs = [float(x) for x in np.log(grid)]
    best = max(range(points), key=lambda i: value(logs[i]))
    low, high = logs[max(best - 1, 0)], logs[min(best + 1, points - 1)]
    ratio = (np.sqrt(5) - 1) / 2
    for _ in range(30):
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, right) if value(left) > value(right) else (left, high)
    candidates: list[fmpq | None] = [fmpq(0), from_float(float(np.exp((low + high) / 2))), None]
    gains = [gain_lower_bound(a, b, c, d, w, bits=bits).mid() for w in candidates]
    return candidates[max(range(3), key=lambda i: gains[i])]


def bounded_real(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, P: np.ndarray, gamma: Any) -> np.ndarray:
    """The bounded-real matrix ``[A'P + PA + C'C, PB + C'D; *, D'D - gamma^2 I]``, (n + m, n + m).

    Negative definite with P > 0 (or A Hurwitz) exactly if the H-infinity norm is below ``gamma``.
    """
    product = A.T @ P
    top = product + product.T + C.T @ C
    side = P @ B + C.T @ D
    corner = D.T @ D - identity(B.shape[1]) * gamma**2
    full = np.vstack([np.hstack([top, side]), np.hstack([side.T, corner])])
    return (full + full.T) * fmpq(1, 2)


def hinf_certificate(
    A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, gamma: fmpq, *, bits: int = 160
) -> np.ndarray | None:
    """P (n, n), exact, that proves ``||C (sI - A)^{-1} B + D||_inf < gamma`` for every matrix of the box, or None.

    ``A`` must be Hurwitz. P is the minimal solution of the Riccati equation with a slightly enlarged constant term.
    """
    with precision(bits):
        a, b, c, d = (to_ball(exact_midpoint(M)) for M in (A, B, C, D))
        corner = identity(b.shape[1]) * gamma**2 - d.T @ d
        if not is_positive_definite(to_ball(corner)):
            return None
        try:
            weight = inverse(to_ball(corner))
            closed, S = a + b @ weight @ d.T @ c, b @ weight @ b.T
            Q = c.T @ c + c.T @ d @ weight @ d.T @ c
            size = max(abs(float(x)) for x in Q.flat) or 1.0
            for share in (0.6, 0.45, 0.3, 0.2, 0.12, 0.06, 0.03):
                margin = from_float(size * 2.0 ** (-share * bits))
                P = _try_solution(closed, Q + identity(len(a)) * margin, S, bits)
                if P is None:
                    continue
                matrix = bounded_real(to_ball(A), to_ball(B), to_ball(C), to_ball(D), P, gamma)
                if is_positive_definite(-matrix):
                    return P
        except SingularError:
            return None
    return None


def _try_solution(A: np.ndarray, Q: np.ndarray, S: np.ndarray, bits: int) -> np.ndarray | None:
    try:
        return minimal_solution(A, Q, S, bits=bits)
    except NoSolutionError:
        return None


def hinf_norm(
    A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, *, rtol: float = 1e-6, bits: int = 160
) -> HinfNorm:
    """Proven enclosure of the H-infinity norm of ``C (sI - A)^{-1} B + D``.

    Parameters: exact or ball object arrays ``A`` (n, n), ``B`` (n, m), ``C`` (p, n), ``D`` (p, m). ``rtol`` is the
    relative width that is tried first; it grows fourfold until a certificate is found (never beyond 10 %).
    Raises UnstableError, UndecidedError.
    """
    require_hurwitz(A, bits)
    frequency = peak_frequency(A, B, C, D, bits=bits)
    lower = gain_lower_bound(A, B, C, D, frequency, bits=bits)
    width = rtol
    while width <= 0.1:
        with precision(bits):
            gamma = exact_midpoint(lower) * (1 + from_float(width))
        certificate = hinf_certificate(A, B, C, D, gamma, bits=bits)
        if certificate is not None:
            where = None if frequency is None else int(frequency.p) / int(frequency.q)
            return HinfNorm(lower, gamma, where, certificate)
        width *= 4
    raise UndecidedError("no bounded-real certificate within 10 % of the largest gain that was found")


def hinf_norm_float(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, *, rtol: float = 1e-9) -> float:
    """H-infinity norm of float arrays by the two-step Hamiltonian method; an estimate from below, good to ``rtol``.

    The start is a wide sweep: a peak that exceeds the gain at infinity by little sits decades above the poles, where
    the eigenvalues of the Hamiltonian matrix no longer show it.

    Source: Bruinsma and Steinbuch, Systems & Control Letters 14 (1990) 287-293. Raises UnstableError.
    """
    require_hurwitz(A)
    poles = np.abs(np.linalg.eigvals(A))
    level = max(gain(A, B, C, D, w) for w in (0.0, *np.geomspace(1e-3 * poles.min(), 1e6 * poles.max(), 200)))
    level = max(level, float(np.linalg.norm(D, 2)), 1e-300)
    for _ in range(60):
        gamma = level * (1 + 2 * rtol)
        crossings = _imaginary_crossings(A, B, C, D, gamma)
        if len(crossings) < 2:
            return level * (1 + rtol)
        middles = np.sqrt(crossings[:-1] * crossings[1:])
        level = max(gamma, *(gain(A, B, C, D, w) for w in middles))
    return level


def _imaginary_crossings(A: np.ndarray, B: np.ndarray, C: np.ndarray, D: np.ndarray, gamma: float) -> np.ndarray:
    R = gamma**2 * np.eye(B.shape[1]) - D.T @ D
    closed = A + B @ np.linalg.solve(R, D.T @ C)
    Q = C.T @ (np.eye(len(C)) + D @ np.linalg.solve(R, D.T)) @ C
    hamiltonian: Any = np.block([[closed, B @ np.linalg.solve(R, B.T)], [-Q, -closed.T]])
    values = np.linalg.eigvals(hamiltonian)
    on_axis = values[np.abs(values.real) < 1e-8 * np.maximum(np.abs(values), 1e-300)]
    return np.unique(on_axis.imag[on_axis.imag > 0])
