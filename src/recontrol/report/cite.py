"""How to cite a claim or an artifact: a sentence, BibTeX, and the digest that pins it."""

from __future__ import annotations

from pathlib import Path

from recontrol.report import artifacts, bibtex, present, terminal, values
from recontrol.report.claim import Claim
from recontrol.report.collect import Paper
from recontrol.report.unicode import plain


def text(root: Path, identity: str) -> str:
    """Return sentence, BibTeX entries and digests. Raises UnknownNameError for an unknown or ambiguous identity."""
    entry = artifacts.lookup(root, identity)
    paper = Paper(Path(root), entry["paper"])
    if entry["kind"] == "claim":
        claim = terminal.claim(Path(root), entry["identity"])
        words_of = sentence(paper, claim)
    else:
        words_of = _artifact_sentence(paper, entry)
    pinned = entry["digest"] or entry["sha256"]
    lines = [
        words_of,
        "",
        bibtex.of_paper(paper),
        "",
        bibtex.of_artifact(entry["identity"], entry["title"] or "", pinned),
        "",
        f"identity           {entry['identity']}",
        f"digest             {pinned}",
        f"canonical digest   {entry['canonical_digest'] or '-'}",
        f"file               {entry['file']} (SHA-256 {entry['sha256']})",
    ]
    return "\n".join(lines)


def authors(paper: Paper) -> str:
    """Return the authors as a text cites them."""
    names = [str(name).split()[-1] for name in paper.about.get("authors") or [paper.key]]
    who = names[0] if len(names) == 1 else " and ".join(names) if len(names) == 2 else f"{names[0]} et al."
    return f"{who} ({paper.about.get('year', 'n.d.')})"


def sentence(paper: Paper, claim: Claim) -> str:
    """Return one sentence that states a claim, its verdict, and how strongly it is established."""
    finding = claim.decisive
    value = present.found_text(claim, finding) if finding else ""
    printed = " ".join(present.printed_cells(claim)) or (claim.printed or "").strip()
    shown = f", printed as {printed}," if printed and "\n" not in printed and len(printed) <= 40 else ""
    strength = {"exact": "in exact arithmetic", "ball": "in ball arithmetic", "float": "with a stated error bound"}
    how = f" {strength[claim.strength]}" if claim.strength in strength else ""
    found = f"; found: {value}" if value else ""
    scan = ", possibly the scan's" if claim.scanned and claim.verdict == "erratum" else ""
    return plain(
        f"{authors(paper)}, {claim.where}: {claim.title}{shown} is judged “{claim.verdict}”{scan}{how}{found} "
        f"(recontrol {bibtex.version()}, {claim.identity})."
    )


def _artifact_sentence(paper: Paper, entry: artifacts.Entry) -> str:
    title = f", {entry['title']}," if entry["title"] else ""
    value = f" {values.one_line(entry['value'])} {entry['unit'] or ''}".rstrip() if "value" in entry else ""
    return (
        f"{entry['identity']}{title}{value} was computed from the problem data of {authors(paper)} "
        f"by recontrol {bibtex.version()} (stage {entry['stage'] or 'unknown'})."
    )
