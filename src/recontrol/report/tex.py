"""Text for LaTeX: escaping, formulas kept, and the few characters that pdfLaTeX does not know by itself."""

from __future__ import annotations

import re

from recontrol.report import plaintext

SPECIAL = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "#": r"\#", "%": r"\%", "&": r"\&", "_": r"\_", "$": r"\$",
    "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}", ">": r"\textgreater{}",
}  # fmt: skip

CHARACTERS = {
    "±": r"$\pm$", "×": r"$\times$", "−": "$-$", "≤": r"$\leq$", "≥": r"$\geq$", "≠": r"$\neq$", "≈": r"$\approx$",
    "∞": r"$\infty$", "√": r"$\surd$", "°": r"$^\circ$", "·": r"$\cdot$", "→": r"$\rightarrow$", "‖": r"$\|$",
    "“": "``", "”": "''", "‘": "`", "’": "'", "–": "--", "—": "---", "…": r"\dots{}", "\u2009": r"\,", "\u00a0": "~",
    "²": r"$^2$", "³": r"$^3$", "½": r"$\frac12$", "′": "$'$", "ω": r"$\omega$", "μ": r"$\mu$", "λ": r"$\lambda$",
    "ε": r"$\varepsilon$", "ρ": r"$\rho$", "γ": r"$\gamma$", "θ": r"$\theta$", "φ": r"$\varphi$", "ψ": r"$\psi$",
    "Λ": r"$\Lambda$", "Δ": r"$\Delta$", "κ": r"$\kappa$", "σ": r"$\sigma$", "τ": r"$\tau$", "π": r"$\pi$",
    "ζ": r"$\zeta$", "δ": r"$\delta$", "α": r"$\alpha$", "β": r"$\beta$", "η": r"$\eta$", "Σ": r"$\Sigma$",
}  # fmt: skip


def escape(text: str) -> str:
    """Return plain text for LaTeX; a character outside ASCII and Latin-1 that is not known becomes ``?``."""
    out = []
    for character in text:
        known = SPECIAL.get(character) or CHARACTERS.get(character)
        out.append(known or (character if ord(character) < 0x180 else "?"))
    return "".join(out)


def markdown(text: str | None) -> str:
    """Return one line of Markdown for LaTeX: formulas kept, code and emphasis set, everything else escaped."""
    whole = plaintext.latex((text or "").strip())
    if whole is not None:
        return f"${whole}$"
    pieces = re.split(r"(\$\$?(?=\S).+?(?<=\S)\$\$?|`[^`]+`|\*\*[^*]+\*\*|\*[^*]+\*)", " ".join((text or "").split()))
    return "".join(_piece(piece) for piece in pieces)


def _piece(piece: str) -> str:
    if len(piece) > 2 and piece[0] == piece[-1] == "$":
        return "$" + piece.strip("$") + "$"
    if len(piece) > 2 and piece[0] == piece[-1] == "`":
        return r"\texttt{" + escape(piece[1:-1]) + "}"
    if piece.startswith("**") and piece.endswith("**") and len(piece) > 4:
        return r"\textbf{" + escape(piece[2:-2]) + "}"
    if len(piece) > 2 and piece[0] == piece[-1] == "*":
        return r"\emph{" + escape(piece[1:-1]) + "}"
    return escape(piece)


def number(text: str) -> str:
    """Return a printed or found number in math mode: powers of ten, plus-minus, imaginary unit."""
    text = re.sub(r"[ij]$", r"\\mathrm{i}", text.replace("+/-", "±").replace("+-", "±"))
    text = re.sub(r"(?<=\d)[eE]([+-]?)0*(\d+)", lambda m: rf"\times10^{{{m[1].replace('+', '')}{m[2]}}}", text)
    return "$" + text.replace("±", r"\pm ") + "$"
