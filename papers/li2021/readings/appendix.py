"""Appendix II, (19) and (20): torque ellipsoid, initial state, invariance, exactly at random rational points."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.proofs import provided, verified
from recontrol.claims.values import Identity, Statement
from recontrol.exact.rational import identity, zeros
from recontrol.systems.generic import inverse

from .. import conditions as c
from ..plant import initial_state
from ..problems import problem_data
from .support import pivots, random_rational, random_symmetric, schur

Array = np.ndarray


def eq19(data: Any) -> Identity:
    """(19) from (B.2): the congruence with Gamma1, then Lemma 1 with mu = eps3, by its Schur complement."""
    rng = np.random.default_rng(9)
    t = problem_data(data, "plant")
    S, N, C_f = random_symmetric(rng, 6), random_symmetric(rng, 6), random_rational(rng, 3, 6)
    names = ("theta", "u2", "eps3", "delta_m")
    printed = c.eq19(S, N, C_f=C_f, **{k: t[k] for k in names})
    one = identity(6)
    Gamma1 = np.block([[one, one], [one, zeros(6)]])
    K = np.hstack([zeros(3, 6), C_f])
    B2 = np.block([[-identity(3) * t["u2"], -K], [-K.T, -c.lyapunov(S, N) / t["theta"]]])
    T = zeros(15)
    T[:3, :3], T[3:, 3:] = identity(3), Gamma1
    H, E = np.vstack([identity(3), zeros(12, 3)]), np.hstack([zeros(3, 3), C_f, zeros(3, 6)])
    e3 = t["eps3"]
    due = T.T @ B2 @ T + H @ H.T * (e3 * t["delta_m"] ** 2) + E.T @ E / e3
    return Identity(schur(printed, [15, 16, 17]), due)


def _start(data: Any) -> tuple[Array, Array, Array]:
    rng = np.random.default_rng(10)
    root = random_rational(rng, 6, 6)
    S = root @ root.T + identity(6)
    return S, -(S + identity(6)), initial_state(data)


def _quadratic(data: Any) -> tuple[list[Array], Array, Array]:
    """What (20) and (B.5) hold below theta, by Schur complement of all but their first row; xi0 and P beside it."""
    S, N, x0 = _start(data)
    theta, P, xi0 = data["theta"], c.lyapunov(S, N), np.vstack([x0, zeros(6, 1)])
    B5 = np.block([[identity(1) * -theta, -xi0.T], [-xi0, -P]])
    printed = c.eq20_printed(S, N, x0=x0, theta=theta)
    return [schur(M, list(range(1, len(M)))) + identity(1) * theta for M in (printed, B5)], xi0, P


def eq20_needed(data: Any) -> Identity:
    """What (20) and (B.5) hold below theta, against xi0' P xi0 <= theta, which the proof uses."""
    found, xi0, P = _quadratic(data)
    return Identity(found, [xi0.T @ P @ xi0] * len(found))


def eq20_inverse(data: Any) -> Identity:
    """P^-1 in the place of P: both (20) and (B.5) bound x0' S^-1 x0 = xi0' P^-1 xi0, exactly."""
    found, xi0, P = _quadratic(data)
    S, _, x0 = _start(data)
    return Identity([*found, x0.T @ inverse(S) @ x0], [xi0.T @ inverse(P) @ xi0] * (len(found) + 1))


WITNESS = "lemma-other-lambda"


def _witness(certificates: Any, data: Any) -> tuple[Array, dict[str, Any]]:
    """P of (12) from its certificate, and the printed loop."""
    from recontrol.lmi.certificate import decode

    point = certificates[WITNESS]["witness"]["point"]
    return c.lyapunov(decode(point["S"]), decode(point["N"])), problem_data(data, "loop-proposed")


def invariance_disturbed(data: Any, certificates: Any) -> Statement:
    """P of (12), xi = s B d~: dU/dt = s^2 d~'B'(A'P + PA)B d~ + 2 s d~'B'P B d~, whose second term decides for small s.

    The margin is relative to the size of that term, so that it does not depend on the certificate's choice of P.
    """
    P, t = _witness(certificates, data)
    b, A, s = t["B"][:, :1], t["A"], fmpq(1, 10**9)
    second = (b.T @ P @ b)[0, 0] * 2 * s
    rate = (b.T @ (A.T @ P + P @ A) @ b)[0, 0] * s * s + second
    return Statement({"-dU/dt, relative": provided(verified(certificates, WITNESS), -rate / abs(second))})


def invariance_undisturbed(data: Any, certificates: Any) -> Statement:
    """With d~ = 0 and the same P, U is positive and decreases everywhere: P > 0 and -(A'P + PA) > 0."""
    P, t = _witness(certificates, data)
    margins = pivots(P, "P") | pivots(-(t["A"].T @ P + P @ t["A"]), "-(A'P + PA)")
    proof = verified(certificates, WITNESS)
    return Statement({name: provided(proof, margin) for name, margin in margins.items()})
