"""Sections II.B and III: lemmas, congruences and equivalences, by exact algebra at random rational points."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.values import Identity, Result, Statement
from recontrol.exact.rational import identity, zeros
from recontrol.lmi.affine import NotAffineError
from recontrol.lmi.conditions import condition
from recontrol.lmi.variables import full
from recontrol.systems.generic import inverse

from .. import conditions as c
from ..plant import controller, initial_state, loop, plant
from ..problems import GAINS, SN, build, problem_data
from .support import drift_limit, pivots, random_rational, random_symmetric, refuted

Array = np.ndarray
HALF = fmpq(1, 2)


def _schur(M: Array, rows: list[int]) -> Array:
    """Schur complement of the block ``rows`` in M."""
    rest = [i for i in range(len(M)) if i not in rows]
    corner = M[np.ix_(rows, rows)]
    return M[np.ix_(rest, rest)] - M[np.ix_(rest, rows)] @ inverse(corner) @ M[np.ix_(rows, rest)]


def lemma1_negative() -> Statement:
    """1 x 1, Y = H = E = 1, mu = -1: Y + H^2/mu + mu E^2 = -1 < 0, yet Y + 2 H F E = 3 at F = 1."""
    Y = H = E = fmpq(1)
    mu = fmpq(-1)
    premise = -(Y + H**2 / mu + mu * E**2)
    assert premise > 0
    return Statement({"-(Y + HFE + E'F'H') at F = 1": -(Y + 2 * H * E)})


def lemma1_positive() -> Identity:
    """With mu > 0: H^2/mu + mu E^2 - 2 H F E = (H - mu F E)^2 / mu for F^2 = 1, so the bound holds for every F."""
    import sympy as sp

    H, E = sp.symbols("H E", real=True)
    mu = sp.Symbol("mu", positive=True)
    gaps = [H**2 / mu + mu * E**2 - 2 * H * F * E for F in (1, -1)]
    return Identity(sp.Matrix(gaps), sp.Matrix([(H - mu * F * E) ** 2 / mu for F in (1, -1)]))


def lemma2() -> Identity:
    """Completed square, a = Theta/lambda, b = lambda Gamma: half (a + b)(a + b)' - ab' - ba' = half (a - b)(a - b)'."""
    rng = np.random.default_rng(2)
    left, right = [], []
    for scale in (fmpq(1, 3), fmpq(7, 2)):
        a, b = random_rational(rng, 4, 3) / scale, random_rational(rng, 4, 3) * scale
        left.append((a + b) @ (a + b).T * HALF - a @ b.T - b @ a.T)
        right.append((a - b) @ (a - b).T * HALF)
    return Identity(left, right)


def _random_loop(data: Any) -> dict[str, Any]:
    """A loop of the paper's structure with random A_f, B_f, C_f, a random P, and scalars; exact."""
    rng = np.random.default_rng(3)
    p = plant(data)
    gains = controller(data, "proposed")._replace(
        A=random_rational(rng, 6, 6), B=random_rational(rng, 6, 3), C=random_rational(rng, 3, 6)
    )
    return {**loop(p, gains), "a": data["disk_a"], "b": data["disk_b"], "P": random_symmetric(rng, 12)}


def _performance(m: dict[str, Any], tau: fmpq, gamma2: fmpq) -> Array:
    """Phi_1 of (A.4), 18 rows."""
    A, B, C, W, P = (m[k] for k in ("A", "B", "C", "W", "P"))
    WA, WB = W @ A, W @ B
    top = A.T @ P + P @ A + WA.T @ WA * tau + C.T @ C
    PB = P @ B + WA.T @ WB * tau
    middle = WB.T @ WB * tau
    one = identity(3)
    return np.block([[top, -PB, PB], [-PB.T, middle - one * tau, -middle], [PB.T, -middle, middle - one * gamma2]])


TAU, GAMMA2 = fmpq(9, 4), fmpq(25)


def eqA5(data: Any) -> Identity:
    """Schur complement of blocks 4 to 6 of (12) against (A.5)."""
    m = _random_loop(data)
    P, a, b = m["P"], m["a"], m["b"]
    whole = c.eq12(P, TAU, GAMMA2, A=m["A"], B=m["B"], C=m["C"], W=m["W"], a=a, b=b)
    due = _performance(m, TAU, GAMMA2)
    due[:12, :12] += m["A"].T @ P @ m["A"] / a + P * ((a * a - b * b) / a)
    return Identity(_schur(whole, list(range(18, 36))), due)


def lemma3(data: Any) -> Identity:
    """(A.5) is the disk inequality (A.1) plus terms >= 0, and Phi_1 plus terms >= 0 for P > 0: (12) gives both."""
    m = _random_loop(data)
    P, a, b, A, C, W = m["P"], m["a"], m["b"], m["A"], m["C"], m["W"]
    whole = c.eq12(P, TAU, GAMMA2, A=A, B=m["B"], C=C, W=W, a=a, b=b)
    reduced = _schur(whole, list(range(18, 36)))
    shifted, WA = A + identity(12) * a, W @ A
    disk = shifted.T @ P @ shifted / a - P * (b * b / a)
    performance = reduced - _performance(m, TAU, GAMMA2)
    due = zeros(18, 18)
    due[:12, :12] = A.T @ P @ A / a + P * ((a * a - b * b) / a)
    return Identity([reduced[:12, :12], performance], [disk + WA.T @ WA * TAU + C.T @ C, due])


def eqA3_printed() -> Statement:
    """As printed, a product xi A~' of a column with a square matrix: 12 x 1 times 12 x 12."""
    return Statement({"columns of xi minus rows of A~', minus one": fmpq(-abs(1 - 12))})


def eqA3_transposed(data: Any) -> Identity:
    """With xi' and M a row, the derivative of V + ... equals M Phi_1 M' of (A.4), exactly at random points."""
    m = _random_loop(data)
    rng = np.random.default_rng(4)
    xi, e, d = (random_rational(rng, k, 1) for k in (12, 3, 3))
    A, B, C, W, P = (m[k] for k in ("A", "B", "C", "W", "P"))
    rate = A @ xi + B @ d - B @ e
    due = rate.T @ P @ xi + xi.T @ P @ rate + (C @ xi).T @ (C @ xi) - (e.T @ e) * TAU - (d.T @ d) * GAMMA2
    due = due + (W @ rate).T @ (W @ rate) * TAU
    row = np.vstack([xi, e, d])
    return Identity(row.T @ _performance(m, TAU, GAMMA2) @ row, due)


def _theorem_point(data: Any) -> dict[str, Any]:
    rng = np.random.default_rng(5)
    table = problem_data(data, "loop-proposed")
    table |= {"S": random_symmetric(rng, 6), "N": random_symmetric(rng, 6)}
    return table


def thm1_P(data: Any) -> Identity:
    """Gamma1' P Gamma1 = [S S; S Y]; diag(Gamma1, I, I, I, Gamma1) turns (12) into (13) less its uncertain rows."""
    t = _theorem_point(data)
    S, N, one = t["S"], t["N"], identity(6)
    Gamma1 = np.block([[one, one], [one, zeros(6)]])
    P = c.lyapunov(S, N)
    whole = c.eq12_structured(S, N, TAU, GAMMA2, **{k: t[k] for k in ("A", "B", "C", "W", "a", "b")})
    reduced = _schur(whole, [21, 22, 23])
    T = zeros(33)
    T[:12, :12] = T[21:, 21:] = Gamma1
    T[12:21, 12:21] = identity(9)
    p = problem_data(data, "proposed")
    names = ("C_f", "A", "B", "C", "L", "K", "W", "a", "b", "delta_m")
    one12 = identity(12)
    full13 = c.eq13(S, N, N @ t["A_f"], N @ t["B_f"], TAU, one12, one12, GAMMA2, **{k: p[k] for k in names})
    return Identity([Gamma1.T @ P @ Gamma1, T.T @ reduced @ T], [np.block([[S, S], [S, S - N]]), full13[:33, :33]])


def thm1_P_definite() -> Identity:
    """[S S; S Y] = [I; I] S [I I] + diag(0, -N) with Y = S - N: positive definite if and only if S > 0 and N < 0."""
    rng = np.random.default_rng(6)
    S, N = random_symmetric(rng, 6), random_symmetric(rng, 6)
    both = np.vstack([identity(6), identity(6)])
    due = both @ S @ both.T
    due[6:, 6:] -= N
    return Identity(np.block([[S, S], [S, S - N]]), due)


def thm1_equiv(certificates: Any) -> Result:
    """Between two drift bounds diagonal multipliers give (13) a point, so (16) holds for all F; two scalars none."""
    limits = {
        "(13), diagonal multipliers: a point up to delta_m": drift_limit(certificates, "drift-diag-below"),
        "(13), two scalars: none from delta_m": drift_limit(certificates, "drift-one-above"),
    }
    return refuted(certificates, "drift-diag-below", "drift-one-above", evidence=limits)


def _mixed(data: Any, corner: tuple[slice, slice]) -> Array:
    """Mixed second difference of (13) in C_f and (S, N) over one block: zero where it is affine in both together."""
    rng = np.random.default_rng(7)
    p = problem_data(data, "plant")
    C1, S1, N1 = random_rational(rng, 3, 6), random_symmetric(rng, 6), random_symmetric(rng, 6)
    names = ("A", "B", "C", "L", "K", "W", "a", "b", "delta_m")

    def value(C_f: Array, S: Array, N: Array) -> Array:
        M = c.eq13(
            S, N, zeros(6), zeros(6, 3), TAU, identity(12), identity(12), GAMMA2, C_f=C_f, **{k: p[k] for k in names}
        )
        return M[corner]

    o = zeros(6)
    return value(C1, S1, N1) - value(C1, o, o) - value(zeros(3, 6), S1, N1) + value(zeros(3, 6), o, o)


def thm1_bilinear(data: Any) -> Statement:
    """The block that holds C_f'B'S (rows 1-1, columns 5-1) must be affine if only C_f'B'(S - N) is not."""
    block = _mixed(data, (slice(0, 6), slice(21, 27)))
    return Statement({"minus the largest mixed difference": -max(abs(x) for x in block.flat)}, strict=False)


def thm1_bilinear_both(data: Any) -> Identity:
    """Outside of C_f'B'S and C_f'B'(S - N), (13) is affine in C_f, S and N together."""
    block = _mixed(data, (slice(None), slice(None)))
    block[0:6, 21:33] = zeros(6, 12)
    block[21:33, 0:6] = zeros(12, 6)
    return Identity(block, zeros(81))


def thm3_lmi(data: Any) -> Result:
    """(17), (19), (20) with all of S, N, F_a, F_b, C_f unknown: affine forms exist and give the same matrices."""
    rng = np.random.default_rng(8)
    left, right = [], []
    variables = {**SN, **GAINS, "C_f": full(3, 6)}
    for on in ("C", "S"):
        for columns in (6, 3):
            chosen = [condition(c.eq17, on=on, columns=columns), c.eq19, c.eq20_printed]
            problem = build(data, "theorem3", "plant", chosen, variables)
            x = [fmpq(int(v), 7) for v in rng.integers(-9, 10, problem.size)]
            first = problem.offsets
            point = {n: v.matrix(x[first[n] : first[n] + v.size]) for n, v in variables.items()}
            left += [problem.forms[k.name].at(x) for k in problem.named]
            right += [k.matrix({**problem.data, **point}) for k in problem.named]
    return Result(Identity(left, right), evidence={"with one term moved only": _one_moved(data)})


def _one_moved(data: Any) -> str:
    """Whether (13) with only the term in S - N removed is affine."""
    problem = build(data, "one moved", "plant", [condition(_half_coupled, sense="<")], {**SN, "C_f": full(3, 6)})
    try:
        problem.forms["_half_coupled"].at([fmpq(0)] * problem.size)
    except NotAffineError:
        return "not affine"
    return "affine"


def _half_coupled(S: Any, N: Any, C_f: Any, A: Any, B: Any, a: Any) -> Any:
    """Block (1,5) of rows 1-1 with the coupling term in S kept, as a symmetric matrix."""
    from recontrol.lmi.blocks import he

    return he(A.T @ S + C_f.T @ B.T @ S + a * S) + N


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
    return Identity(_schur(printed, [15, 16, 17]), due)


def _start(data: Any) -> tuple[Array, Array, Array]:
    rng = np.random.default_rng(10)
    root = random_rational(rng, 6, 6)
    S = root @ root.T + identity(6)
    return S, -(S + identity(6)), initial_state(data)


def eq20_needed(data: Any) -> Identity:
    """(20) and (B.5) by Schur give xi0' P^-1 xi0 <= theta; the proof uses xi0' P xi0 <= theta."""
    S, N, x0 = _start(data)
    P = c.lyapunov(S, N)
    xi0 = np.vstack([x0, zeros(6, 1)])
    return Identity(xi0.T @ inverse(P) @ xi0, xi0.T @ P @ xi0)


def eq20_inverse(data: Any) -> Identity:
    """P^-1 in the place of P: both (20) and (B.5) bound x0' S^-1 x0 = xi0' P^-1 xi0, exactly."""
    S, N, x0 = _start(data)
    theta = data["theta"]
    xi0 = np.vstack([x0, zeros(6, 1)])
    reduced = _schur(c.eq20_printed(S, N, x0=x0, theta=theta), list(range(1, 13)))
    value = x0.T @ inverse(S) @ x0
    return Identity([reduced, xi0.T @ inverse(c.lyapunov(S, N)) @ xi0], [value - identity(1) * theta, value])


def _witness(certificates: Any, data: Any) -> tuple[Array, dict[str, Any]]:
    from recontrol.lmi.certificate import decode

    point = certificates["lemma-other-lambda"]["witness"]["point"]
    return c.lyapunov(decode(point["S"]), decode(point["N"])), problem_data(data, "loop-proposed")


def invariance_disturbed(data: Any, certificates: Any) -> Statement:
    """P of (12), xi = s B d~: dU/dt = s^2 d~'B'(A'P + PA)B d~ + 2 s d~'B'P B d~, whose second term decides for small s.

    The margin is relative to that term, so that it does not depend on the certificate's choice of P.
    """
    P, t = _witness(certificates, data)
    b, A, s = t["B"][:, :1], t["A"], fmpq(1, 10**9)
    second = (b.T @ P @ b)[0, 0] * 2 * s
    rate = (b.T @ (A.T @ P + P @ A) @ b)[0, 0] * s * s + second
    return Statement({"-dU/dt, relative": -rate / second})


def invariance_undisturbed(data: Any, certificates: Any) -> Statement:
    """With d~ = 0 the same P decreases everywhere: -(A'P + PA) > 0."""
    P, t = _witness(certificates, data)
    return Statement(pivots(-(t["A"].T @ P + P @ t["A"]), "-(A'P + PA)"))
