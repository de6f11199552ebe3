"""What the command line prints about papers and claims; reads artifacts as the report does, and loads no numpy."""

from __future__ import annotations

import textwrap
from pathlib import Path

from recontrol.errors import UnknownNameError
from recontrol.report import present, words
from recontrol.report.claim import Claim, Finding
from recontrol.report.collect import Paper
from recontrol.report.unicode import plain

WIDTH = 100


def papers(root: Path) -> list[str]:
    """Return the keys of the paper folders. Raises UnknownNameError if ``root`` holds none."""
    keys = sorted(path.parent.name for path in (root / "papers").glob("*/paper.yaml"))
    if not keys:
        place = root.resolve()
        raise UnknownNameError(f"{place}: no paper folder (papers/<key>/paper.yaml); go to the project or give -C DIR")
    return keys


def paper(root: Path, key: str) -> Paper:
    """Return a paper by its key. Raises UnknownNameError."""
    known = papers(root)
    if key not in known:
        raise UnknownNameError(f"no paper {key!r}; papers: {', '.join(known)}")
    return Paper(root, key)


def claim(root: Path, identity: str) -> Claim:
    """Return a claim by ``paper/claims/id`` or ``paper/id``. Raises UnknownNameError with near matches."""
    key, _, rest = identity.partition("/")
    name = rest.removeprefix("claims/")
    if not name:
        raise UnknownNameError(f"{identity!r} names no claim; write PAPER/CLAIM, such as {papers(root)[0]}/eq1")
    claims = {claim.id: claim for claim in paper(root, key).claims}
    if name not in claims:
        near = [
            other for other in claims if name.lower() in other.lower() or other.lower().startswith(name[:4].lower())
        ]
        hint = f"; near it: {', '.join(near[:8])}" if near else f"; `recontrol show {key}` lists the claims"
        raise UnknownNameError(f"{key} has no claim {name!r}{hint}")
    return claims[name]


def list_papers(root: Path) -> str:
    """Return one line a paper: key, number of claims, verdict counts."""
    lines = []
    for key in papers(root):
        found = Paper(root, key)
        made = (found.results / "verdicts.json").is_file()
        counts = ", ".join(f"{n} {words.counted(name)}" for name, n in found.counts.items())
        lines.append(f"{key:<14}{len(found.claims):>4} claims   {counts if made else 'not run yet'}")
        lines.append(f"{'':<14}{found.about.get('title', '')}")
    return plain("\n".join(lines))


def show_paper(root: Path, key: str) -> str:
    """Return identity, advice and the table of claims of a paper."""
    found = paper(root, key)
    about = found.about
    made = (found.results / "verdicts.json").is_file()
    lines = [f"{', '.join(about.get('authors') or [])}: {about.get('title', '')}", about.get("venue", "")]
    lines += [f"DOI {about['doi']}"] if about.get("doi") else []
    lines += ["", *wrap(about.get("use", ""), "May I use it? "), ""]
    if not made:
        lines += ["This paper has not been run: `snakemake --cores 2 " + key + "` makes its verdicts.", ""]
    width = max([len(claim.id) for claim in found.claims] + [5]) + 2
    place = min(max([len(claim.where) for claim in found.claims] + [5]) + 2, 24)
    lines.append(f"{'claim':<{width}}{'place':<{place}}{'verdict' if made else 'reviewed':<18}{'strength':<10}title")
    for item in found.claims:
        verdict = words.verdict(item.verdict if made else item.expected)
        scan = "*" if item.scanned and item.verdict == "erratum" else ""
        lines.append(
            f"{item.id:<{width}}{shorten(item.where, place - 2):<{place}}"
            f"{verdict.label + scan:<18}{item.strength or '-':<10}{item.title}"
        )
    if any(item.scanned for item in found.claims):
        lines.append("* may be the scan's")
    return plain("\n".join(line.rstrip() for line in lines))


def explain(root: Path, identity: str) -> str:
    """Return everything about one claim: place, print, readings with distances, and the rule behind the verdict."""
    found = claim(root, identity)
    verdict = found.words
    facts = [found.strength or "", "may be the scan's" if found.scanned else ""]
    lines = [
        f"{found.identity}   {found.where}",
        found.title,
        "",
        *block("printed", _printed(found) + ([f"[{found.unit}]"] if _shown(found.unit) else [])),
        *block("correct", [found.correct] if found.correct else []),
        *block("verdict", [" ".join([verdict.label, *(f"({fact})" for fact in facts if fact)])]),
        *block("rule", wrap(verdict.rule)),
        *block("reviewed", [words.verdict(found.expected).label + (" (differs!)" if found.drifted else "")]),
        *block("because", wrap(" ".join(filter(None, [found.because, present.summary(found)])))),
        *block("missing", [", ".join(found.missing)] if found.missing else []),
    ]
    for finding in found.findings:
        lines += ["", *_reading(found, finding)]
    if not found.findings:
        lines += ["", "No reading has run: `snakemake --cores 2 " + found.paper + "` makes the verdicts."]
        lines += [f"  {name}   {place}" for name, place in _places(found)]
    return plain("\n".join(line.rstrip() for line in lines))


def _places(found: Claim) -> list[tuple[str, str]]:
    """Return (reading, its function in words) as claims.yaml names them."""
    named = []
    for entry in found.entry.get("readings") or []:
        topic, _, function = str(entry.get("function", "")).rpartition(".")
        module = f"papers/{found.paper}/readings{'/' if topic else ''}{topic}.py"
        named.append((str(entry.get("name", "?")), f"{function} in {module}"))
    return named


def _printed(found: Claim) -> list[str]:
    """Return the print line by line; cells that the claim is not about are dots, as in what was found."""
    lines = (found.printed or "").splitlines()
    if len(present.printed_cells(found)) in (0, sum(len(row) for row in found.rows or [])):
        return lines
    counted = present.is_counted
    return [
        " ".join(text if counted(found, i, j) else "." for j, text in enumerate(row))
        for i, row in enumerate(found.rows or [])
    ]


def _shown(unit: str) -> bool:
    return unit not in ("", "1", "-")


def _reading(claim: Claim, finding: Finding) -> list[str]:
    _, word = words.AGREES[finding.agrees]
    off = present.distance_text(finding)
    digits = present.digits_text(finding)
    facts = [
        f"{finding.kind}: {word}",
        finding.strength or "",
        f"{off} last-place units off" if off else "",
        f"{digits} digits agree" if digits else "",
        "explains the print" if finding.name in claim.explained_by else "",
    ]
    lines = [f"{finding.name}   " + ", ".join(fact for fact in facts if fact)]
    lines += _value(claim, finding)
    for name, case in finding.cases:
        inner = present.case_finding(finding, case)
        lines.append(f"  case {name}: {words.AGREES[inner.agrees][1]}, {present.found_text(claim, inner)}")
    if finding.source:
        lines.append(f"  at {finding.source[0]}:{finding.source[1]}")
    if finding.note:
        lines.append(f"  note {finding.note} in papers/{claim.paper}/NOTES.md")
    if finding.certificate:
        lines.append(f"  proof: recontrol verify results/{claim.paper}/certificates/{finding.certificate}.json")
    return lines


def _value(claim: Claim, finding: Finding) -> list[str]:
    if finding.error:
        return ["  " + line for line in finding.error.strip().splitlines()]
    if isinstance(finding.value, str) and not finding.cases:
        rows = [line.split() for line in finding.value.splitlines()]
        if len(rows) > 1 and len({len(row) for row in rows}) == 1:
            widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
            return ["  " + "  ".join(cell.rjust(w) for cell, w in zip(row, widths, strict=True)) for row in rows]
        return [f"  found {finding.value}"]
    text = "" if finding.cases else present.found_text(claim, finding)
    return [f"  found {text}"] if text else []


def shorten(text: str, width: int) -> str:
    """Return ``text`` cut to ``width`` with an ellipsis."""
    return text if len(text) <= width else text[: width - 1] + "…"


def wrap(text: str, lead: str = "") -> list[str]:
    """Return a paragraph as lines."""
    return textwrap.wrap(lead + " ".join(text.split()), WIDTH - 12)


def block(name: str, lines: list[str]) -> list[str]:
    """Return lines with a name before the first; nothing for none."""
    return [f"{name if k == 0 else '':<10}{line}" for k, line in enumerate(lines)]
