"""Formulas in plain text, such as ``-3 omega0^2 (Iy - Iz) phi``, as LaTeX; anything that holds words stays text."""

from __future__ import annotations

import re

GREEK = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|psi|omega|"
    "Gamma|Delta|Theta|Lambda|Xi|Pi|Sigma|Phi|Psi|Omega"
)
FUNCTIONS = {"sin": r"\sin", "cos": r"\cos", "det": r"\det", "exp": r"\exp", "log": r"\log", "max": r"\max",
             "min": r"\min", "tr": r"\operatorname{tr}", "he": r"\operatorname{he}", "rank": r"\operatorname{rank}",
             "eig": r"\operatorname{eig}",
             "diag": r"\operatorname{diag}", "inf": r"\infty"}  # fmt: skip
OPERATORS = {"<=": r"\le ", ">=": r"\ge ", "!=": r"\ne ", "->": r"\to ", "+-": r"\pm ", "*": r"\,", "%": r"\%"}
TOKEN = re.compile(
    r"\s+|[A-Za-z]+(?:_\w+|\d+)?'*|\d+(?:\.\d+)?|<=|>=|!=|->|\+-|\^(?:\([^()]*\)|\{[^{}]*\}|-?\w+)|[-+*/=<>()\[\],;.|%!]"
)


def latex(text: str) -> str | None:
    """Return a plain-text formula as LaTeX, ``None`` if it holds a word, an unknown sign, or no operator."""
    if not re.search(r"[=<>^]|\w\s*[-+*/]\s*\w|->", text) or len(text) > 120:
        return None
    parts: list[str] = []
    place = 0
    while place < len(text):
        match = TOKEN.match(text, place)
        part = _token(match[0]) if match else None
        if match is None or part is None:
            return None
        parts.append(part)
        place = match.end()
    return " ".join("".join(parts).split())


def _token(token: str) -> str | None:
    if token.isspace():
        return " "
    if token[0] == "^":
        inner = latex_exponent(token[1:])
        return None if inner is None else "^{" + inner + "}"
    if not token[0].isalpha():
        return OPERATORS.get(token, token)
    match = re.fullmatch(r"([A-Za-z]+?)(_\w+|\d*)('*)", token)
    if match is None:
        return None
    name, index, primes = match[1], match[2].lstrip("_"), match[3]
    if GREEK.fullmatch(name):
        body = "\\" + name
    elif name in FUNCTIONS:
        return FUNCTIONS[name] + " " if not index else None
    elif len(name) == 1 or (name.isupper() and len(name) <= 3):
        body = name
    elif len(name) == 2 and name[0].isupper() and name[1] in "xyzijk":
        body, index = name[0], name[1] + index
    else:
        return None
    index = rf"\mathrm{{{index}}}" if index.isalpha() and len(index) > 1 else index
    return body + (f"_{{{index}}}" if index else "") + primes + " "


def latex_exponent(text: str) -> str | None:
    """Return what stands after ``^``, parentheses dropped."""
    text = text[1:-1] if text[0] in "({" else text
    return text if re.fullmatch(r"[-+\w/. ]+", text) else None
