"""The verdict book: VERDICTS.md, an errata sheet a paper (docs/errata), and the counts in the README.

All three are made from the artifacts of a run and committed; a test fails when they are stale. Numbers are given to the
digits that do not depend on solver or processor.
"""

from __future__ import annotations

import re
from pathlib import Path

from recontrol.errors import MissingArtifactError
from recontrol.report import brief, cite, present, words
from recontrol.report.claim import Claim
from recontrol.report.collect import Paper

STRENGTHS = {
    "exact": "exact rational arithmetic",
    "ball": "ball arithmetic, every rounding error enclosed",
    "float": "floating point with a stated error bound",
}
COUNTS = ("<!-- verdict counts: made by `make book` -->", "<!-- end of verdict counts -->")


def files(root: Path, papers: list[str]) -> dict[str, str]:
    """Return path -> text of the committed pages. Raises MissingArtifactError if a paper has no verdicts."""
    found = [Paper(Path(root), key) for key in papers]
    for paper in found:
        if not (paper.results / "verdicts.json").is_file():
            raise MissingArtifactError(
                f"results/{paper.key}/verdicts.json: missing; run `snakemake --cores 2 all` first"
            )
    pages = {"VERDICTS.md": verdicts(found)}
    pages |= {f"docs/errata/{paper.key}.md": errata(paper) for paper in found}
    readme = Path(root) / "README.md"
    if readme.is_file():
        pages["README.md"] = with_counts(readme.read_text(encoding="utf-8"), found)
    return pages


def with_counts(text: str, papers: list[Paper]) -> str:
    """Return a text with the table of counts between its two markers; unchanged where it has none."""
    start, end = COUNTS
    pattern = re.compile(re.escape(start) + ".*?" + re.escape(end), re.S)
    return pattern.sub(lambda _: f"{start}\n{counts(papers)}\n{end}", text)


def counts(papers: list[Paper]) -> str:
    """Return the table of verdict counts in Markdown."""
    order = [name for verdict in words.VERDICTS for name in (verdict, f"{verdict}-scan")]
    shown = [name for name in order if any(name in paper.counts for paper in papers)]
    heads = [words.counted(name) for name in shown]
    lines = [_row("paper", *heads, "claims"), _row("---", *["--:"] * (len(shown) + 1))]
    for paper in papers:
        lines.append(_row(paper.key, *[str(paper.counts.get(name, 0)) for name in shown], str(len(paper.claims))))
    totals = [sum(paper.counts.get(name, 0) for paper in papers) for name in shown]
    lines.append(_row("all", *map(str, totals), str(sum(len(paper.claims) for paper in papers))))
    return "\n".join(lines)


def _row(*cells: str) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", "<br>") for cell in cells) + " |"


def verdicts(papers: list[Paper]) -> str:
    """Return VERDICTS.md."""
    lines = [
        "# Verdicts",
        "",
        "Every claim of every paper: what is printed, what was found, and the verdict with its strength. Made by",
        "`make book` from the artifacts of a run; [docs/verdicts.md](docs/verdicts.md) says what the words mean.",
        "",
        counts(papers),
        "",
    ]
    for paper in papers:
        lines += [f"## {paper.key}", "", f"{paper.about.get('title', '')} ({cite.authors(paper)})", ""]
        lines += [_row("claim", "place", "what", "printed", "found", "verdict", "strength"), _row(*["---"] * 7)]
        lines += [_row(*_claim_cells(claim)) for claim in paper.claims]
        lines.append("")
    return "\n".join(lines)


def _claim_cells(claim: Claim) -> list[str]:
    verdict = claim.words.label + (" (may be the scan's)" if claim.scanned and claim.verdict == "erratum" else "")
    if claim.explained_by and claim.verdict == "erratum":
        verdict += f"; explained by {', '.join(claim.explained_by)}"
    if claim.verdict == "reproduced-under-assumption":
        verdict += f": {claim.reading}"
    return [claim.id, claim.where, claim.title, brief.printed(claim), brief.found(claim), verdict, claim.strength or ""]


def errata(paper: Paper) -> str:
    """Return an errata sheet in a form that could be sent to the journal."""
    some = [claim for claim in paper.claims if claim.verdict == "erratum"]
    about = paper.about
    doi = f" DOI {about['doi']}." if about.get("doi") else ""
    lines = [
        f"# Errata of {paper.key}",
        "",
        f"{', '.join(about.get('authors') or [])}, “{about.get('title', '')}”, {about.get('venue', '')}.{doi}",
        "",
        "Each entry was established by recomputing the printed values from the paper's own problem data and formulas.",
        "It is offered in the hope that it is useful to readers of the paper, and does not judge the work. Where only",
        "recognised text was at hand, print and scan cannot be told apart; such entries stand apart and may be void.",
        "",
    ]
    for title, scanned in (("In print", False), ("In the text at hand; may be the scan's", True)):
        entries = [claim for claim in some if claim.scanned is scanned]
        if entries:
            lines += [f"## {title}", ""]
            lines += [line for number, claim in enumerate(entries, 1) for line in _erratum(number, claim)]
    if not some:
        lines += ["None was found.", ""]
    return "\n".join(lines)


def _erratum(number: int, claim: Claim) -> list[str]:
    value = present.correction(claim)
    value = value if claim.correct else value and brief.found(claim)
    proof = STRENGTHS.get(claim.strength or "", "")
    how = words.COMPARISONS.get(claim.compare, claim.compare)
    lines = [f"### {number}. {claim.where}: {claim.title}", ""]
    lines.append(f"- Printed: {brief.printed(claim) or 'see there'}")
    lines += [f"- {'Correct' if claim.correct else 'Found'}: {value}"] if value else []
    lines.append(f"- Reason: {' '.join(claim.because.split())}")
    lines += [f"- Origin: {claim.explanations[0].name}"] if claim.explanations else []
    lines += [f"- The paper's numbers: {claim.numbers_used}"] if claim.numbers_used else []
    lines.append(f"- Proof: {how}, {proof}; `recontrol explain {claim.paper}/{claim.id}`")
    return [*lines, ""]
