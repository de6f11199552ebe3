"""The vocabulary in which a matrix inequality is written once.

A condition is a plain function of its variables and data that uses ``@``, ``+``, ``-``, scalar times matrix, ``.T``,
slices, and the helpers of this module. The same function is then called with CVXPY variables (to solve), with floats
(to check), with rationals or balls (to prove), and with affine matrices (to read off its coefficients).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from flint import arb, fmpq, fmpz

from recontrol.exact import rational
from recontrol.lmi.affine import AffineMatrix

F = TypeVar("F", bound=Callable[..., Any])
Block = Any

CVXPY, FLOAT, EXACT, BALL, AFFINE = "cvxpy", "float", "exact", "ball", "affine"


class BlockError(ValueError):
    """Blocks whose shapes do not fit, or whose entries are of kinds that must not be mixed."""


def positive(function: F) -> F:
    """Mark ``function`` as the condition "its value is positive definite" (> 0)."""
    return _mark(function, ">")


def negative(function: F) -> F:
    """Mark ``function`` as the condition "its value is negative definite" (< 0)."""
    return _mark(function, "<")


def nonnegative(function: F) -> F:
    """Mark ``function`` as the condition "its value is positive semidefinite" (>= 0)."""
    return _mark(function, ">=")


def box_lemma(*unknowns: str) -> Callable[[F], F]:
    """Mark a condition that speaks of a whole box, by multipliers ``unknowns`` that must be diagonal to prove it."""

    def mark(function: F) -> F:
        function.diagonal = unknowns  # type: ignore[attr-defined]
        return function

    return mark


def nonpositive(function: F) -> F:
    """Mark ``function`` as the condition "its value is negative semidefinite" (<= 0)."""
    return _mark(function, "<=")


def equal(function: F) -> F:
    """Mark ``function`` as the condition "its value is the zero matrix"."""
    return _mark(function, "=")


def _mark(function: F, sense: str) -> F:
    function.sense = sense  # type: ignore[attr-defined]
    return function


def kind_of(x: Any) -> str | None:
    """Kind of a scalar or matrix; None for integers, which fit every kind.

    Raises BlockError for entries that no condition should hold (mixed kinds, object arrays of floats, CVXPY inside
    object arrays).
    """
    if isinstance(x, AffineMatrix):
        return AFFINE
    if hasattr(x, "is_dcp"):
        return CVXPY
    if isinstance(x, np.ndarray) and x.dtype == object:
        types = {type(entry) for entry in x.flat}
        if types <= {int, fmpz}:
            return None
        if types <= {int, fmpz, fmpq}:
            return EXACT
        if types <= {int, fmpz, fmpq, arb}:
            return BALL
        raise BlockError(f"an object array holds entries of type {sorted(t.__name__ for t in types)}")
    if isinstance(x, (bool, np.bool_)):
        raise BlockError("a truth value is not a block")
    if isinstance(x, (int, fmpz, np.integer)) or (isinstance(x, np.ndarray) and x.dtype.kind == "i"):
        return None
    if isinstance(x, (float, np.floating)) or (isinstance(x, np.ndarray) and x.dtype.kind == "f"):
        return FLOAT
    if isinstance(x, fmpq):
        return EXACT
    if isinstance(x, arb):
        return BALL
    raise BlockError(f"a block of type {type(x).__name__} is neither CVXPY, float, rational nor ball")


def common_kind(items: Sequence[Any]) -> str:
    """The kind that an assembly of ``items`` has; raises BlockError where floats would meet rationals or balls."""
    kinds = {k for k in map(kind_of, items) if k is not None}
    if CVXPY in kinds and kinds <= {CVXPY, FLOAT}:
        return CVXPY
    if AFFINE in kinds and kinds <= {AFFINE, EXACT, BALL}:
        return AFFINE
    if kinds <= {EXACT, BALL} and kinds:
        return BALL if BALL in kinds else EXACT
    if kinds <= {FLOAT}:
        return FLOAT if kinds else EXACT
    raise BlockError(f"blocks of kinds {sorted(kinds)} must not be mixed: convert the data to one kind")


def he(M: Any) -> Any:
    """M + M', for any kind."""
    return M + M.T


def trace(M: Any) -> Any:
    """Sum of the diagonal, for any kind."""
    if isinstance(M, AffineMatrix):
        return M.trace()
    if hasattr(M, "is_dcp"):
        import cvxpy

        return cvxpy.trace(M)
    return sum((M[i, i] for i in range(1, M.shape[0])), M[0, 0])


def eye(n: int) -> np.ndarray:
    """Identity of integers (n, n), which fits every kind."""
    return np.eye(n, dtype=int)


def strict(M: Any, margin: Any) -> Any:
    """M - margin * I, for a square M: the one way to write a strict inequality with a margin.

    In CVXPY ``M >> margin`` would subtract a matrix of ones instead.
    """
    return M - margin * eye(_shape(M)[0])


def block(rows: Sequence[Sequence[Block]]) -> Any:
    """Symmetric matrix from its upper block triangle.

    ``rows[i]`` holds the blocks (i,i), (i,i+1), ...; alternatively full rows with None below the diagonal. A block may
    be a matrix, a scalar (1 x 1), or the integer 0 for a zero block, whose shape follows from its row and column.
    Raises BlockError for shapes that do not fit or kinds that must not be mixed.
    """
    n = len(rows)
    upper: dict[tuple[int, int], Block] = {}
    for i, row in enumerate(rows):
        if len(row) == n and any(item is not None for item in row[:i]):
            raise BlockError(f"row {i + 1}: blocks below the diagonal are filled by symmetry, leave them None")
        if len(row) not in (n, n - i):
            raise BlockError(f"row {i + 1}: expected {n - i} blocks from the diagonal on (or {n}), found {len(row)}")
        upper |= {(i, n - len(row) + j): item for j, item in enumerate(row) if n - len(row) + j >= i}
    sizes = _sizes(upper, n)
    grid_rows = [
        [
            _shaped(upper[i, j], sizes[i], sizes[j]) if i <= j else _transposed(upper[j, i], sizes[i], sizes[j])
            for j in range(n)
        ]
        for i in range(n)
    ]
    return _assemble(grid_rows)


def grid(rows: Sequence[Sequence[Block]]) -> Any:
    """Rectangular block matrix of any kind; the integer 0 is a zero block. Raises BlockError as `block` does."""
    width = len(rows[0])
    if any(len(row) != width for row in rows):
        raise BlockError(f"expected {width} blocks in each row, found {[len(row) for row in rows]}")
    heights = [_one({_shape(b)[0] for b in row if not _is_zero(b)}, f"row {i + 1}") for i, row in enumerate(rows)]
    widths = [
        _one({_shape(row[j])[1] for row in rows if not _is_zero(row[j])}, f"column {j + 1}") for j in range(width)
    ]
    return _assemble([[_shaped(b, heights[i], widths[j]) for j, b in enumerate(row)] for i, row in enumerate(rows)])


def _is_zero(b: Block) -> bool:
    return isinstance(b, int) and b == 0


def _shape(b: Block) -> tuple[int, int]:
    shape: tuple[int, ...] = tuple(getattr(b, "shape", ()))
    if shape == ():
        return 1, 1
    if len(shape) != 2:
        raise BlockError(f"expected a matrix or scalar, found shape {shape}: write vectors as columns (n, 1)")
    return shape[0], shape[1]


def _one(found: set[int], where: str) -> int:
    if len(found) != 1:
        raise BlockError(f"{where}: expected blocks of one size, found {sorted(found) or 'only zeros'}")
    return found.pop()


def _sizes(upper: dict[tuple[int, int], Block], n: int) -> list[int]:
    found: list[set[int]] = [set() for _ in range(n)]
    for (i, j), b in upper.items():
        if not _is_zero(b):
            height, width = _shape(b)
            found[i].add(height)
            found[j].add(width)
    return [_one(sizes, f"block row {i + 1}") for i, sizes in enumerate(found)]


def _shaped(b: Block, height: int, width: int) -> Block:
    if _is_zero(b):
        return np.zeros((height, width), dtype=int)
    if _shape(b) != (height, width):
        raise BlockError(f"expected a block of shape {(height, width)}, found {_shape(b)}")
    return b


def _transposed(b: Block, height: int, width: int) -> Block:
    shaped = _shaped(b, width, height)
    return shaped.T if getattr(shaped, "shape", ()) != () else shaped


def _assemble(rows: list[list[Block]]) -> Any:
    kind = common_kind([b for row in rows for b in row])
    if kind == CVXPY:
        import cvxpy

        return cvxpy.bmat(rows)
    if kind == AFFINE:
        return AffineMatrix.assemble([[_as_matrix(b, kind) for b in row] for row in rows])
    return np.block([[_as_matrix(b, kind) for b in row] for row in rows])


def _as_matrix(b: Block, kind: str) -> Any:
    if isinstance(b, AffineMatrix):
        return b
    array = np.asarray(b, dtype=float if kind == FLOAT else object).reshape(_shape(b))
    return array if kind == FLOAT else integers_to_rationals(array)


def integers_to_rationals(array: np.ndarray) -> np.ndarray:
    """Object matrix with its integers turned into fmpq, so that divisions stay exact."""
    out = np.empty(array.shape, dtype=object)
    for index in np.ndindex(array.shape):
        x: Any = array[index]
        out[index] = x if isinstance(x, (fmpq, arb)) else rational.rational(x)
    return out
