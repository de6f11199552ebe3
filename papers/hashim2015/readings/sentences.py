"""Sentences of section 2.4 that say of a substitution or a name what its formulas do not."""

from __future__ import annotations

import numpy as np

from recontrol.claims.values import Result

from ..symbols import equal, stack, symbols
from .formulas import (
    compensator_rate,
    control,
    corrected_A_r,
    corrected_B_r,
    output_rate,
    reduced_estimator,
    reduced_state,
    state,
)
from .misprints import ORDER, misprint


def s24_x1dot() -> Result:
    """x1' = y together with (28), x1 = y: the first row of (4) is not x1."""
    s = symbols(ORDER)
    rate = output_rate(s, s.x[1:], s.x[:1], s.u)
    return misprint(s.x[:1], state(s, s.x, s.u)[:1], r"$\dot x_1 = \dot y$, which (30) has", rate, "not used")


def s24_swap() -> Result:
    """Estimate less state, with (29) and (37) in the roles that the sentence gives them, against the error of (38)."""
    s = symbols(ORDER)
    dy = output_rate(s, s.x2, s.y, s.u)
    named_state, named_estimate = reduced_estimator(s, dy), reduced_state(s, s.x2, s.y, s.u)
    derived = (s.A22 - s.L_r @ s.A12) @ (s.x2 - s.xh2)
    return misprint(
        named_state - named_estimate,
        derived,
        "(29) is the state and (37) the estimate",
        named_estimate - named_state,
        "not used",
    )


def s24_subst() -> Result:
    """u of (43) put into (4), rows of x2, against the compensator's rate; put into (42) it gives (44)."""
    s = symbols(ORDER)
    u = control(s, s.xc + s.L_r @ s.y)
    derived = corrected_A_r(s) @ s.xc + corrected_B_r(s) @ s.y
    return misprint(
        state(s, stack(s.y, s.x2), u)[1:],
        derived,
        "the substitution goes into (42)",
        compensator_rate(s),
        "the right version: (66), (67) are (42) with (43)",
    )


def s24_names() -> Result:
    """x_c of (44) has the rate of x_3 of (41): one state. x_b of (43) taken for the same one contradicts (49).

    K2 x_b in (43) gives D_r = -K1 - K2 L only if x_b is the estimate xh2 = x_3 + L y.
    """
    s = symbols(ORDER)
    one_state = -s.K1 @ s.y - s.K2 @ s.xc
    derived = -s.K2 @ s.xc + (-s.K1 - s.K2 @ s.L_r) @ s.y
    return misprint(
        one_state,
        derived,
        r"$x_c = x_3 = \hat x_2 - L y$, while $x_b = \hat x_2$",
        control(s, s.xc + s.L_r @ s.y),
        "the right version: (69) is -K1 - K2 L",
        **{"x_c and x_3 have one rate": equal(compensator_rate(s), derived_rate())},
    )


def derived_rate() -> np.ndarray:
    """A_r xc + B_r y."""
    s = symbols(ORDER)
    return corrected_A_r(s) @ s.xc + corrected_B_r(s) @ s.y
