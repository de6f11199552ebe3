"""The matrix inequalities of this paper's analysis, each written once.

The paper prints none. States, input and time are left in the paper's own units, all of order one; the smallest number
is the pitch coefficient 7.1138e-3. Stability of a loop and of a rounding box: `recontrol.lmi.loops`.
"""

from __future__ import annotations

from typing import Any

from recontrol.lmi.blocks import block, he, nonnegative, positive, trace


@nonnegative
def lqr(P: Any, A: Any, B: Any, Q: Any, R: Any) -> Any:
    """[A'P + PA + Q, PB; B'P, R] >= 0: P (n, n) underestimates the optimal cost x'Px of (17)."""
    return block([[he(P @ A) + Q, P @ B], [R]])


def cost(P: Any) -> Any:
    """tr P, maximised over `lqr`: the optimal cost summed over the unit initial states."""
    return trace(P)


@positive
def third_weight_is_negative(K: Any, a: Any) -> Any:
    """-q3 > 0 for the only diagonal Q that can give K (1, 4) with R = 1; a (1, 4) is the first row of A.

    In controller form p(s)p(-s) - a(s)a(-s) = sum q_i (-1)^(n-i) s^(2(n-i)), which has -q3 at s^2: 2 p2 p0 - p1^2 less
    the same of a(s).
    """
    p = K - a
    return (
        2 * (p[0:1, 1:2] @ p[0:1, 3:4] - a[0:1, 1:2] @ a[0:1, 3:4])
        - p[0:1, 2:3] @ p[0:1, 2:3]
        + a[0:1, 2:3] @ a[0:1, 2:3]
    )
