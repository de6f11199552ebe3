r"""Robust analysis with diagonal scalings: ``p = Delta q``, Delta diagonal, ``|Delta| <= 1``, around a linear loop.

.. math::  \dot x = A x + B_p p + B d, \quad q = C_q x + D_q p + D_d d, \quad y = C x

One P and one diagonal multiplier that satisfy an inequality below prove it for every such Delta; the H-infinity bound
holds for arbitrarily fast time variation, the disk bound for frozen parameters. Matrices are floats or exact.

Source: Boyd, El Ghaoui, Feron, Balakrishnan, LMIs in System and Control Theory, 1994, sections 5.1 and 8.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from recontrol.lmi.blocks import block, eye, grid, he, negative
from recontrol.systems.generic import zeros
from recontrol.systems.output_feedback import Controller

Array = Any  # arrays of floats, or of rationals


class Channels(NamedTuple):
    """Uncertain terms of a loop: Bp (n, k), Cq (k, n), Dq (k, k), Dd (k, m)."""

    Bp: Array
    Cq: Array
    Dq: Array
    Dd: Array


def gain_drift(B: Array, C: Array, controller: Controller, bound: Any) -> list[tuple[Array, Array]]:
    """Multiplicative drift of a controller: columns of A_f, columns of B_f, rows of C_f, each within ``bound``.

    Pairs (input (n + n_f, k), output (k, n + n_f)) for a plant with input B (n, n_u) and output C (n_y, n).
    """
    n, n_f = len(B), len(controller.A)
    above, below = zeros(B, n, n_f), zeros(B, n_f, B.shape[1])
    one = zeros(controller.A, n_f, n_f)
    for i in range(n_f):
        one[i, i] += 1
    return [
        (np.vstack([above, controller.A]), np.hstack([above.T, one]) * bound),
        (np.vstack([zeros(B, n, C.shape[0]), controller.B]), np.hstack([C, zeros(C, C.shape[0], n_f)]) * bound),
        (np.vstack([B, below]), np.hstack([zeros(B, B.shape[1], n), controller.C]) * bound),
    ]


def norm_bounded(L: Array, K: Array, order: int) -> tuple[Array, Array]:
    """Pair of ``Delta A = L Delta K`` on the first states of a loop of that order, without its zero columns.

    L (n, k) and K (k, n) are exact. Column i is balanced by the power of two nearest to ``sqrt(|K_i| / |L_i|)``.
    """
    from recontrol.exact.rational import to_float
    from recontrol.lmi.scaling import power_of_two

    left, right = np.linalg.norm(to_float(L), axis=0), np.linalg.norm(to_float(K), axis=1)
    keep = np.flatnonzero((left > 0) & (right > 0))
    s = np.array([power_of_two(float(np.sqrt(right[i] / left[i]))) for i in keep], dtype=object)
    n, k = len(L), len(keep)
    inputs = np.vstack([L[:, keep] * s, zeros(L, order - n, k)])
    return inputs, np.hstack([K[keep] / s[:, None], zeros(K, k, order - n)])


def channels(pairs: Sequence[tuple[Array, Array]], inputs: int) -> Channels:
    """Channels without feed-through; ``inputs`` is the number of disturbances."""
    Bp, Cq = np.hstack([b for b, _ in pairs]), np.vstack([c for _, c in pairs])
    k = len(Cq)
    return Channels(Bp, Cq, zeros(Bp, k, k), zeros(Bp, k, inputs))


def with_derivative(known: Channels, A: Array, B: Array, E: Array, W: Array) -> Channels:
    """Channels and one more, ``x' = ... + E Delta W x'``: its output sees every other input of the derivative.

    A (n, n), B (n, m) of the loop, E (n, k), W (k, n).
    """
    Bp = np.hstack([known.Bp, E])
    k, m = len(known.Cq), len(W)
    Dq = np.vstack([np.hstack([known.Dq, zeros(Bp, k, m)]), W @ Bp])
    return Channels(Bp, np.vstack([known.Cq, W @ A]), Dq, np.vstack([known.Dd, W @ B]))


@negative
def scaled_hinf(P: Any, Lam: Any, gamma2: Any, *, A: Any, Bp: Any, B: Any, C: Any, Cq: Any, Dq: Any, Dd: Any) -> Any:
    """D-scaled bounded-real inequality: ``||y|| < gamma ||d||`` for every Delta; Lam (k, k) diagonal."""
    G = grid([[Cq, Dq, Dd]])
    core = block([[he(P @ A) + C.T @ C, P @ Bp, P @ B], [-Lam, 0], [-gamma2 * eye(B.shape[1])]])
    return core + G.T @ Lam @ G


@negative
def scaled_disk(P: Any, Lam: Any, *, A: Any, Bp: Any, Cq: Any, Dq: Any, a: Any, b: Any) -> Any:
    """D-scaled disk inequality: poles of A + Bp Delta (I - Dq Delta)^-1 Cq in D(a, b) for every Delta."""
    T, G = grid([[A + a * eye(A.shape[0]), Bp]]), grid([[Cq, Dq]])
    return (T.T @ P @ T) / (b * b) - block([[P, 0], [Lam]]) + G.T @ Lam @ G
