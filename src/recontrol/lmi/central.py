"""Multipliers near the optimum but well inside the cone: Newton steps along the central path of the dual, in floats.

A solver ends where multipliers are definite by less than its own error, and no rounding survives that. From a start
inside the cone these steps minimise sum <Z, M_0> - t log det Z over the equations; at the end of the path the bound is
worse than the best one by t times the order, and Z stays inside by as much. Each step is taken in the metric of Z, by
one QR factorisation, so the equations hold to rounding.

Source: Boyd and Vandenberghe, Convex Optimization, section 11.5.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from recontrol.lmi.duality import FloatForm
from recontrol.lmi.repair import shortest

# Newton steps between two points of the path; a dozen is usual, more means that rounding has the upper hand.
STEPS = 25


def blend(form: FloatForm, Z: Mapping[str, np.ndarray], interior: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """A well-centred start from multipliers of the bound and interior ones, which meet the equations up to a factor."""
    products = sum(form.coefficients[n].T @ M.ravel() for n, M in interior.items())
    factor = float(products @ form.costs) / max(float(form.costs @ form.costs), 1e-300)
    share = 1.0 / factor if factor > 0 else 1.0 / (abs(factor) + 1e-3)
    return {n: (1.0 - share * factor) * Z[n] + share * interior[n] for n in Z if n in interior}


def path(
    form: FloatForm, start: Mapping[str, np.ndarray], equations: list[int], gap: float, size: float
) -> Iterator[tuple[float, dict[str, np.ndarray]]]:
    """Points of the central path, each ten times nearer to the best bound than the last, until ``gap`` (scaled units).

    Yields by how much the bound may be worse, and the multipliers; stops early where the steps stall. ``start``:
    definite multipliers that meet the equations; ``size``: of the bound. Conditions that are equalities are free.
    """
    names = [n for n, M in start.items() if M.size]
    F = {n: form.coefficients[n][:, equations].toarray().T.reshape(len(equations), *start[n].shape) for n in names}
    order = sum(len(start[n]) for n in names if n not in form.equalities)
    Z, t = dict(start), 10 * max(size, abs(value(form, start))) / order
    taken = 0
    while taken < STEPS:
        roots = {n: (np.eye(len(Z[n])), np.eye(Z[n].shape[1])) if n in form.equalities else _root(Z[n]) for n in names}
        if any(not np.isfinite(L).all() for pair in roots.values() for L in pair):
            return
        step, length = _newton(form, F, Z, roots, equations, t, names)
        damping = 1.0 if length < 0.25 else _damping(form, roots, step, t)
        Z = {n: Z[n] + damping * (roots[n][0] @ step[n] @ roots[n][1].T) for n in names}
        taken += 1
        if length < 0.25:
            yield t * order, Z
            if t <= gap / order:
                return
            t, taken = t * 0.1, 0


def _newton(
    form: FloatForm,
    F: Mapping[str, np.ndarray],
    Z: Mapping[str, np.ndarray],
    roots: Mapping[str, tuple[np.ndarray, np.ndarray]],
    equations: list[int],
    t: float,
    names: list[str],
) -> tuple[dict[str, np.ndarray], float]:
    """Direction Y of Z + L Y L' and its length, the Newton decrement."""
    residual = form.costs[equations] - sum(np.einsum("kij,ij->k", F[n], Z[n]) for n in names)
    rows = np.hstack([(roots[n][0].T @ F[n] @ roots[n][1]).reshape(len(equations), -1) for n in names])
    free = np.concatenate([_pull(form, n, roots[n], t).ravel() for n in names])
    short, Q = shortest(rows, residual)
    flat = free - Q @ (Q.T @ free) + short
    step, start = {}, 0
    for n in names:
        Y = flat[start : start + Z[n].size].reshape(Z[n].shape)
        start += Z[n].size
        step[n] = Y if n in form.equalities else (Y + Y.T) / 2
    return step, float(np.sqrt(sum(np.sum(Y * Y) for n, Y in step.items() if n not in form.equalities)))


def _damping(
    form: FloatForm, roots: Mapping[str, tuple[np.ndarray, np.ndarray]], step: Mapping[str, np.ndarray], t: float
) -> float:
    """Share of a step that lowers the barrier function most, on a grid inside the cone."""
    inner = [n for n in step if n not in form.equalities]
    slope = sum(float(np.sum((roots[n][0].T @ form.constants[n] @ roots[n][1]) * Y)) for n, Y in step.items()) / t
    values = np.concatenate([np.linalg.eigvalsh(step[n]) for n in inner])
    longest = min(1.0, 0.95 / max(-float(values.min()), 1e-300))
    shares = longest * 0.8 ** np.arange(20)
    return float(min(shares, key=lambda a: a * slope - np.sum(np.log1p(a * values))))


def _pull(form: FloatForm, name: str, root: tuple[np.ndarray, np.ndarray], t: float) -> np.ndarray:
    """Minus the gradient of the barrier function in the metric of Z."""
    C = form.constants[name]
    return -C / t if name in form.equalities else np.eye(len(C)) - root[0].T @ C @ root[1] / t


def value(form: FloatForm, Z: Mapping[str, np.ndarray]) -> float:
    """Sum of <Z, M_0>: minus the bound that the multipliers give, without boxes."""
    return float(sum(np.sum(form.constants[n] * M) for n, M in Z.items()))


def _root(Z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    values, vectors = np.linalg.eigh((Z + Z.T) / 2)
    L = vectors * np.sqrt(values) if values[0] > 0 else np.full_like(Z, np.nan)
    return L, L
