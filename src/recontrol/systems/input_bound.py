r"""Bounds on the input of a linear loop from an invariant ellipsoid.

If P > 0 decreases along ``x' = A x`` and covers K, then ``|K x(t)|^2 <= x(t)' P x(t) <= x0' P x0`` for all t >= 0.

Source: Boyd, El Ghaoui, Feron, Balakrishnan, LMIs in System and Control Theory, 1994, section 7.2.3.
"""

from __future__ import annotations

from typing import Any

from recontrol.lmi.blocks import he, nonnegative, nonpositive


@nonpositive
def decay(P: Any, *, A: Any) -> Any:
    """``P A + A' P <= 0``."""
    return he(P @ A)


@nonnegative
def covers(P: Any, *, K: Any) -> Any:
    """``P >= K' K``."""
    return P - K.T @ K


def level(P: Any, x0: Any) -> Any:
    """``x0' P x0``, the bound of the squared input; x0 (n, 1)."""
    return x0.T @ P @ x0
