"""The findings."""

import numpy as np

from recontrol.claims.values import Approx, Statement, certified
from recontrol.exact.ball import ball
from recontrol.systems.norms import hinf_norm

from .conditions import loop

RICCATI = 1e-9
"""The Riccati solver's residuals are 1e-14 and the problem is well conditioned: a wide bound on the entries."""


def controller_A(synthesis):
    """A_k of the central controller."""
    return Approx(synthesis["central"]["A_k"], RICCATI)


def turned_A(synthesis):
    """The same with the sign of entry (2,2) turned."""
    return Approx(synthesis["central"]["A_k"] * np.array([[1, 1], [1, -1]]), RICCATI)


def controller_B(synthesis):
    """B_k of the central controller."""
    return Approx(synthesis["central"]["B_k"], RICCATI)


def controller_C(synthesis):
    """C_k of the central controller."""
    return Approx(synthesis["central"]["C_k"], RICCATI)


def enclosed_norm(data):
    """H-infinity norm of the loop with the mended controller, enclosed."""
    M = loop(data, data["A_k_mended"])
    zero = np.array([[0 * M[0, 0]] * 2] * 2, dtype=object)
    B = np.vstack([data["B1"], data["B_k"] @ data["D21"]])
    C = np.hstack([data["C1"], data["D12"] @ data["C_k"]])
    return hinf_norm(M, B, C, zero)


def loop_norm(data):
    """Its enclosure as one ball."""
    found = enclosed_norm(data)
    return ball(found.upper)


def printed_stable(certificates):
    """Refuted by a certificate of instability."""
    found = certified(certificates["unstable"])
    return Statement({"no certificate of instability": -1 if found.holds else 0})


def mended_stable(certificates):
    """Proven by a Lyapunov matrix."""
    return certified(certificates["loop"])


def settled(simulation):
    """Two per cent less the largest share of the peak after 10 s."""
    return Statement({"room": Approx(0.02 - simulation["impulse"]["values"]["late share of the peak"], 1e-9)})
