"""Which observer gains in the rounding box have the poles (40) exactly, in ball arithmetic.

With L = [L1; L2] and A = [0 I; A21 A22], A - LC has the eigenvalue s iff the 3 x 3 determinant d(s) = det[(sI - A22)
(sI + L1) + L2 - A21] vanishes. The 6 x 6 characteristic polynomial is too wide in balls and refutes nothing.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import acb, acb_mat, arb, arb_mat, fmpq

from recontrol.exact import ball, rational

Array = np.ndarray
PLACES = [(i, j) for i in range(6) for j in range(3)]
RADIUS = fmpq(1, 10**9)


def exact_poles(data: Any) -> list[acb]:
    """The three poles (40) above the axis, as exact balls."""
    return [acb(arb(p.real.value), arb(p.imag.value)) for p in data.printed("poles").rows[0]]


class Characteristic:
    """d(s) and its gradient in the 18 entries of L, for rational A (6, 6)."""

    def __init__(self, A: Array):
        self.A21, self.A22 = A[3:, :3], A[3:, 3:]

    def _parts(self, L: Array, s: acb) -> tuple[list[list[acb]], acb_mat]:
        shift = [[(s if i == j else acb(0)) - acb(arb(self.A22[i, j])) for j in range(3)] for i in range(3)]
        upper = [[(s if i == j else acb(0)) + acb(arb(L[i, j])) for j in range(3)] for i in range(3)]
        lower = [[acb(arb(L[3 + i, j])) - acb(arb(self.A21[i, j])) for j in range(3)] for i in range(3)]
        return shift, acb_mat(shift) * acb_mat(upper) + acb_mat(lower)

    def value(self, L: Array, s: acb) -> acb:
        """d(s)."""
        return self._parts(L, s)[1].det()

    def gradient(self, L: Array, s: acb) -> list[acb]:
        """Derivatives of d(s) by L, in the order of PLACES, from the cofactors."""
        shift, M = self._parts(L, s)
        C = [[_cofactor(M, i, j) for j in range(3)] for i in range(3)]
        upper = [sum((shift[k][i] * C[k][j] for k in range(3)), acb(0)) for i in range(3) for j in range(3)]
        return upper + [C[i][j] for i in range(3) for j in range(3)]

    def equations(self, L: Array, poles: list[acb]) -> list[arb]:
        """Real and imaginary parts of d at the poles: six equations."""
        return [part for s in poles for d in (self.value(L, s),) for part in (d.real, d.imag)]

    def jacobian(self, L: Array, poles: list[acb]) -> list[list[arb]]:
        """Derivatives (6, 18) of `equations`."""
        rows = []
        for s in poles:
            g = self.gradient(L, s)
            rows += [[x.real for x in g], [x.imag for x in g]]
        return rows


def _cofactor(M: acb_mat, i: int, j: int) -> acb:
    r, c = [k for k in range(3) if k != i], [k for k in range(3) if k != j]
    return (M[r[0], c[0]] * M[r[1], c[1]] - M[r[0], c[1]] * M[r[1], c[0]]) * (-1) ** (i + j)


def _floats(rows: Any) -> Array:
    return np.array([[float(x) for x in row] for row in rows])


def nearest(data: Any, A: Array, L: Array, half: Array, *, free: tuple[int, int] | None = None) -> tuple[float, Array]:
    """Smallest common multiple of all half units (the free entry aside) that admits the poles, and L there (float)."""
    from scipy.optimize import linprog

    d, poles = Characteristic(A), exact_poles(data)
    mid, h = rational.to_float(L).ravel(), rational.to_float(half).ravel()
    bound = np.array([0.0 if free == place else 1.0 for place in PLACES])
    x, multiple = mid.copy(), np.inf
    for _ in range(12):
        exact = rational.from_float(x.reshape(6, 3))
        f, J = np.array([float(v) for v in d.equations(exact, poles)]), _floats(d.jacobian(exact, poles))
        # Unknowns: displacement in half units, and the multiple t >= their moduli.
        rows = [(np.eye(18)[k] * sign, bound[k]) for k in range(18) for sign in (1, -1) if bound[k]]
        A_ub = np.array([[*row, -1.0] for row, _ in rows])
        scaled = J * h[None, :]
        size = np.abs(scaled).max()
        found = linprog(
            [0.0] * 18 + [1.0], A_ub, np.zeros(len(rows)), np.hstack([scaled, np.zeros((6, 1))]) / size,
            (J @ (x - mid) - f) / size, bounds=[(None, None)] * 18 + [(0, None)], method="highs",
        )  # fmt: skip
        x, multiple = mid + h * found.x[:18], float(found.x[18])
    return multiple, x.reshape(6, 3)


def range_of_entry(
    data: Any, A: Array, L: Array, half: Array, place: tuple[int, int], *, largest: bool, within: float
) -> Array:
    """L (6, 3) with the poles, one entry extreme, the others within a multiple of their half units."""
    from scipy.optimize import linprog

    d, poles = Characteristic(A), exact_poles(data)
    mid, h = rational.to_float(L).ravel(), rational.to_float(half).ravel()
    index, x = PLACES.index(place), nearest(data, A, L, half, free=place)[1].ravel()
    for _ in range(8):
        exact = rational.from_float(x.reshape(6, 3))
        f, J = np.array([float(v) for v in d.equations(exact, poles)]), _floats(d.jacobian(exact, poles))
        bounds: list[Any] = [(-within, within)] * 18
        bounds[index] = (None, None)
        goal = np.zeros(18)
        goal[index] = -1.0 if largest else 1.0
        scaled = J * h[None, :]
        size = np.abs(scaled).max()
        found = linprog(goal, A_eq=scaled / size, b_eq=(J @ (x - mid) - f) / size, bounds=bounds, method="highs")
        x = mid + h * found.x
    return x.reshape(6, 3)


def excluded(data: Any, A: Array, box: Array) -> dict[str, arb]:
    """Lower bounds of abs(d(s)) over the box of L at the three poles: one above zero excludes the box."""
    d = Characteristic(A)
    return {f"pole {k + 1}": arb(d.value(box, s).abs_lower()) for k, s in enumerate(exact_poles(data))}


def krawczyk(
    data: Any, A: Array, L: Array, fixed: tuple[int, int] | None = None
) -> tuple[bool, list[tuple[int, int]], Array]:
    """Existence of an exact placement within 1e-9 of the rational L in six entries, the other twelve kept.

    Returns whether the Krawczyk operator maps the box into its interior, the entries moved, and the box.
    """
    from scipy.linalg import qr

    d, poles = Characteristic(A), exact_poles(data)
    J = _floats(d.jacobian(L, poles))
    weight = np.array([0.0 if place == fixed else 1.0 for place in PLACES])
    columns = list(qr(J * weight, pivoting=True)[2][:6])
    box = ball.to_ball(L)
    for k in columns:
        box[PLACES[k]] = ball.ball(L[PLACES[k]], RADIUS)
    inverse = arb_mat([[arb(float(x)) for x in row] for row in np.linalg.inv(J[:, columns])])
    there = d.jacobian(box, poles)
    slope = inverse * arb_mat([[row[k] for k in columns] for row in there])
    step = inverse * arb_mat([[f] for f in d.equations(ball.to_ball(L), poles)])
    radius = arb(RADIUS)
    spread = (arb_mat([[int(i == j) for j in range(6)] for i in range(6)]) - slope) * arb_mat([[arb(0, radius)]] * 6)
    inside = all(bool(abs(spread[i, 0] - step[i, 0]) < radius) for i in range(6))
    return inside, [PLACES[k] for k in columns], box


def freed(data: Any, A: Array, L: Array, half: Array, place: tuple[int, int]) -> list[acb]:
    """Values of one entry, the others in their boxes, at which d vanishes at each pole (d is affine in it).

    A common real value must exist for a placement: disjoint enclosures exclude it. Diagonal entries of L1 are bounded
    by the trace, which the poles fix, and then d itself is tried over the box.
    """
    d, poles = Characteristic(A), exact_poles(data)
    at_zero = ball.box(L, half)
    at_zero[place] = arb(0)
    index = PLACES.index(place)
    return [-d.value(at_zero, s) / d.gradient(at_zero, s)[index] for s in poles]


def single_entry_repairs(data: Any, A: Array, L: Array, half: Array) -> dict[str, bool | None]:
    """For each other entry set free: False if no value gives the poles while the rest stays in its box."""
    trace = -2 * sum((p.real.value for p in data.printed("poles").rows[0]), fmpq(0))
    d, found = Characteristic(A), {}
    for i, j in PLACES:
        if (i, j) == (1, 0):
            continue
        values = freed(data, A, L, half, (i, j))
        real = all(v.imag.contains(0) for v in values)
        common = all(a.real.overlaps(b.real) for a in values for b in values)
        out = not (real and common)
        if not out and i == j:
            box = ball.box(L, half)
            rest = sum((box[k, k] for k in range(3) if k != i), arb(0))
            box[i, i] = arb(trace) - rest
            out = any(not d.value(box, s).contains(0) for s in exact_poles(data))
        found[f"{i + 1},{j + 1}"] = False if out else None
    return found
