"""Sections II.B and III: lemmas, congruences and equivalences, by exact algebra at random rational points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise, product
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.proofs import undecided
from recontrol.claims.values import Identity, Result, Statement
from recontrol.exact.linalg import determinant
from recontrol.exact.rational import decimal, identity, zeros
from recontrol.lmi.conditions import condition
from recontrol.lmi.variables import full

from .. import conditions as c
from ..plant import controller, loop, plant
from ..problems import GAINS, SN, build, problem_data
from .support import drift_limit, random_rational, random_symmetric, refuted, schur

Array = np.ndarray
HALF = fmpq(1, 2)
PLANT = ("A", "B", "C", "L", "K", "W", "a", "b", "delta_m")
# Rows 1-1 of (13), and columns 5-1 and 5-2, where C_f'B'S and C_f'B'(S - N) stand.
TOP, ON_S, ON_Y = slice(0, 6), slice(21, 27), slice(27, 33)
DRIFT = fmpq(2, 100)
READINGS17 = tuple(product(("C", "S"), (6, 3)))


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
    """Schur complement of the block inequality less Omega + Theta Gamma' + Gamma Theta': half of a square.

    It is the square of Theta/lambda - lambda Gamma, so the block inequality gives more than is asked.
    """
    rng = np.random.default_rng(2)
    left, right = [], []
    for scale in (fmpq(1, 3), fmpq(7, 2)):
        Omega, Theta, Gamma = random_symmetric(rng, 4), random_rational(rng, 4, 3), random_rational(rng, 4, 3)
        border = Theta / scale + Gamma * scale
        whole = np.block([[Omega, border], [border.T, identity(3) * -2]])
        left.append(schur(whole, [4, 5, 6]) - (Omega + Theta @ Gamma.T + Gamma @ Theta.T))
        gap = Theta / scale - Gamma * scale
        right.append(gap @ gap.T * HALF)
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
    return Identity(schur(whole, list(range(18, 36))), due)


def lemma3(data: Any) -> Identity:
    """(A.5) is the disk inequality (A.1) plus terms >= 0, and Phi_1 plus terms >= 0 for P > 0: (12) gives both."""
    m = _random_loop(data)
    P, a, b, A, C, W = m["P"], m["a"], m["b"], m["A"], m["C"], m["W"]
    whole = c.eq12(P, TAU, GAMMA2, A=A, B=m["B"], C=C, W=W, a=a, b=b)
    reduced = schur(whole, list(range(18, 36)))
    shifted, WA = A + identity(12) * a, W @ A
    disk = shifted.T @ P @ shifted / a - P * (b * b / a)
    performance = reduced - _performance(m, TAU, GAMMA2)
    due = zeros(18, 18)
    due[:12, :12] = A.T @ P @ A / a + P * ((a * a - b * b) / a)
    return Identity([reduced[:12, :12], performance], [disk + WA.T @ WA * TAU + C.T @ C, due])


def mismatch(*factors: Array) -> fmpq:
    """Columns of each factor minus rows of the next, in absolute value, summed: zero if the product exists."""
    return fmpq(sum(abs(a.shape[1] - b.shape[0]) for a, b in pairwise(factors)))


def eqA3_printed(data: Any) -> Statement:
    """As printed, xi A~' W0' W0 (E~ e or B~ d~) with a column xi.

    The product with E~ e has the same sizes: the non-zero columns of E~ are those of B~.
    """
    m = _random_loop(data)
    A, W, B = m["A"], m["W"], m["B"]
    xi, input_ = zeros(A.shape[1], 1), zeros(B.shape[1], 1)
    off = mismatch(xi, A.T, W.T, W, B, input_)
    return Statement({"rows and columns off in xi A~' W0' W0 B~ d~": -off}, strict=False)


def eqA3_transposed(data: Any) -> Identity:
    """With xi', M a row and the limit t in the integral, the rate equals M Phi_1 M' of (A.4), at random points."""
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
    """Gamma1' P Gamma1 = [S S; S Y]; diag(Gamma1, I, I, I, Gamma1) turns (12) into (13) less its uncertain rows.

    T = [I 0; I -I], of determinant 1, turns P into diag(S, -N): P > 0 if and only if S > 0 and N < 0.
    """
    t = _theorem_point(data)
    S, N, one = t["S"], t["N"], identity(6)
    Gamma1 = np.block([[one, one], [one, zeros(6)]])
    P = c.lyapunov(S, N)
    whole = c.eq12_structured(S, N, TAU, GAMMA2, **{k: t[k] for k in ("A", "B", "C", "W", "a", "b")})
    reduced = schur(whole, [21, 22, 23])
    turn = zeros(33)
    turn[:12, :12] = turn[21:, 21:] = Gamma1
    turn[12:21, 12:21] = identity(9)
    p = problem_data(data, "proposed")
    one12 = identity(12)
    full13 = c.eq13(S, N, N @ t["A_f"], N @ t["B_f"], TAU, one12, one12, GAMMA2, **{k: p[k] for k in ("C_f", *PLANT)})
    T = np.block([[one, zeros(6)], [one, -one]])
    split = np.block([[S, zeros(6)], [zeros(6), -N]])
    left = [Gamma1.T @ P @ Gamma1, turn.T @ reduced @ turn, T.T @ P @ T, determinant(T)]
    return Identity(left, [np.block([[S, S], [S, S - N]]), full13[:33, :33], split, fmpq(1)])


def thm1_equiv(certificates: Any) -> Result:
    """At 2 % drift diagonal multipliers give (13) a point, so (16) holds for all F; two scalars give none.

    A point for some drift is one for every smaller drift: 2 % has to lie between the bounds of the certificates.
    """
    names = "drift-diag-below", "drift-one-above"
    point, none = (drift_limit(certificates, name) for name in names)
    limits = {
        "(13), diagonal multipliers: a point up to delta_m": point,
        "(13), two scalars: none from delta_m": none,
    }
    if not decimal(none) <= DRIFT <= decimal(point):
        return Result(Statement(undecided()), evidence=limits)
    return refuted(certificates, *names, evidence=limits, but=["delta_m"])


def _mixed(value: Callable[[Array, Array, Array], Array]) -> tuple[Array, tuple[Array, Array, Array]]:
    """Mixed second difference of a matrix in C_f and (S, N), and the point: zero if it is affine in all of them."""
    rng = np.random.default_rng(7)
    C_f, S, N = random_rational(rng, 3, 6), random_symmetric(rng, 6), random_symmetric(rng, 6)
    o, none = zeros(6), zeros(3, 6)
    return value(C_f, S, N) - value(C_f, o, o) - value(none, S, N) + value(none, o, o), (C_f, S, N)


def _eq13_at(data: Any) -> Callable[[Array, Array, Array], Array]:
    """(13) with the scalars of Table 1 as a function of C_f, S, N; F_a = F_b = 0."""
    t = problem_data(data, "plant")
    fixed = [t[k] for k in ("tau", "D1", "D2", "gamma2")]

    def value(C_f: Array, S: Array, N: Array) -> Array:
        return c.eq13(S, N, zeros(6), zeros(6, 3), *fixed, C_f=C_f, **{k: t[k] for k in PLANT})

    return value


def _eq17_at(data: Any, on: str, columns: int, kept: Sequence[slice]) -> Callable[[Array, Array, Array], Array]:
    """(17) as `_eq13_at` has (13), with the coupling terms of the columns ``kept`` put back from the border."""
    t = problem_data(data, "plant")
    given = {k: t[k] for k in (*PLANT, "tau", "e1", "e2", "lambda1")} | {"on": on, "columns": columns}

    def value(C_f: Array, S: Array, N: Array) -> Array:
        M = c.eq17(S, N, zeros(6), zeros(6, 3), C_f, t["gamma2"], **given)
        for place in kept:
            term = M[TOP, -columns:] @ M[place, -columns:].T
            M[TOP, place] += term
            M[place, TOP] += term.T
            M[place, -columns:] *= 0
            M[-columns:, place] *= 0
        return M

    return value


def _affinity(data: Any, kept: Sequence[slice]) -> str:
    """Whether (17) in all its readings is affine in C_f and S, N with the coupling terms ``kept`` put back."""
    found = {bool((_mixed(_eq17_at(data, *which, kept))[0] == 0).all()) for which in READINGS17}
    return " or ".join(sorted("affine" if affine else "not affine" for affine in found))


def thm1_bilinear(data: Any) -> Statement:
    """The block that holds C_f'B'S (rows 1-1, columns 5-1) must be affine if only C_f'B'(S - N) is not."""
    difference, _ = _mixed(_eq13_at(data))
    return Statement({"minus the largest mixed difference": -abs(difference[TOP, ON_S]).max()}, strict=False)


def thm1_bilinear_both(data: Any) -> Identity:
    """The products in C_f and S, N of (13) are C_f'B'S and C_f'B'(S - N) in rows 1-1, and no others."""
    difference, (C_f, S, N) = _mixed(_eq13_at(data))
    B, due = plant(data)["B"], zeros(81)
    due[TOP, ON_S], due[TOP, ON_Y] = C_f.T @ B.T @ S, C_f.T @ B.T @ (S - N)
    return Identity(difference, due + due.T)


def thm3_lmi(data: Any) -> Result:
    """(17), (19), (20) with all of S, N, F_a, F_b, C_f unknown: affine forms exist and give the same matrices.

    What (17) moves to its border is Phi Psi' there, and with its transpose makes (17) into (13) again.
    """
    rng = np.random.default_rng(8)
    left, right = [], []
    variables = {**SN, **GAINS, "C_f": full(3, 6)}
    for on, columns in READINGS17:
        chosen = [condition(c.eq17, on=on, columns=columns), c.eq19, c.eq20_printed]
        problem = build(data, "theorem3", "plant", chosen, variables)
        x = [fmpq(int(v), 7) for v in rng.integers(-9, 10, problem.size)]
        first = problem.offsets
        point = {n: v.matrix(x[first[n] : first[n] + v.size]) for n, v in variables.items()}
        left += [problem.forms[k.name].at(x) for k in problem.named]
        right += [k.matrix({**problem.data, **point}) for k in problem.named]
        at = (point["C_f"], point["S"], point["N"])
        left.append(_eq17_at(data, on, columns, (ON_S, ON_Y))(*at)[:81, :81])
        right.append(_eq13_at(data)(*at))
    evidence = {
        "both terms moved": _affinity(data, ()),
        "only the term in S - N moved": _affinity(data, (ON_S,)),
        "only the term in S moved": _affinity(data, (ON_Y,)),
    }
    return Result(Identity(left, right), evidence=evidence)
