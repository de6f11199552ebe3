"""Conditions and objectives: functions bound by argument name to the variables and data of a problem."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from recontrol.exact import ball, linalg, rational
from recontrol.lmi import blocks
from recontrol.lmi.affine import AffineMatrix, lift

SENSES = (">", "<", ">=", "<=", "=")


@dataclass(frozen=True)
class Condition:
    """A matrix inequality: the function, its sense, and how its arguments are named in the problem.

    ``rename`` maps arguments of the function to names of the problem, ``given`` fixes arguments (small integers such as
    an axis, or text). `matrix` returns the value with its sign turned so that the condition reads "> 0" (or "= 0").
    """

    function: Callable[..., Any]
    name: str
    sense: str
    rename: Mapping[str, str] = field(default_factory=dict)
    given: Mapping[str, int | str | bool] = field(default_factory=dict)

    @property
    def is_strict(self) -> bool:
        return self.sense in "<>"

    @property
    def is_equality(self) -> bool:
        return self.sense == "="

    @property
    def path(self) -> str:
        """Where the function stands, "module:name"."""
        return f"{self.function.__module__}:{self.function.__qualname__}"

    def arguments(self) -> dict[str, str]:
        """Name in the problem of each argument that is not given."""
        return {p: self.rename.get(p, p) for p in inspect.signature(self.function).parameters if p not in self.given}

    def matrix(self, values: Mapping[str, Any]) -> Any:
        """The matrix that the condition wants > 0 (>= 0, = 0), of the kind of ``values``.

        Raises KeyError for a missing argument, BlockError for entries of a wrong kind or a value that is not square,
        NotSymmetricError where it is not symmetric.
        """
        missing = [name for name in self.arguments().values() if name not in values]
        if missing:
            raise KeyError(f"{self.name}: no variable or datum is called {', '.join(missing)}")
        bound = {p: values[name] for p, name in self.arguments().items()}
        blocks.common_kind(list(bound.values()))  # CVXPY turns rationals into floats without a word
        M = as_matrix(self.function(**bound, **self.given))
        self._check(M)
        return -M if self.sense in ("<", "<=") else M

    def _check(self, M: Any) -> None:
        kind = blocks.kind_of(M)
        if not self.is_equality and (len(M.shape) != 2 or M.shape[0] != M.shape[1]):
            raise blocks.BlockError(f"{self.name}: expected a square matrix, found shape {M.shape}")
        if self.is_equality:
            return
        if kind in (blocks.EXACT, blocks.BALL):
            linalg.check_symmetric(M, self.name)
        elif kind == blocks.AFFINE:
            if not M.is_symmetric():
                raise linalg.NotSymmetricError(f"{self.name}: the value is not symmetric for every unknown")
        elif kind == blocks.FLOAT and not np.allclose(M, M.T, rtol=1e-9, atol=1e-9 * (1e-300 + np.abs(M).max())):
            raise linalg.NotSymmetricError(f"{self.name}: the value is not symmetric")


def as_matrix(M: Any) -> Any:
    """A scalar value as a 1 x 1 matrix of its kind; integer matrices as rationals; anything else unchanged."""
    if getattr(M, "shape", ()) == ():
        if blocks.kind_of(M) == blocks.CVXPY:
            import cvxpy

            return cvxpy.reshape(M, (1, 1), order="C")
        M = np.array([[M]], dtype=float if blocks.kind_of(M) == blocks.FLOAT else object)
    if isinstance(M, np.ndarray) and M.dtype.kind in "Oi":
        return blocks.integers_to_rationals(M)
    return M


def condition(
    function: Callable[..., Any],
    name: str | None = None,
    *,
    sense: str | None = None,
    rename: Mapping[str, str] | None = None,
    **given: int | str | bool,
) -> Condition:
    """A condition from a function marked `positive`, `negative`, ... (or with ``sense``).

    ``name`` defaults to the function's; ``rename={"Y": "Y_0"}`` binds argument Y to the problem's Y_0; further keywords
    fix arguments. Raises ValueError without a sense.
    """
    found = sense or getattr(function, "sense", None)
    if found not in SENSES:
        raise ValueError(f"{function.__qualname__}: mark it @positive, @negative, ... or give a sense out of {SENSES}")
    return Condition(function, name or function.__name__, found, dict(rename or {}), given)


@dataclass(frozen=True)
class Objective:
    """A scalar to be minimised or maximised: an affine function bound by argument names."""

    function: Callable[..., Any]
    sense: str  # "min" or "max"
    rename: Mapping[str, str] = field(default_factory=dict)

    @property
    def path(self) -> str:
        return f"{self.function.__module__}:{self.function.__qualname__}"

    def value(self, values: Mapping[str, Any]) -> Any:
        """The scalar, of the kind of ``values`` (1 x 1 matrices are unwrapped)."""
        arguments = inspect.signature(self.function).parameters
        out = self.function(**{p: values[self.rename.get(p, p)] for p in arguments})
        if isinstance(out, AffineMatrix) or blocks.kind_of(out) == blocks.CVXPY:
            return out
        out = out.item() if isinstance(out, np.ndarray) else out
        return out if isinstance(out, float) or ball.has_balls(out) else rational.rational(out)

    def affine(self, values: Mapping[str, Any]) -> tuple[Any, dict[int, Any]]:
        """Constant and coefficients by unknown."""
        form = lift(self.value(values))
        return form.constant[0, 0], {i: M[0, 0] for i, M in form.coefficients.items()}


def minimise(function: Callable[..., Any], **rename: str) -> Objective:
    """Objective "minimise ``function``"."""
    return Objective(function, "min", rename)


def maximise(function: Callable[..., Any], **rename: str) -> Objective:
    """Objective "maximise ``function``"."""
    return Objective(function, "max", rename)
