"""Exact algebra of matrix symbols, for identities that hold in every dimension.

An expression is a sympy expression of non-commutative symbols; `T` transposes it and `normal` brings it to a normal
form in which neighbouring inverses cancel. Identities of block matrices are lists of lists of such expressions.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from flint import fmpq

from recontrol.exact import rational

SYMMETRIC = ("X", "Y", "P", "Z", "Psi", "Pi", "Ai")
INVERSES = {("P", "Pi"), ("X", "Y"), ("Q", "W"), ("Qt", "Wt"), ("A11", "Ai")}
"""Pairs with product one; Pi is P^{-1}, Y is X^{-1}, W is Q^{-1}, Ai is the inverse of A11."""

Block = list[list[Any]]


def symbol(name: str) -> Any:
    """A matrix symbol."""
    import sympy as sp

    return sp.Symbol(name, commutative=False)


def symbols(names: str) -> list[Any]:
    """Several matrix symbols."""
    return [symbol(name) for name in names.split()]


def T(expression: Any) -> Any:
    """Transpose of an expression, or of a block matrix."""
    import sympy as sp

    if isinstance(expression, list):
        return [[T(expression[i][j]) for i in range(len(expression))] for j in range(len(expression[0]))]
    total = sp.Integer(0)
    for term in sp.Add.make_args(sp.expand(expression)):
        number, factors = _split(term)
        total += number * sp.Mul(*[_transposed(f) for f in reversed(factors)])
    return total


def he(expression: Any) -> Any:
    """E + E'."""
    return expression + T(expression)


def _transposed(factor: Any) -> Any:
    name = factor.name
    if name in SYMMETRIC or name in ("A11", "A22"):
        return factor
    return symbol(name[:-1] if name.endswith("t") else name + "t")


def _split(term: Any) -> tuple[Any, list[Any]]:
    """Number and list of single non-commutative factors of a product."""
    import sympy as sp

    numbers, factors = sp.sympify(term).args_cnc()
    words: list[Any] = []
    for factor in factors:
        base, power = factor.as_base_exp()
        words += [base] * int(power)
    return sp.Mul(*numbers), words


def normal(expression: Any) -> Any:
    """Normal form: expanded, neighbouring inverses cancelled. A block matrix entry by entry."""
    import sympy as sp

    if isinstance(expression, list):
        return [[normal(entry) for entry in row] for row in expression]
    total = sp.Integer(0)
    for term in sp.Add.make_args(sp.expand(expression)):
        number, factors = _split(term)
        stack: list[Any] = []
        for factor in factors:
            if stack and _cancel(stack[-1].name, factor.name):
                stack.pop()
            else:
                stack.append(factor)
        total += number * sp.Mul(*stack)
    return sp.expand(total)


def _cancel(left: str, right: str) -> bool:
    return (left, right) in INVERSES or (right, left) in INVERSES


def product(left: Block, right: Block) -> Block:
    """Product of block matrices."""
    import sympy as sp

    return [
        [sum((row[k] * right[k][j] for k in range(len(right))), sp.Integer(0)) for j in range(len(right[0]))]
        for row in left
    ]


def congruence(M: Block, A: Block) -> Block:
    """M' A M in normal form."""
    return normal(product(product(T(M), A), M))


def schur(A: Block, inverse: Any) -> Block:
    """Schur complement of the last diagonal block, whose inverse is given: A11 - A12 A22^{-1} A21."""
    n = len(A) - 1
    return normal([[A[i][j] - A[i][n] * inverse * A[n][j] for j in range(n)] for i in range(n)])


def exchange(block: Block, images: Mapping[str, Any]) -> Block:
    """The block with every symbol named replaced by its image at once, and its transpose by the image's transpose."""
    import sympy as sp

    pairs = {symbol(name): image for name, image in images.items()}
    pairs |= {T(old): T(new) for old, new in pairs.items()}
    return normal([[sp.sympify(entry).subs(pairs, simultaneous=True) for entry in row] for row in block])


def evaluate(block: Block, values: Mapping[str, np.ndarray]) -> np.ndarray:
    """The block matrix for rational matrices in place of the symbols; "Qt" is the transpose of "Q".

    A number on the diagonal is a multiple of the identity. Raises ValueError for a row of blocks without a symbol and
    for a number other than zero off the diagonal.
    """
    grid = [[_evaluated(entry, values) for entry in row] for row in block]
    heights = [next((M.shape[0] for M in row if M.ndim), 0) for row in grid]
    if 0 in heights:
        raise ValueError(f"block row {heights.index(0) + 1} has no symbol that gives its size")

    def filled(M: np.ndarray, i: int, j: int) -> np.ndarray:
        if M.ndim:
            return M
        if i != j and M != 0:
            raise ValueError(f"block ({i + 1},{j + 1}) is the number {M}, which has no size")
        return M * rational.identity(heights[i]) if i == j else rational.zeros(heights[i], heights[j])

    return np.block([[filled(M, i, j) for j, M in enumerate(row)] for i, row in enumerate(grid)])


def _evaluated(entry: Any, values: Mapping[str, np.ndarray]) -> np.ndarray:
    """One entry; a plain number stays an array without axes."""
    import sympy as sp

    total = np.array(fmpq(0), dtype=object)
    for term in sp.Add.make_args(sp.expand(entry)):
        number, factors = _split(term)
        value = np.array(fmpq(int(number.p), int(number.q)), dtype=object)
        for k, factor in enumerate(factors):
            M = values[factor.name] if factor.name in values else values[factor.name[:-1]].T
            value = value @ M if k else value * M
        total = total + value
    return np.asarray(total, dtype=object)


def flat(*blocks: Any) -> tuple[Any, ...]:
    """Entries of expressions and block matrices in normal form, in one tuple, to be compared one by one."""
    out: list[Any] = []
    for block in blocks:
        out += [normal(e) for row in block for e in row] if isinstance(block, list) else [normal(block)]
    return tuple(out)
