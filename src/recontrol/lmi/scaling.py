"""Units: congruence there and back, so that a solver sees numbers of order one and a proof the original ones.

Units come from a paper's own data, never from its answers. All of them are rationals: a witness that was rounded in
scaled units is exact in the original ones. Square roots are avoided by choosing rational units.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational


def _factors(unit: Any, n: int, what: str) -> list[fmpq]:
    """``n`` positive rationals from one scalar (int, decimal text, fmpq) or a sequence of ``n``."""
    if isinstance(unit, np.ndarray):
        unit = list(unit.flat)
    if not isinstance(unit, (list, tuple)):
        unit = [unit] * n
    if len(unit) != n:
        raise ValueError(f"{what}: expected {n} units, found {len(unit)}")
    factors = [rational.rational(u) for u in unit]
    if any(f <= 0 for f in factors):
        raise ValueError(f"{what}: units must be positive, found {[str(f) for f in factors]}")
    return factors


def _weights(rows: list[fmpq], columns: list[fmpq], M: np.ndarray) -> np.ndarray:
    """Outer product of the factors, in the kind of ``M`` (float or exact)."""
    exact = np.array([[r * c for c in columns] for r in rows], dtype=object).reshape(len(rows), len(columns))
    return rational.to_float(exact) if M.dtype != object else exact


@dataclass(frozen=True)
class Units:
    """Units of a state-space problem: x = diag(state) x_s, u = diag(input) u_s, y = diag(output) y_s, t = time t_s.

    Each method takes a matrix in original units (float, exact or ball) and returns the one in scaled units; with
    ``back=True`` the other way. Units are int, decimal text or fmpq: a scalar, or one for each component.
    """

    state: Any = 1
    input: Any = 1
    output: Any = 1
    time: Any = 1

    def _apply(
        self, M: np.ndarray, left: tuple[Any, int], right: tuple[Any, int], power: int, back: bool
    ) -> np.ndarray:
        rows = [f ** left[1] for f in _factors(left[0], M.shape[0], "rows")]
        columns = [f ** right[1] for f in _factors(right[0], M.shape[1], "columns")]
        factor = rational.rational(self.time) ** power
        if back:
            rows, columns, factor = [1 / f for f in rows], [1 / f for f in columns], 1 / factor
        return M * _weights([f * factor for f in rows], columns, M)

    def dynamics(self, A: np.ndarray, *, back: bool = False) -> np.ndarray:
        """A (n_x, n_x) of x' = A x."""
        return self._apply(A, (self.state, -1), (self.state, 1), 1, back)

    def inputs(self, B: np.ndarray, *, back: bool = False) -> np.ndarray:
        """B (n_x, n_u) of x' = B u."""
        return self._apply(B, (self.state, -1), (self.input, 1), 1, back)

    def outputs(self, C: np.ndarray, *, back: bool = False) -> np.ndarray:
        """C (n_y, n_x) of y = C x."""
        return self._apply(C, (self.output, -1), (self.state, 1), 0, back)

    def feedthrough(self, D: np.ndarray, *, back: bool = False) -> np.ndarray:
        """D (n_y, n_u) of y = D u."""
        return self._apply(D, (self.output, -1), (self.input, 1), 0, back)

    def gain(self, K: np.ndarray, *, back: bool = False) -> np.ndarray:
        """K (n_u, n_x) of u = K x."""
        return self._apply(K, (self.input, -1), (self.state, 1), 0, back)

    def quadratic(self, P: np.ndarray, *, back: bool = False) -> np.ndarray:
        """P (n_x, n_x) of the form x'P x."""
        return self._apply(P, (self.state, 1), (self.state, 1), 0, back)

    def covariance(self, X: np.ndarray, *, back: bool = False) -> np.ndarray:
        """X (n_x, n_x) that transforms like x x' (an inverse of a quadratic form)."""
        return self._apply(X, (self.state, -1), (self.state, -1), 0, back)


def variable_weights(unit: Any, shape: tuple[int, int], name: str) -> np.ndarray:
    """Exact (m, n) matrix w with V = w * V_s entrywise, from a unit: scalar, one sequence, or (rows, columns)."""
    m, n = shape
    if isinstance(unit, tuple) and len(unit) == 2:
        rows, columns = _factors(unit[0], m, f"{name} rows"), _factors(unit[1], n, f"{name} columns")
    elif isinstance(unit, (list, np.ndarray)):
        rows, columns = _factors(unit, m, name), _factors(unit, n, name)
    else:
        rows, columns = _factors(unit, m, name), [fmpq(1)] * n
    return _weights(rows, columns, np.empty((0, 0), dtype=object))


def power_of_two(x: float) -> fmpq:
    """The power of two nearest to a positive float, in the logarithm."""
    exponent = round(float(np.log2(x)))
    return fmpq(2**exponent) if exponent >= 0 else fmpq(1, 2**-exponent)


def balance(magnitudes: np.ndarray, sweeps: int = 20) -> list[fmpq]:
    """Powers of two s (n,) such that s_i s_j magnitudes_ij is of order one (Ruiz equilibration).

    ``magnitudes`` (n, n) holds the largest modulus of each entry over the coefficients of a condition: it depends on
    the data only. Rows of zeros keep 1.
    """
    n = magnitudes.shape[0]
    s = np.ones(n)
    if n == 0:
        return []
    for _ in range(sweeps):
        largest = (s[:, None] * magnitudes * s[None, :]).max(axis=1)
        s /= np.sqrt(np.where(largest > 0, largest, 1.0))
    return [power_of_two(x) for x in s]


def as_factors(units: Sequence[Any], n: int, what: str) -> list[fmpq]:
    """``n`` positive rationals from given units; raises ValueError otherwise."""
    return _factors(units, n, what)
