"""Ready-made conditions for the stability of a matrix, at a point and over a box, and how to find their witnesses.

A loop matrix M (n, n) is given exactly, or as balls for a rounding box. The box lemma treats M0 + E diag(d) F, with
every abs(d_k) <= 1 (columns of E, rows of F, radii inside F), by diagonal multipliers.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import ball, rational
from recontrol.lmi.blocks import block, box_lemma, he, negative, positive
from recontrol.lmi.conditions import Condition, condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import NotProvenError, prove_feasible
from recontrol.lmi.scaling import power_of_two
from recontrol.lmi.variables import diagonal, symmetric


@positive
def definite(P: Any) -> Any:
    """P > 0."""
    return P


@negative
def hurwitz(P: Any, M: Any) -> Any:
    """M'P + P M < 0: with P > 0 all eigenvalues of M have negative real part."""
    return he(P @ M)


@negative
def decay(P: Any, M: Any, rate: Any) -> Any:
    """M'P + P M + 2 rate P < 0: with P > 0 all eigenvalues of M have real part below -rate."""
    return he(P @ M) + 2 * rate * P


@negative
def schur(P: Any, M: Any) -> Any:
    """M'P M - P < 0: with P > 0 all eigenvalues of M lie inside the unit circle."""
    return M.T @ P @ M - P


@negative
def disk(P: Any, M: Any, centre: Any, radius: Any) -> Any:
    """(M - centre I)'P (M - centre I) - radius^2 P < 0: eigenvalues of M inside the disk about ``centre``."""
    n = M.shape[0]
    shifted = M - centre * np.eye(n, dtype=int)
    return shifted.T @ P @ shifted - radius * radius * P


@positive
def expanding(P: Any, M: Any) -> Any:
    """M'P + P M > 0: if M were Hurwitz, P would be negative definite."""
    return he(P @ M)


@positive
def somewhere_positive(P: Any, v: Any) -> Any:
    """v'P v > 0 for one vector v (n, 1), so P is not negative definite: with `expanding`, M is not Hurwitz."""
    return v.T @ P @ v


@box_lemma("T")
@positive
def box_hurwitz(P: Any, T: Any, M: Any, E: Any, F: Any) -> Any:
    """[-(M'P + P M) - F'T F, -P E; -E'P, T] > 0: M + E D F is Hurwitz for every D of the box, with this one P > 0.

    For diagonal T > 0, he(P E D F) <= P E T^-1 E'P + F'D T D F and D T D <= T; the Schur complement is the condition.
    """
    return block([[-he(P @ M) - F.T @ T @ F, -(P @ E)], [T]])


def entry_box(half: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """E (m, k), F (k, n) of the box of entries abs(M - M0) <= ``half`` (m, n), zeros of ``half`` left out."""
    places = [(i, j) for i, j in np.ndindex(half.shape) if half[i, j] != 0]
    E, F = rational.zeros(half.shape[0], max(len(places), 1)), rational.zeros(max(len(places), 1), half.shape[1])
    for k, (i, j) in enumerate(places):
        E[i, k], F[k, j] = fmpq(1), half[i, j]
    return E, F


def prove_stable(
    M: np.ndarray,
    *,
    kind: str = "hurwitz",
    units: Any = 1,
    decimals: int = 10,
    name: str = "loop",
    says: str = "",
    given: dict[str, Any] | None = None,
    **context: str,
) -> dict[str, Any]:
    """Certificate of stability of ``M`` (n, n), exact or balls, with a Lyapunov matrix found in floats.

    ``kind``: "hurwitz", "schur", "decay" (given rate) or "disk" (given centre, radius), exact scalars in ``given``.
    ``units`` of the states make P well scaled: P = diag(1/units) P_s diag(1/units). ``context``: paper, case, source.
    Raises NotProvenError if no P of the solver survives; for an unstable M always.
    """
    kinds: dict[str, Any] = {"hurwitz": hurwitz, "schur": schur, "decay": decay, "disk": disk}
    if kind not in kinds:
        raise ValueError(f"kind: expected one of {sorted(kinds)}, found {kind!r}")
    weight = _inverse_units(units, M.shape[0])
    conditions: Sequence[Condition] = [condition(definite), condition(kinds[kind])]
    data = {"M": M, **(given or {})}
    problem = Problem(
        name, {"P": symmetric(M.shape[0])}, conditions, data, units={"P": (weight, weight)}, **_text(context)
    )
    point = {"P": _lyapunov_float(M, kind, given or {}, weight)}
    return prove_feasible(problem, point, decimals=decimals, says=says or f"{name}: stable ({kind})")


def prove_unstable(
    M: np.ndarray, *, units: Any = 1, decimals: int = 10, name: str = "loop", says: str = "", **context: str
) -> dict[str, Any]:
    """Certificate that ``M`` (n, n), exact or balls, has an eigenvalue with positive real part.

    The witness is an indefinite P with M'P + P M > 0 and a direction in which P is positive. (Multipliers that refute
    the Lyapunov inequality itself are rank one along an eigenvector, so in general not rational.) ``units`` as in
    `prove_stable`. Raises NotProvenError if the midpoint has no eigenvalue right of the imaginary axis, or one on it.
    """
    import scipy.linalg

    weight = _inverse_units(units, M.shape[0])
    w = rational.to_float(np.array(weight, dtype=object))
    scaled = ball.midpoint(M) * w[:, None] / w[None, :]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a singular equation gives a P that the proof refuses
            P = scipy.linalg.solve_continuous_lyapunov(scaled.T, np.eye(len(w)))
    except np.linalg.LinAlgError as error:
        raise NotProvenError(f"{name}: the Lyapunov equation of the loop matrix is singular") from error
    v = np.linalg.eigh(P)[1][:, -1:]
    data = {"M": M, "v": rational.rounded(v / w[:, None], 6 + int(np.ceil(max(0.0, np.log10(w.max())))))}
    problem = Problem(
        name,
        {"P": symmetric(len(w))},
        [condition(expanding), condition(somewhere_positive)],
        data,
        units={"P": (weight, weight)},
        **_text(context),
    )
    point = {"P": w[:, None] * (P + P.T) / 2 * w[None, :]}
    return prove_feasible(problem, point, decimals=decimals, says=says or f"{name}: unstable")


def _lyapunov_float(M: np.ndarray, kind: str, given: dict[str, Any], weight: list[fmpq]) -> np.ndarray:
    import scipy.linalg

    w = rational.to_float(np.array(weight, dtype=object))
    scaled = ball.midpoint(M) * w[:, None] / w[None, :]
    n = len(w)
    numbers = {name: float(ball.midpoint(x)) for name, x in given.items()}
    try:
        if kind in ("hurwitz", "decay"):
            shifted = scaled + numbers.get("rate", 0.0) * np.eye(n)
            if np.linalg.eigvals(shifted).real.max() >= 0:
                raise NotProvenError("the midpoint of the loop matrix is not stable")
            P = scipy.linalg.solve_continuous_lyapunov(shifted.T, -np.eye(n))
        else:
            shifted = (scaled - numbers.get("centre", 0.0) * np.eye(n)) / numbers.get("radius", 1.0)
            if np.abs(np.linalg.eigvals(shifted)).max() >= 1:
                raise NotProvenError("the midpoint of the loop matrix is not stable")
            P = scipy.linalg.solve_discrete_lyapunov(shifted.T, np.eye(n))
    except np.linalg.LinAlgError as error:
        raise NotProvenError("the Lyapunov equation of the loop matrix is singular") from error
    return w[:, None] * (P + P.T) / 2 * w[None, :]


def prove_box_stable(
    M: np.ndarray,
    E: np.ndarray,
    F: np.ndarray,
    *,
    units: Any = 1,
    decimals: int = 8,
    margin: str | None = None,
    name: str = "loop box",
    says: str = "",
    solver: str = "CLARABEL",
    **context: str,
) -> dict[str, Any]:
    """Certificate that M + E D F is Hurwitz for every diagonal D in [-1, 1], with one P and diagonal multipliers T.

    M (n, n), E (n, k), F (k, n) exact (balls allowed in M). ``units`` as in `prove_stable`; ``margin`` as in
    `Problem.solve`. Raises NotProvenError if no witness is found, in particular if the box holds an unstable matrix.
    """
    weight = _inverse_units(units, M.shape[0])
    k = E.shape[1]
    scaled_E = rational.to_float(E) * rational.to_float(np.array(weight, dtype=object))[:, None]
    scaled_F = rational.to_float(F) / rational.to_float(np.array(weight, dtype=object))[None, :]
    ratios = np.linalg.norm(scaled_E, axis=0) / np.maximum(np.linalg.norm(scaled_F, axis=1), 1e-30)
    balances = [power_of_two(float(max(r, 1e-30) ** 0.5)) for r in ratios]
    problem = Problem(
        name,
        {"P": symmetric(M.shape[0]), "T": diagonal(k)},
        [condition(definite), condition(box_hurwitz), condition(bounded)],
        {"M": M, "E": E, "F": F, "weight": rational.diagonal(weight)},
        units={"P": (weight, weight), "T": (balances, balances)},
        **_text(context),
    )
    solution = problem.solve(solver, margin=margin)
    return prove_feasible(
        problem, solution, decimals=decimals, statement="box", says=says or f"{name}: Hurwitz over the whole box"
    )


@positive
def bounded(P: Any, weight: Any) -> Any:
    """weight^2 - P > 0, which keeps the scale of a homogeneous problem."""
    return weight @ weight - P


def _inverse_units(units: Any, n: int) -> list[fmpq]:
    given = list(units) if isinstance(units, (list, tuple, np.ndarray)) else [units] * n
    return [1 / rational.rational(u) for u in given]


def _text(context: dict[str, str]) -> dict[str, Any]:
    unknown = set(context) - {"paper", "case", "source"}
    if unknown:
        raise TypeError(f"unknown keywords {sorted(unknown)}; context is paper, case, source")
    return dict(context)
