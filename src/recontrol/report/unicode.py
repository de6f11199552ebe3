"""Formulas between dollar signs as one line of Unicode, for the terminal."""

from __future__ import annotations

import re
import unicodedata

ACCENTS = {"dot": "\u0307", "ddot": "\u0308", "hat": "\u0302", "tilde": "\u0303", "bar": "\u0304"}
SYMBOLS = {
    "to": "→", "ge": "≥", "geq": "≥", "le": "≤", "leq": "≤", "ne": "≠", "neq": "≠", "pm": "±", "times": "×",
    "cdot": "·",
    "cdots": "⋯", "dots": "…", "ldots": "…", "vdots": "…", "infty": "∞", "top": "ᵀ", "in": "∈", "sum": "∑", "int": "∫",
    "succ": "≻", "prec": "≺", "succeq": "⪰", "preceq": "⪯", "Delta": "Δ", "Lambda": "Λ", "Psi": "Ψ", "Phi": "Φ",
    "Omega": "Ω", "Sigma": "Σ", "Gamma": "Γ", "Theta": "Θ", "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ",
    "varepsilon": "ε", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ", "kappa": "κ", "lambda": "λ", "mu": "μ",
    "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "varphi": "φ", "psi": "ψ",
    "omega": "ω",
}  # fmt: skip
SUBSCRIPTS = str.maketrans("0123456789+-", "₀₁₂₃₄₅₆₇₈₉₊₋")
SUPERSCRIPTS = str.maketrans("0123456789+-nT", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿᵀ")


def plain(text: str) -> str:
    """Return a text with its formulas in Unicode; everything outside dollar signs stays."""
    return re.sub(r"(?<!\\)\$\$?(?=\S)(.+?)(?<=\S)\$\$?", lambda match: formula(match[1]), text)


def formula(latex: str) -> str:
    """Return one formula: accents as combining characters, indices as small digits, matrices as [a b; c d]."""
    text = re.sub(r"\\begin\{\w*matrix\}(.*?)\\end\{\w*matrix\}", _matrix, latex, flags=re.S)
    text = re.sub(r"\\(?:mathrm|text|operatorname|mathbf)\{([^{}]*)\}", r"\1", text)
    names = "|".join(ACCENTS)
    for _ in range(3):
        text = re.sub(rf"\\({names})\s*(?:\{{([^{{}}\\]+)\}}|([A-Za-z]))", _accent, text)
        text = re.sub(rf"\\({names})\s*\{{([^{{}}\\]+)\}}", _accent, text)
    text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"(\1)/(\2)", text)
    text = re.sub(r"\\([A-Za-z]+)", lambda match: SYMBOLS.get(match[1], match[1]), text)
    text = text.replace("^ᵀ", "ᵀ").replace("^{ᵀ}", "ᵀ")
    text = re.sub(r"_(?:\{([^{}]*)\}|(\w))", lambda m: _small(m[1] or m[2], "_", SUBSCRIPTS), text)
    text = re.sub(r"\^(?:\{([^{}]*)\}|(\w))", lambda m: _small(m[1] or m[2], "^", SUPERSCRIPTS), text)
    text = text.replace("\\,", " ").replace("\\ ", " ").replace("\\;", " ").replace("{", "").replace("}", "")
    return unicodedata.normalize("NFC", " ".join(text.split()))


def _matrix(match: re.Match[str]) -> str:
    rows = [" ".join(row.replace("&", " ").split()) for row in match[1].split("\\\\")]
    return "[" + "; ".join(row for row in rows if row) + "]"


def _accent(match: re.Match[str]) -> str:
    body = match[2] if match[2] is not None else match[3]
    return body.strip() + ACCENTS[match[1]]


def _small(body: str, sign: str, table: dict[int, int]) -> str:
    if all(ord(character) in table for character in body):
        return body.translate(table)
    return sign + (body if len(body) == 1 else f"({body})")
