"""Plain-text formulas become LaTeX, words never do."""

from __future__ import annotations

import pytest

from recontrol.report import text
from recontrol.report.plaintext import latex


@pytest.mark.parametrize(
    ("plain", "expected"),
    [
        ("K = Y X^-1", r"K = Y X ^{-1}"),
        ("-3 omega0^2 (Iy - Iz) phi", r"-3 \omega_{0} ^{2} (I_{y} - I_{z} ) \phi"),
        ("x' = (A - LC) x", r"x' = (A - LC ) x"),
        ("|u_i| <= u_max", r"|u_{i} | \le u_{\mathrm{max}}"),
        ("X^{-1} > 0", r"X ^{-1} > 0"),
    ],
)
def test_formulas(plain: str, expected: str) -> None:
    assert latex(plain) == expected
    assert "<math" in text.inline(plain)
    assert "<code>" not in text.inline(plain)


@pytest.mark.parametrize(
    "words",
    ["rank n", "stable", "(28) to (45)", "4x1", "block 11 of Phi", "finite energy of [d; y_r]", "eps, rho, w", "[14]",
     "J w' + w x J w = T, component by component", "0.25", "faster in yaw, slower in pitch", "", "a -> b means so"],
)  # fmt: skip
def test_words_stay(words: str) -> None:
    assert latex(words) is None
