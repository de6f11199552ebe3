"""Points and contradictions for the printed conditions at the published gains, SI units, exact rationals.

Witnesses come from Riccati and Lyapunov equations, not from semidefinite programs. The orbital rate is rounded to 16
decimals (`plant.exact_rate`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact.ball import precision
from recontrol.exact.linalg import inverse, lyapunov
from recontrol.exact.rational import decimal, identity, rounded
from recontrol.lmi.conditions import condition
from recontrol.lmi.proof import prove_feasible, prove_infeasible
from recontrol.lmi.variables import full, symmetric
from recontrol.systems.riccati import minimal_solution

from .. import conditions as c
from .. import plant, problems, riccati
from ..problems import pick

ADMITTED, BACKED_OFF = "1.01", "1.005"
"""g of the printed inequalities, and the smaller one for which the witness is computed."""

SLACK = fmpq(10001, 10000)


def _si(data: Any, gain: str) -> tuple[str, dict[str, Any]]:
    case = f"SI:{gain}"
    return case, problems.source(data, case)


def _brl_equation(data: Any, gain: str, g: str) -> tuple[np.ndarray, ...]:
    """Matrices of the Riccati equation of (8) at level g, scaled units (see `riccati.bounded_real`)."""
    scaled, K = problems.source(data, f"scaled:{gain}"), plant.scaled_gain(data, gain)
    return riccati.bounded_real(scaled, K, decimal(g))


def _x_of_brl(data: Any, gain: str, g: str, *, decimals: int = 12, extra: int = 6, bits: int = 160) -> np.ndarray:
    """X > 0 (6, 6), exact, that satisfies (8) with a margin: the least one at level g with an extra source, SI.

    The extra source is 10^-extra I in scaled units, in which X is rounded to ``decimals``.
    """
    closed, source, feedback = _brl_equation(data, gain, g)
    X = minimal_solution(closed.T, source + identity(6) * fmpq(1, 10**extra), feedback, bits=bits)
    back = plant.units(data, gain).covariance(rounded(X, decimals), back=True)
    return back * plant.scale_factors(data, gain)["h8"]


def _p_of_brl(data: Any, gain: str, g: str) -> np.ndarray:
    """P = X^{-1} (6, 6), exact, for X as in (8): the least one, which makes Tr(C2 P C2') small, SI."""
    closed, source, feedback = _brl_equation(data, gain, g)
    P = minimal_solution(closed, feedback + identity(6) * fmpq(1, 10**6), source)
    return plant.units(data, gain).quadratic(rounded(P, 12), back=True) * (1 / plant.scale_factors(data, gain)["h8"])


def _thm2_printed(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    P = _p_of_brl(data, gain, BACKED_OFF)
    X = inverse(P)
    Q, N2 = problems.vacuous(X, si["A"], si["B2"])
    Z = si["C2"] @ P @ si["C2"].T * SLACK
    rho = np.trace(Z) * SLACK
    given = pick(si, "A B1 B2 C1 C2 D1 D2 K", gamma=decimal(ADMITTED) * data["z_weight"], rho=rho)
    conditions = [c.thm1_iii, c.output_coupling, c.trace_below, c.definite, c.brl, c.tied_gain]
    variables = {"X": symmetric(6), "W": full(3, 6), "Q": full(6, 6), "N2": full(6, 6), "Z": symmetric(3)}
    problem = problems.problem(f"thm2-printed-{gain}", case, variables, conditions, given)
    point = {"X": X, "W": si["K"] @ X, "Q": Q, "N2": N2, "Z": Z}
    return prove_feasible(problem, point, says=f"the LMIs of Theorem 2 as printed hold with K = K_{gain} and this rho")


def thm2_printed_ext(data: Any) -> dict[str, Any]:
    """K_ext satisfies the printed LMIs with a rho far below its squared H2 norm."""
    return _thm2_printed(data, "ext")


def thm2_printed_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _thm2_printed(data, "trad")


def _tied_shared(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    problem = problems.problem(
        f"tied-shared-{gain}", case, {"X": symmetric(6)}, [c.shared_inf, c.shared_h2], {"Ms": si["Ms"]}
    )
    V = symmetriser(si["Ms"])
    product = si["Ms"] @ V
    multipliers = {"shared_inf": (product + product.T) * fmpq(1, 2), "shared_h2": V}
    says = f"no X is shared by (8) and by (26) with N2 = Q'B1K at K = K_{gain}, whatever gamma_inf and rho"
    return prove_infeasible(problem, multipliers=multipliers, says=says)


def symmetriser(Ms: np.ndarray) -> np.ndarray:
    """Vs (3, 3) symmetric with Ms Vs symmetric, for Ms that couples axes 1 and 3 only; rationals or balls."""
    V = identity(3)
    if Ms[0, 2] == 0 and Ms[2, 0] == 0:
        return V
    V[0, 2] = V[2, 0] = (Ms[2, 0] - Ms[0, 2]) / (Ms[0, 0] - Ms[2, 2])
    return V


def tied_shared_ext(data: Any) -> dict[str, Any]:
    """With N2 tied and one X, Theorem 2 is infeasible for K_ext."""
    return _tied_shared(data, "ext")


def tied_shared_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _tied_shared(data, "trad")


def _h2_gramian(data: Any, loop: np.ndarray, source: np.ndarray, gain: str, covariance: bool) -> np.ndarray:
    """Exact solution of a Lyapunov inequality a little above the Gramian, rounded in scaled units."""
    unit = plant.units(data, gain)
    A = unit.dynamics(loop)
    if covariance:
        back = unit.covariance
        source = unit.covariance(source) * unit.time
    else:
        A, back = A.T, unit.quadratic
        source = unit.quadratic(source) * unit.time
    size = max(abs(x) for x in source.flat)
    with precision(200):
        X = lyapunov(A, source + identity(6) * (size * fmpq(1, 10**9)))
    return back(rounded(X * (1 / size), 14) * size, back=True)


def _thm1_iii_point(data: Any, si: dict[str, Any], gain: str) -> dict[str, Any]:
    loop = plant.closed_loop(si, si["K"])
    Y = _h2_gramian(data, loop, si["B2"] @ si["B2"].T, gain, covariance=True)
    X = inverse(Y)
    Q = inverse(identity(6) - loop.T) @ X
    Z = si["C2"] @ Y @ si["C2"].T * (1 + fmpq(1, 10**7))
    return {"X": X, "Q": Q, "N2": Q.T @ si["B1"] @ si["K"], "Z": Z}


def _thm1_iii(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    point = _thm1_iii_point(data, si, gain)
    given = pick(si, "A B1 B2 C2 K", rho=np.trace(point["Z"]) * (1 + fmpq(1, 10**7)))
    conditions = [c.thm1_iii, c.tied_n2, c.output_coupling, c.trace_below, c.definite]
    variables = {"X": symmetric(6), "Q": full(6, 6), "N2": full(6, 6), "Z": symmetric(3)}
    problem = problems.problem(f"thm1-iii-{gain}", case, variables, conditions, given)
    return prove_feasible(problem, point, says=f"(iii) of Theorem 1 with N2 = Q'B1K holds for K_{gain} with this rho")


def thm1_iii_ext(data: Any) -> dict[str, Any]:
    """(iii) with N2 tied at K_ext, rho within 1e-6 of the squared H2 norm."""
    return _thm1_iii(data, "ext")


def thm1_iii_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _thm1_iii(data, "trad")


def _thm1_iv(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    loop = plant.closed_loop(si, si["K"])
    R = _h2_gramian(data, loop, si["C2"].T @ si["C2"], gain, covariance=False)
    X = inverse(R)
    Q = inverse(identity(6) - loop) @ X
    Z = si["B2"].T @ R @ si["B2"] * (1 + fmpq(1, 10**7))
    given = pick(si, "A B1 B2 C2 K", rho=np.trace(Z) * (1 + fmpq(1, 10**7)))
    conditions = [c.thm1_iv, c.tied_n3, c.input_coupling, c.trace_below, c.definite]
    variables = {"X": symmetric(6), "Q": full(6, 6), "N3": full(6, 6), "Z": symmetric(3)}
    problem = problems.problem(f"thm1-iv-{gain}", case, variables, conditions, given)
    point = {"X": X, "Q": Q, "N3": si["B1"] @ si["K"] @ Q, "Z": Z}
    return prove_feasible(problem, point, says=f"(iv) of Theorem 1, sizes corrected, holds for K_{gain} with this rho")


def thm1_iv_ext(data: Any) -> dict[str, Any]:
    """(iv) with N3 tied and sizes corrected at K_ext."""
    return _thm1_iv(data, "ext")


def thm1_iv_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _thm1_iv(data, "trad")


def _tied_separate(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    point = _thm1_iii_point(data, si, gain)
    given = pick(si, "A B1 B2 C1 C2 D1 D2 K", rho=np.trace(point["Z"]) * (1 + fmpq(1, 10**7)))
    given["gamma"] = decimal(ADMITTED) * data["z_weight"]
    conditions = [
        c.thm1_iii,
        c.tied_n2,
        c.output_coupling,
        c.trace_below,
        c.definite,
        condition(c.brl_fixed, rename={"X": "X_inf"}),
        condition(c.definite, "X_inf_definite", rename={"X": "X_inf"}),
    ]
    variables = {"X": symmetric(6), "Q": full(6, 6), "N2": full(6, 6), "Z": symmetric(3), "X_inf": symmetric(6)}
    problem = problems.problem(f"tied-separate-{gain}", case, variables, conditions, given)
    point = point | {"X_inf": _x_of_brl(data, gain, BACKED_OFF)}
    return prove_feasible(problem, point, says=f"(26) with N2 tied and (8) with an X of its own hold for K_{gain}")


def tied_separate_ext(data: Any) -> dict[str, Any]:
    """Theorem 2 with N2 tied and two Lyapunov matrices is correct and holds for K_ext; as a synthesis it is
    bilinear."""
    return _tied_separate(data, "ext")


def tied_separate_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _tied_separate(data, "trad")


def _lemmas(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    X = _x_of_brl(data, gain, BACKED_OFF)
    Z = si["C2"] @ X @ si["C2"].T * SLACK
    gamma = decimal(ADMITTED) * data["z_weight"]
    given = pick(si, "A B1 B2 C1 C2 D1 D2 K", gamma=gamma, rho=np.trace(Z) * SLACK, factor=fmpq(1))
    conditions = [c.brl, c.h2_lyapunov, c.h2_output, c.trace_below, c.definite, c.tied_gain]
    problem = problems.problem(
        f"lemmas-{gain}", case, {"X": symmetric(6), "W": full(3, 6), "Z": symmetric(3)}, conditions, given
    )
    point = {"X": X, "W": si["K"] @ X, "Z": Z}
    return prove_feasible(problem, point, says=f"Lemmas 1 and 2 hold with one X and W = Q for K_{gain} and this rho")


def lemmas_ext(data: Any) -> dict[str, Any]:
    """K_ext satisfies the traditional LMIs too."""
    return _lemmas(data, "ext")


def lemmas_trad(data: Any) -> dict[str, Any]:
    """K_trad satisfies the traditional LMIs."""
    return _lemmas(data, "trad")


def _lemma2(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    X = _h2_gramian(data, plant.closed_loop(si, si["K"]), si["B2"] @ si["B2"].T, gain, covariance=True)
    Z = si["C2"] @ X @ si["C2"].T * (1 + fmpq(1, 10**7))
    given = pick(si, "A B1 B2 C2 K", rho=np.trace(Z) * (1 + fmpq(1, 10**7)), factor=fmpq(1))
    conditions = [c.h2_lyapunov, c.h2_output, c.trace_below, c.definite, c.tied_gain]
    variables = {"X": symmetric(6), "W": full(3, 6), "Z": symmetric(3)}
    problem = problems.problem(f"lemma2-{gain}", case, variables, conditions, given)
    point = {"X": X, "W": si["K"] @ X, "Z": Z}
    return prove_feasible(problem, point, says=f"(9) holds for K_{gain} with this rho, just above the squared H2 norm")


def lemma2_ext(data: Any) -> dict[str, Any]:
    """(9) at K_ext, rho within 1e-6 of the squared H2 norm."""
    return _lemma2(data, "ext")


def lemma2_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _lemma2(data, "trad")


TIGHT = {"ext": ("1.0000378438", "1.00003784375"), "trad": ("1.0000000022", "1.00000000215")}
"""g just above the scaled H-infinity norm of the loop (1.0000378437..., 1.0000000021114...), and a smaller one."""


def _brl(data: Any, gain: str) -> dict[str, Any]:
    case, si = _si(data, gain)
    level, inner = TIGHT[gain]
    X = _x_of_brl(data, gain, inner, decimals=40, extra=12, bits=240)
    given = pick(si, "A B1 B2 C1 D1 D2 K", gamma=decimal(level) * data["z_weight"])
    problem = problems.problem(f"brl-{gain}", case, {"X": symmetric(6)}, [c.brl_fixed, c.definite], given)
    return prove_feasible(problem, {"X": X}, says=f"(8) holds for K_{gain} just above the H-infinity norm of its loop")


def brl_ext(data: Any) -> dict[str, Any]:
    """(8) just above the H-infinity norm of the loop with K_ext."""
    return _brl(data, "ext")


def brl_trad(data: Any) -> dict[str, Any]:
    """The same for K_trad."""
    return _brl(data, "trad")
