"""Lemmas 1 to 4 and the algebra of the proof of Theorem 1, in every dimension (see `algebra`) but for its last steps.

These, from (25) to (26) and from (29) to (30), are compared at random rational matrices with the conditions solved.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.proofs import provided, verified
from recontrol.claims.values import Identity, Result, Size, Statement
from recontrol.exact import rational

from .. import algebra as a
from .. import conditions, plant

TIGHT = fmpq(1, 10**9)
"""Relative width within which an infimum must meet the norm that it should be."""


def bounded_real(certificates: Any, synthesis: Any) -> Result:
    """(8) is feasible just above the H-infinity norm and only above it, both gains.

    Feasible: certificates brl-ext and brl-trad. Not feasible at or below the norm: the sufficiency proof, and the norm
    is bounded from below by an evaluation. The statement: each certificate's gamma lies within 1e-9 of that lower
    bound.
    """
    from recontrol.lmi import verify

    margins, evidence = {}, {}
    for gain in plant.GAINS:
        name = f"brl-{gain}"
        gamma = verify.number(certificates[name]["data"]["gamma"])
        lower = synthesis["norms"][plant.DEFAULT][gain]["hinf"]["lower"]
        margins[f"gap closes, K_{gain}"] = provided(verified(certificates, name), TIGHT - (gamma / lower - 1))
        margins[f"above the norm, K_{gain}"] = gamma / lower - 1
        evidence |= {f"feasible at gamma_inf, K_{gain}": gamma, f"infeasible at, K_{gain}": lower}
    return Result(Statement(margins), evidence)


def h2_infimum(certificates: Any, synthesis: Any) -> Result:
    """The infimum of rho in (9) at a fixed gain is the squared H2 norm, both gains.

    Feasible within 1e-6 above it: certificates. Not below: X of (9) exceeds the Gramian, so Tr Z > h2^2.
    """
    from recontrol.lmi import verify

    margins, evidence = {}, {}
    for gain in plant.GAINS:
        name, squared = f"lemma2-{gain}", synthesis["fixed-gain"][gain]["h2_squared"]
        rho = verify.number(certificates[name]["data"]["rho"])
        excess = rho / squared - 1
        margins[f"within 1e-6, K_{gain}"] = provided(verified(certificates, name), fmpq(1, 10**6) - excess)
        margins[f"above, K_{gain}"] = excess
        evidence |= {f"proven rho, K_{gain}": rho, f"h2^2, K_{gain}": squared}
    return Result(Statement(margins), evidence)


def schur_printed() -> Result:
    """First forms of (12), (13): A12 - A12' A11^{-1} A12 for A = [-1, 1; 1, -4] < 0, which should be negative."""
    A11, A12, A22 = fmpq(-1), fmpq(1), fmpq(-4)
    value = A12 - A12 * A12 / A11
    evidence = {
        "det A (A11 < 0, so A < 0)": A11 * A22 - A12 * A12,
        "printed expression": value,
        "A22 - A12' A11^{-1} A12": A22 - A12 * A12 / A11,
        "size of A12 if A11 is 2x2 and A22 1x1": "2x1",
        "size of A12' A11^{-1} A12 then": "1x1",
    }
    return Result(Statement({"minus the printed expression": -value}), evidence)


def schur_correct() -> Identity:
    """With A22 in its place: congruence of A with [I, -A11^{-1} A12; 0, I] gives diag(A11, A22 - A12' A11^{-1} A12)."""
    A11, A12, A22, Ai = a.symbols("A11 A12 A22 Ai")
    block = [[A11, A12], [a.T(A12), A22]]
    M = [[1, -Ai * A12], [0, 1]]
    return Identity(a.flat(a.congruence(M, block)), a.flat([[A11, 0], [0, A22 - a.T(A12) * Ai * A12]]))


def reciprocal_projection() -> Identity:
    """Schur complement of (15) = Psi + S + S' + (U - P)' P^{-1} (U - P), U = W + S: least at W = P - S, where it is
    (14)."""
    Psi, P, W, S, Pi = a.symbols("Psi P W S Pi")
    complement = Psi + P - W - a.T(W) + (a.T(S) + a.T(W)) * Pi * (S + W)
    U = W + S
    return Identity(a.flat(complement), a.flat(Psi + a.he(S) + a.T(U - P) * Pi * (U - P)))


def _loop() -> tuple[Any, Any]:
    """A + B1 K as one symbol, and B2."""
    return a.symbol("L"), a.symbol("B")


def _schur_of_ii() -> Any:
    X, A, N, B = a.symbols("X A N B")
    return a.schur([[a.he(X * A + N), X * B], [a.T(B) * X, -1]], -1)[0][0]


def eq16_printed() -> Identity:
    """(16), with the factor 1/gamma2, against the Schur complement of the first matrix of (ii)."""
    import sympy as sp

    X, A, N, B = a.symbols("X A N B")
    printed = a.he(X * A + N) + X * B * a.T(B) * X / sp.Symbol("gamma2", positive=True)
    return Identity(a.flat(printed), a.flat(_schur_of_ii()))


def eq16_without() -> Identity:
    """The same without the factor, and with N1 = X B1 K it is (17)."""
    X, A, B, B1, K = a.symbols("X A B B1 K")
    seventeen = a.he(X * (A + B1 * K)) + X * B * a.T(B) * X
    replaced = _schur_of_ii().subs({a.symbol("N"): X * B1 * K, a.symbol("Nt"): a.T(X * B1 * K)})
    return Identity(a.flat(seventeen), a.flat(replaced))


def _upper20() -> Any:
    L, _ = _loop()
    Y, W = a.symbols("Y W")
    return L * Y + a.T(W)


def eq20_printed() -> Identity:
    """Lower left block of (20) as printed, Y(A + B1K) + W, against the transpose of the upper right one."""
    L, _ = _loop()
    Y, W = a.symbols("Y W")
    return Identity(a.flat(Y * L + W), a.flat(a.T(_upper20())))


def eq20_transposed() -> Identity:
    """The same with (A + B1K)'."""
    L, _ = _loop()
    Y, W = a.symbols("Y W")
    return Identity(a.flat(Y * a.T(L) + W), a.flat(a.T(_upper20())))


def eq25() -> a.Block:
    """(25), with L for A + B1K and B for B2."""
    L, B = _loop()
    Q, X = a.symbols("Q X")
    side = a.T(Q) * L + X
    return [[-Q - a.T(Q), side, a.T(Q) * B, a.T(Q)], [a.T(side), -X, 0, 0], [a.T(B) * Q, 0, -1, 0], [Q, 0, 0, -X]]


def eq29() -> a.Block:
    """(29), with L for A + B1K and C for C2."""
    L, C, Q, X = a.symbols("L C Q X")
    side = a.T(Q) * a.T(L) + X
    return [[-Q - a.T(Q), side, a.T(Q) * a.T(C), a.T(Q)], [L * Q + X, -X, 0, 0], [C * Q, 0, -1, 0], [Q, 0, 0, -X]]


def _numbers() -> dict[str, np.ndarray]:
    """Random rational matrices of the paper's sizes (fixed seed), X symmetric."""
    random = np.random.default_rng(2016)
    sizes = {"A": (6, 6), "B1": (6, 3), "B2": (6, 3), "C2": (3, 6), "K": (3, 6), "Q": (6, 6), "X": (6, 6)}
    found = {name: rational.matrix(random.integers(-9, 10, size).tolist()) * fmpq(1, 7) for name, size in sizes.items()}
    return found | {"X": found["X"] + found["X"].T}


def _tied(tie: Callable[..., np.ndarray], m: dict[str, np.ndarray]) -> np.ndarray:
    """N2 or N3: what the tie of Theorem 1, N less its definition, leaves of N = 0, with the sign turned."""
    return -tie(m["Q"], rational.zeros(6), m["B1"], m["K"])


def chain_21_26() -> Identity:
    """(21) and (22) have the Schur complements (20) and (21); (23) turns (22) into (25); N2 = Q'B1K gives (26).

    The last step at random rational matrices: the condition (26) of Theorem 1 with this N2 against (25) at A + B1K.
    """
    L, B = _loop()
    Y, W, P, Pi, Q, X = a.symbols("Y W P Pi Q X")
    up = L * Y + a.T(W)
    eq20 = [[B * a.T(B) + P - W - a.T(W), up], [a.T(up), -P]]
    eq21 = [[P - W - a.T(W), up, B], [a.T(up), -P, 0], [a.T(B), 0, -1]]
    eq22 = [[-W - a.T(W), up, B, P], [a.T(up), -P, 0, 0], [a.T(B), 0, -1, 0], [P, 0, 0, -P]]
    first = (a.flat(a.schur(eq21, -1)), a.flat(eq20))
    second = (a.flat(a.schur(eq22, -Pi)), a.flat(eq21))
    # (23) is applied with P = X^{-1}, that is P = Y.
    with_y = [[_rename(e, P, Y) for e in row] for row in eq22]
    M = [[Q, 0, 0, 0], [0, X, 0, 0], [0, 0, 1, 0], [0, 0, 0, X]]
    third = (a.flat(a.congruence(M, with_y)), a.flat(eq25()))
    m = _numbers()
    eq26 = conditions.thm1_iii(m["X"], m["Q"], _tied(conditions.tied_n2, m), m["A"], m["B2"])
    loop = {"L": m["A"] + m["B1"] @ m["K"], "B": m["B2"], "Q": m["Q"], "X": m["X"]}
    pairs = (first, second, third, (eq26, a.evaluate(eq25(), loop)))
    return Identity(tuple(p[0] for p in pairs), tuple(p[1] for p in pairs))


def _rename(expression: Any, old: Any, new: Any) -> Any:
    import sympy as sp

    return sp.sympify(expression).subs(old, new)


def chain_29_30() -> Identity:
    """(29) is (25) under the paper's transformation to the dual system, L to L' and B2 to C2'; N3 = B1 K Q gives (30).

    The last step at random rational matrices: the condition (30) of Theorem 1 with this N3 against (29) at A + B1K.
    """
    L, C = a.symbols("L C")
    dual = a.exchange(eq25(), {"L": a.T(L), "B": a.T(C)})
    m = _numbers()
    eq30 = conditions.thm1_iv(m["X"], m["Q"], _tied(conditions.tied_n3, m), m["A"], m["C2"])
    loop = {"L": m["A"] + m["B1"] @ m["K"], "C": m["C2"], "Q": m["Q"], "X": m["X"]}
    return Identity((a.flat(dual), eq30), (a.flat(eq29()), a.evaluate(eq29(), loop)))


def size_printed(data: Any) -> Size:
    """Block (1,2) of the second matrix of (iv) as printed: B2'."""
    return Size(*plant.matrices(data, plant.exact_rate(data))["B2"].T.shape)


def size_corrected(data: Any) -> Size:
    """The same with B2."""
    return Size(*plant.matrices(data, plant.exact_rate(data))["B2"].shape)
