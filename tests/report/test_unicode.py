"""Formulas on one line of the terminal, against how one would write them by hand."""

from __future__ import annotations

import unicodedata

import pytest

from recontrol.report.unicode import plain


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        (r"error $\dot{\tilde x}_2 = (A_{22} - L A_{12})\hat x_2$", "error x\u0303\u0307₂ = (A₂₂ - L A₁₂)x\u0302₂"),
        (r"$\begin{bmatrix}1 & 0\\ A_{11} & B\end{bmatrix}x$", "[1 0; A₁₁ B]x"),
        (r"$Q = q C^\top C \ge 0$, $A_c^{n-1}$", "Q = q Cᵀ C ≥ 0, A_cⁿ⁻¹"),
        (r"$\frac{s^2+1}{s^4}$", "(s²+1)/(s⁴)"),
        (r"$x \to x_{cl}$", "x → x_(cl)"),
        (r"5 \$ and no formula", r"5 \$ and no formula"),
        ("words (55), x_b", "words (55), x_b"),
    ],
)  # fmt: skip
def test_formulas_become_unicode(text: str, shown: str) -> None:
    assert plain(text) == unicodedata.normalize("NFC", shown)
