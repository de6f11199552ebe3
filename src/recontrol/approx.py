"""A floating-point number or array together with a bound on its absolute error."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Approx:
    """`value` is within `error` of the truth, entry by entry.

    value: float, complex, or ndarray of these; error: float >= 0 or ndarray of the same shape. For a complex value the
    bound holds for the real and for the imaginary part. The author of a value states where the bound comes from.
    """

    value: Any
    error: Any

    def __post_init__(self) -> None:
        import numpy as np

        if not np.all(np.isfinite(np.asarray(self.value, dtype=complex))):
            raise ValueError("Approx: the value is not finite")
        error = np.asarray(self.error, dtype=float)
        if not np.all(np.isfinite(error)) or np.any(error < 0):
            raise ValueError("Approx: the error bound must be finite and not negative")
        if error.ndim and error.shape != np.shape(self.value):
            raise ValueError(f"Approx: value has shape {np.shape(self.value)}, error bound {error.shape}")
