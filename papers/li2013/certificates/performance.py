"""(55): what the loop's equilibrium forbids, what the printed blocks allow, and what holds for d alone."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational
from recontrol.lmi.proof import prove_infeasible

from .. import conditions as c
from .. import problems as pr
from ..points import prove, with_start
from ..synthesis.points import BOTH


def _equilibrium(data: Any, weight: str) -> dict[str, Any]:
    """xi = xi(t_k) = xi_ss, xi' = 0, d = 0, y_r, z: all terms in P, T, S vanish, |z|^2 - gamma^2 |y_r|^2 remains."""
    case = f"weight={weight} channel=both"
    exact, y_r = pr.exact_data(data, case), data["y_r"].T
    listed = [*pr.performance_conditions(BOTH, c.DERIVED), *pr.definite_conditions()]
    problem = pr.problem(data, f"equilibrium-{weight}", case, listed)
    xi = pr.equilibrium(exact, "A_print", y_r)
    zeta = np.vstack([xi, xi * 0, xi, rational.zeros(3, 1), y_r, exact["C2"] @ xi])
    says = f"derived (55) with y_r has no solution at the printed level, weight {weight}"
    return prove_infeasible(problem, multipliers={"performance[w-print]": zeta @ zeta.T}, says=says)


def equilibrium_square(data: Any) -> dict[str, Any]:
    """Derived (55), d_bar = [d; y_r], gamma^2 = 0.4^2."""
    return _equilibrium(data, "square")


def equilibrium_linear(data: Any) -> dict[str, Any]:
    """Derived (55), d_bar = [d; y_r], weight 0.4 as in (54)."""
    return _equilibrium(data, "linear")


def pair_vectors(h: fmpq, states: int = 9, inputs: int = 6, outputs: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Two columns that contradict the printed (55) for gamma <= 4 h / 5, for every gain and orbital rate.

    Both live on one integral axis: (xi, xi', xi(t_k), d_bar, z) = (1, -5/2h, 0, 5/2h, 1) in the first matrix and
    (xi, xi', xi(t_k), phi, d_bar, z) = (2, 5/4h, 0, 5/2h, -5/4h, 2) in the second.
    """
    e, y, z = states - 3, inputs - 3, 0
    first, second = (rational.zeros(k * states + inputs + outputs, 1) for k in (3, 4))
    rate = fmpq(5, 2) / h
    for column, blocks, xi, slope in ((first, 3, fmpq(1), -rate), (second, 4, fmpq(2), rate / 2)):
        column[e, 0] = xi
        column[states + e, 0] = slope
        column[blocks * states + y, 0] = -slope
        column[blocks * states + inputs + z, 0] = xi
    second[3 * states + e, 0] = rate
    return first, second


def pair_square(data: Any) -> dict[str, Any]:
    """Printed (55), d_bar = [d; y_r], gamma^2 = 0.4^2: the pair gives a contradiction, on the very boundary."""
    case = "weight=square channel=both"
    listed = [*pr.performance_conditions(("w-print",), c.PRINTED), *pr.definite_conditions()]
    problem = pr.problem(data, "pair-square", case, listed)
    first, second = pair_vectors(data["h"])
    multipliers = {
        "performance[w-print]": first @ first.T,
        "performance_hat[w-print]": second @ second.T,
    }
    says = "printed (55) with y_r has no solution at gamma = 4 h / 5"
    return prove_infeasible(problem, multipliers=multipliers, says=says)


def d_only(data: Any, synthesis: Any) -> dict[str, Any]:
    """Derived (21), (22), (55) without y_r at gamma = 0.4 (square), both orbits; (21) at alpha = 0.02 and so at 0."""
    stored = synthesis["points"]["d-only"]
    listed = [
        *pr.decay_conditions(BOTH, c.DERIVED),
        *pr.performance_conditions(BOTH, c.DERIVED),
        *pr.definite_conditions(),
        *pr.thrust_conditions("all"),
    ]
    says = "derived (21), (22) and (55) for the disturbance alone hold at gamma = 0.4"
    return prove(data, "d-only", stored["case"], listed, stored["point"], says)


def _linear(data: Any, synthesis: Any, name: str) -> dict[str, Any]:
    stored = synthesis["points"][name]
    listed = [*with_start(BOTH, c.PRINTED), *pr.performance_conditions(BOTH, c.PRINTED)]
    says = "printed (21), (22), (47), (55) with weight 0.4 hold with V(0) equal to the print"
    return prove(data, name, stored["case"], listed, stored["point"], says)


def linear_K(data: Any, synthesis: Any) -> dict[str, Any]:
    """All printed conditions with the weight of (54), published gain: the reading that admits section 4."""
    return _linear(data, synthesis, "linear-K")


def linear_minus(data: Any, synthesis: Any) -> dict[str, Any]:
    """The same for the gain with the wrong sign."""
    return _linear(data, synthesis, "linear-minus")
