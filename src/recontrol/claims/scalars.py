"""What a reading returned, taken apart: scalars of the printed shape, real and imaginary parts, short texts."""

from __future__ import annotations

from typing import Any

import flint
import numpy as np

from recontrol.claims.values import Approx, Statement, enclosure
from recontrol.errors import ValueContractError


def decimal_end(end: Any, down: bool, digits: int = 25) -> str:
    """A rational rounded outward to a decimal of `digits` significant digits."""
    if end == 0:
        return "0"
    exponent = digits - len(str(abs(int(end.p)) // int(end.q))) if abs(end) >= 1 else digits + _leading_zeros(end)
    scaled = end * flint.fmpq(10) ** exponent
    mantissa = scaled.floor() if down else scaled.ceil()
    return f"{mantissa}e{-exponent}"


def _leading_zeros(end: Any) -> int:
    return len(str(int(end.q) // abs(int(end.p)))) - 1


def as_matrix(value: Any, shape: tuple[int, int]) -> Any:
    """Object array of scalars of the printed shape. Raises ValueContractError for another shape or type."""
    if isinstance(value, Approx) and np.ndim(value.value):
        values = np.asarray(value.value)
        errors = np.broadcast_to(np.asarray(value.error, dtype=float), values.shape)
        flat = [Approx(v.item(), e.item()) for v, e in zip(values.ravel(), errors.ravel(), strict=True)]
        array = np.empty(len(flat), dtype=object)
        array[:] = flat
        value = array.reshape(values.shape)
    elif not isinstance(value, np.ndarray):
        array = np.empty((1, 1), dtype=object)
        array[0, 0] = value
        value = array
    if value.dtype != object:
        raise ValueContractError(f"an array of {value.dtype} carries no error bound; wrap it as Approx(value, error)")
    if value.ndim == 1 and value.size == shape[0] * shape[1] and 1 in shape:
        value = value.reshape(shape)
    if value.shape != shape:
        raise ValueContractError(f"the reading returned shape {value.shape}, the print has {shape}")
    return value


def real_and_imag(value: Any) -> tuple[Any, Any]:
    """Real and imaginary part as scalars of the same strength."""
    from flint import acb

    if isinstance(value, acb):
        return value.real, value.imag
    if isinstance(value, Approx):
        return Approx(complex(value.value).real, value.error), Approx(complex(value.value).imag, value.error)
    return value, flint.fmpq(0)


def is_complex(value: Any) -> bool:
    if isinstance(value, Approx):
        return isinstance(value.value, complex)
    return isinstance(value, flint.acb)


def middle(scalar: Any) -> Any:
    low, high = enclosure(scalar)
    return (low + high) / 2


def describe(value: Any, digits: int = 10) -> str:
    """A value as short text: decimals to `digits` significant digits, balls and floats without false digits."""
    if isinstance(value, np.ndarray):
        return matrix_text([[describe(cell, digits) for cell in row] for row in np.atleast_2d(value)])
    if isinstance(value, Approx):
        if np.ndim(value.value):
            return matrix_text([[f"{cell:.{digits}g}" for cell in row] for row in np.atleast_2d(value.value)])
        if isinstance(value.value, complex):
            return f"{value.value.real:.{digits}g}{value.value.imag:+.{digits}g}i"
        return f"{float(value.value):.{digits}g}"
    if isinstance(value, flint.acb):
        return f"{describe(value.real, digits)}{'' if middle(value.imag) < 0 else '+'}{describe(value.imag, digits)}i"
    if isinstance(value, flint.arb):
        return f"{float(value.mid()):.{digits}g}"
    if isinstance(value, (flint.fmpq, flint.fmpz, int)):
        exact = flint.fmpq(value)
        return str(exact) if exact.q == 1 and abs(exact.p) < 10**digits else f"{int(exact.p) / int(exact.q):.{digits}g}"
    if isinstance(value, Statement):
        return "; ".join(f"{name} = {describe(margin)}" for name, margin in value.named().items())
    return str(value)


def matrix_text(rows: list[list[str]]) -> str:
    return "\n".join(" ".join(row) for row in rows)
