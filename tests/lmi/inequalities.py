"""Conditions that several tests share, written as a paper's conditions.py would."""

from __future__ import annotations

from recontrol.lmi.blocks import block, eye, he, negative, nonnegative, positive, trace


@positive
def positive_P(P):
    return P


@negative
def lyapunov(P, A):
    return he(P @ A)


@negative
def lyapunov_with(P, A, Q):
    return he(P @ A) + Q


@negative
def bounded_real(P, gamma2, A, B, C):
    return block([[he(P @ A) + C.T @ C, P @ B], [-gamma2 * eye(B.shape[1])]])


@negative
def gramian(X, A, B):
    return he(A @ X) + B @ B.T


@nonnegative
def riccati(P, A, B, Q, R):
    return block([[he(P @ A) + Q, P @ B], [R]])


def squared_gain(gamma2):
    return gamma2


def output_power(X, C):
    return trace(C @ X @ C.T)


def trace_of_P(P):
    return trace(P)
