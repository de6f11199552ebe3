"""Faces: subspaces on which multipliers can live, found from the conditions themselves.

If some combination N_c = s M_c0 + sum_i x_i M_ci, s >= 0, is positive semidefinite for every condition, then the
multipliers with sum_c <Z_c, M_ci> = 0 and sum_c <Z_c, M_c0> <= 0 satisfy <Z_c, N_c> = 0: they vanish on the range of
N_c and have no interior. Written Z = W Y W' with W a basis of the complement they can have one, and only then survive
rounding. Any W is sound; a wrong one proves nothing.
Source: facial reduction, Borwein and Wolkowicz, J. Austral. Math. Soc. (Series A) 30 (1981) 369-380.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import linalg, rational
from recontrol.lmi import scaling
from recontrol.lmi.affine import AffineMatrix, magnitudes
from recontrol.lmi.problem import Problem

Faces = Mapping[str, np.ndarray]

# A direction counts as exposed if N is this much larger than Z in it.
WIDE = 1e3
# Diagonal entries that vanish at a point are taken as this share of their terms.
SMALL = 1e-4
# Bits of numerator or denominator beyond which a basis is noise that was taken for fractions.
SIMPLE = 128


@dataclass(frozen=True)
class Faced:
    """The conditions of a problem restricted to faces: forms W' M W, their units, and the way back Z = W Y W'.

    ``near``, floats of all unknowns in original units, rescales unknowns and rows to be of order one there. A proof may
    use any units; the problem's own, which must not depend on its answer, stay for what is reported. ``bases`` goes one
    step further: scaled multipliers are B Y B' with B (r, r) exact, and Y near the identity survives rounding.
    """

    problem: Problem
    faces: Faces
    near: tuple[float, ...] | None = None
    bases: Mapping[str, np.ndarray] = field(default_factory=dict)

    @cached_property
    def forms(self) -> dict[str, AffineMatrix]:
        """Exact restricted forms by condition."""
        out = {}
        for name, form in self.problem.forms.items():
            out[name] = form.congruent(self.faces[name]) if name in self.faces else form
        return out

    @cached_property
    def row_units(self) -> dict[str, list[fmpq]]:
        """Exact row units: the problem's, balanced anew on a face, or unit diagonal at `near`."""
        out = dict(self.problem.row_units)
        for name in self.forms if self.near is not None else self.faces:
            sizes = magnitudes(self.forms[name], self.unknown_units)
            out[name] = scaling.balance(sizes)
            if self.near is not None:
                at = np.diag(self.forms[name].float_at(self.near))
                floor = SMALL * np.where(np.diag(sizes) > 0, np.diag(sizes), 1.0)
                out[name] = [scaling.power_of_two(x) for x in 1 / np.sqrt(np.maximum(at, floor))]
        return out

    @cached_property
    def unknown_units(self) -> list[fmpq]:
        """Unit of every scalar unknown: the problem's, or the largest modulus in its variable at `near`."""
        out = list(self.problem.unknown_units)
        for name, v in self.problem.variables.items() if self.near is not None else ():
            first = self.problem.offsets[name]
            largest = max(map(abs, (self.near or ())[first : first + v.size]))
            size = [max(largest, SMALL * float(rational.to_float(u))) for u in out[first : first + v.size]]
            out[first : first + v.size] = [scaling.power_of_two(x) for x in size]
        return out

    def unscaled(self, name: str, Y: np.ndarray) -> np.ndarray:
        """Multiplier of the restricted condition in original units, S B Y B' S, for an exact symmetric Y."""
        S = rational.diagonal(self.row_units[name])
        if name in self.bases:
            S = S @ self.bases[name]
        return S @ Y @ S.T

    def conditioned(self, multipliers: Mapping[str, np.ndarray]) -> Faced:
        """These conditions in bases where the scaled float ``multipliers`` are the identity, to thirty bits."""
        bases = {}
        for name, Z in multipliers.items():
            if Z.shape[0] == Z.shape[1] == self.forms[name].shape[0] and Z.size:
                values, vectors = np.linalg.eigh((Z + Z.T) / 2)
                if values[0] <= 0:
                    continue
                root = vectors * np.sqrt(values / values[-1])
                mantissa, exponent = np.frexp(root)
                bases[name] = rational.from_float(np.ldexp(np.round(mantissa * 2**30), exponent - 30))
        return replace(self, bases=bases)

    def in_bases(self, multipliers: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Scaled float multipliers Z as Y with Z = B Y B'."""
        out = dict(multipliers)
        for name, basis in self.bases.items():
            B = rational.to_float(basis)
            out[name] = np.linalg.solve(B, np.linalg.solve(B, multipliers[name]).T)
        return out

    def lifted(self, name: str, Y: np.ndarray) -> np.ndarray:
        """Multiplier of the whole condition, W Y W'."""
        return self.faces[name] @ Y @ self.faces[name].T if name in self.faces else Y


def given_faces(problem: Problem, given: Mapping[str, Any] | None) -> dict[str, np.ndarray]:
    """Faces from exact matrices W (n, r), or from lists of 0-based rows (a principal block)."""
    out = {}
    for name, W in (given or {}).items():
        n = problem.forms[name].shape[0]
        out[name] = W if isinstance(W, np.ndarray) else rational.identity(n)[:, list(W)]
        if out[name].shape[0] != n:
            raise ValueError(f"face of {name}: expected {n} rows, found {out[name].shape[0]}")
    return out


def complement(V: np.ndarray) -> np.ndarray:
    """Face (n, n - k) of the multipliers that vanish on the exact independent columns of V (n, k)."""
    return linalg.nullspace(V.T)


def exposed_faces(
    faced: Faced, exposing: Mapping[str, np.ndarray], multipliers: Mapping[str, np.ndarray], tolerance: float
) -> dict[str, np.ndarray]:
    """Smaller faces from scaled N_c >= 0 that all multipliers are orthogonal to; empty if none is left out.

    Each basis is read off the range of N_c as rationals, the simplest within ``tolerance``.
    """
    found = {}
    for name, N in exposing.items():
        W = _complement(N, multipliers[name], faced.row_units[name], tolerance)
        if W is not None and W.shape[1]:
            found[name] = faced.faces[name] @ W if name in faced.faces else W
    return {**faced.faces, **found} if found else {}


def _complement(N: np.ndarray, Z: np.ndarray, row_units: list[fmpq], tolerance: float) -> np.ndarray | None:
    """Rational basis (n, r) of the orthogonal complement of the range of S^-1 N S^-1; None if the range is zero.

    At the solver's point N Z is nearly zero: a direction is in the range if N is large in it and Z small.

    The range is brought to reduced echelon form, whose entries are recognised as fractions.
    """
    import scipy.linalg

    values, vectors = np.linalg.eigh((N + N.T) / 2)
    wide = vectors[:, values > WIDE * np.abs(np.einsum("ij,ik,kj->j", vectors, Z, vectors))]
    if not wide.shape[1]:
        return None
    s = rational.to_float(np.array(row_units, dtype=object))
    basis = (wide / s[:, None]).T
    k = basis.shape[0]
    _, _, order = scipy.linalg.qr(basis, pivoting=True)
    echelon = np.linalg.solve(basis[:, order[:k]], basis)
    exact = np.array([[_recognised(x, tolerance) for x in row] for row in echelon], dtype=object)
    W = complement(exact.T)
    return W if all(x.height_bits() <= SIMPLE for x in W.flat) else None


def _recognised(x: float, tolerance: float) -> fmpq:
    """A fraction of small denominator within ``tolerance`` of ``x``, relative to max(1, abs x)."""
    for bound in (1, 10, 100, 1000, 10_000, 100_000, 1_000_000):
        guess = Fraction(x).limit_denominator(bound)
        if abs(float(guess) - x) <= tolerance * max(1.0, abs(x)):
            return fmpq(guess.numerator, guess.denominator)
    return rational.rounded(x, 9)
