"""LaTeX of a run: a macro for every claim, booktabs tables, BibTeX of the papers (results/latex)."""

from __future__ import annotations

from pathlib import Path

from recontrol.report import bibtex, numbers, present, tex, words
from recontrol.report.claim import Claim
from recontrol.report.collect import Paper

HEAD = r"""% Findings as macros. In the preamble: \usepackage{amsmath,booktabs,longtable} and \input{claims.tex}. Then
%   \RCprinted{hashim2015/eq69-Dr}   what the paper prints
%   \RCfound{hashim2015/eq69-Dr}     what was found, to the digits of the print
%   \RCverdict{...} \RCstrength{...} \RCwhere{...} \RCtitle{...} \RCreading{...} \RCunit{...}
%   \RCcount{hashim2015}{erratum}    how many claims of a paper have a verdict
% An identity that does not exist is an error that names it.
\makeatletter
\newcommand{\RC@get}[2]{\@ifundefined{RC@#1@#2}%
  {\PackageError{recontrol}{no claim or paper #1}{See the list in claims.tex.}}{\csname RC@#1@#2\endcsname}}
\newcommand{\RC@set}[3]{\expandafter\gdef\csname RC@#1@#2\endcsname{#3}}
\newcommand{\RCprinted}[1]{\RC@get{#1}{printed}}
\newcommand{\RCfound}[1]{\RC@get{#1}{found}}
\newcommand{\RCverdict}[1]{\RC@get{#1}{verdict}}
\newcommand{\RCstrength}[1]{\RC@get{#1}{strength}}
\newcommand{\RCwhere}[1]{\RC@get{#1}{where}}
\newcommand{\RCtitle}[1]{\RC@get{#1}{title}}
\newcommand{\RCreading}[1]{\RC@get{#1}{reading}}
\newcommand{\RCunit}[1]{\RC@get{#1}{unit}}
\newcommand{\RCcount}[2]{\@ifundefined{RC@#1@count}{\RC@get{#1}{count}}%
  {\@ifundefined{RC@#1@count@#2}{0}{\csname RC@#1@count@#2\endcsname}}}
"""


def files(root: Path, papers: list[str]) -> dict[str, str]:
    """Return name -> text of everything under results/latex."""
    found = [Paper(Path(root), key) for key in papers]
    made = {"claims.tex": macros(found), "counts.tex": counts(found), "papers.bib": bibliography(found)}
    return made | {f"{paper.key}-claims.tex": table(paper) for paper in found}


def macros(papers: list[Paper]) -> str:
    """Return claims.tex."""
    lines = [HEAD.rstrip()]
    for paper in papers:
        lines.append(f"% {paper.key}")
        lines.append(rf"\RC@set{{{paper.key}}}{{count}}{{{len(paper.claims)}}}")
        lines += [rf"\RC@set{{{paper.key}}}{{count@{name}}}{{{n}}}" for name, n in paper.counts.items()]
        lines += [line for claim in paper.claims for line in _macros_of(claim)]
    return "\n".join([*lines, r"\makeatother", ""])


def _macros_of(claim: Claim) -> list[str]:
    fields = {
        "where": tex.escape(claim.where),
        "title": tex.markdown(claim.title),
        "printed": printed(claim),
        "found": found(claim),
        "verdict": tex.escape(claim.words.label),
        "strength": claim.strength or "--",
        "reading": tex.escape(claim.reading or "--"),
        "unit": tex.escape(claim.unit),
    }
    name = f"{claim.paper}/{claim.id}"
    return [rf"\RC@set{{{name}}}{{{field}}}{{{value}}}" for field, value in fields.items()]


def printed(claim: Claim) -> str:
    """Return the print: a number, a matrix, or words; cells outside the claim are dots."""
    if claim.rows is None:
        return tex.markdown(claim.printed)
    return matrix(
        [
            [text if present.is_counted(claim, i, j) else "." for j, text in enumerate(row)]
            for i, row in enumerate(claim.rows)
        ]
    )


def found(claim: Claim) -> str:
    """Return what the carrying reading found, to the digits of the print; words for what is not a number."""
    finding = claim.decisive
    if finding is None:
        return "--"
    cells = present.fitting(claim, finding)
    if claim.rows is None or cells is None:
        return tex.escape(present.found_text(claim, finding))
    pairs = [list(zip(row, texts, strict=True)) for row, texts in zip(cells, claim.rows, strict=True)]
    return matrix([["." if cell is None else numbers.write_like(cell, text) for cell, text in row] for row in pairs])


def matrix(rows: list[list[str]]) -> str:
    """Return cells as inline math: one number, a row in parentheses, or a small matrix."""
    cells = [[r"\cdot" if cell == "." else tex.number(cell).strip("$") for cell in row] for row in rows]
    if len(cells) == 1 and len(cells[0]) == 1:
        return f"${cells[0][0]}$"
    if len(cells) == 1:
        return "$(" + r",\ ".join(cells[0]) + ")$"
    body = r" \\ ".join(" & ".join(row) for row in cells)
    return r"$\left(\begin{smallmatrix} " + body + r" \end{smallmatrix}\right)$"


def counts(papers: list[Paper]) -> str:
    """Return the booktabs table of verdict counts."""
    present_names = {name for paper in papers for name in paper.counts}
    order = [name for verdict in words.VERDICTS for name in (verdict, f"{verdict}-scan") if name in present_names]
    stacked = [tex.escape(label(name)).replace(" ", r" \\ ") for name in order]
    heads = " & ".join(rf"\shortstack[r]{{{words_of}}}" for words_of in stacked)
    lines = [
        r"% Needs \usepackage{booktabs}.",
        r"\begingroup\small\setlength{\tabcolsep}{4pt}",
        rf"\begin{{tabular}}{{l{'r' * (len(order) + 1)}}}",
        r"\toprule",
        rf"paper & {heads} & claims \\",
        r"\midrule",
        *[rf"{p.key} & {' & '.join(str(p.counts.get(n, 0)) for n in order)} & {len(p.claims)} \\" for p in papers],
        r"\bottomrule",
        r"\end{tabular}\endgroup",
    ]
    return "\n".join([*lines, ""])


def label(name: str) -> str:
    """Return the heading of a count."""
    return "erratum (scan?)" if name == "erratum-scan" else words.verdict(name).label


def table(paper: Paper) -> str:
    """Return the booktabs table of a paper's claims; it breaks over pages."""
    lines = [
        r"% Needs \usepackage{amsmath,booktabs,longtable}.",
        r"\begingroup\small\setlength{\tabcolsep}{4pt}",
        r"\begin{longtable}{@{}p{0.15\linewidth}p{0.32\linewidth}p{0.25\linewidth}p{0.13\linewidth}l@{}}",
        r"\toprule place & claim & found & verdict & strength \\ \midrule \endhead",
        r"\bottomrule \endfoot",
    ]
    for claim in paper.claims:
        size = sum(map(len, claim.rows or []))
        value = (
            found(claim)
            if size <= 3
            else tex.escape(present.found_text(claim, claim.decisive))
            if claim.decisive
            else ""
        )
        cells = [tex.escape(claim.where), tex.markdown(claim.title), value, tex.escape(claim.words.label)]
        lines.append(" & ".join([*cells, claim.strength or "--"]) + r" \\")
    return "\n".join([*lines, r"\end{longtable}\endgroup", ""])


def bibliography(papers: list[Paper]) -> str:
    """Return papers.bib."""
    return "\n\n".join(bibtex.of_paper(paper) for paper in papers) + "\n"
