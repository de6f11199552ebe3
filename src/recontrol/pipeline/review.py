"""Hold a finished run against the review: expected verdicts, and figure data against their references."""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

from recontrol import paper as papers
from recontrol.claims import schema
from recontrol.errors import ArtifactError
from recontrol.pipeline import regression, store
from recontrol.pipeline.encode import dumps
from recontrol.pipeline.layout import artifact, figure_file, reference_file


@dataclass(frozen=True)
class Difference:
    """One thing that is not as reviewed."""

    paper: str
    item: str
    expected: str
    found: str

    def row(self) -> str:
        """One line of the table that `check` prints."""
        return f"{self.paper:<12} {self.item:<28} expected {self.expected:<28} found {self.found}"


def differences(key: str) -> tuple[list[Difference], int]:
    """Differences of one paper, and the number of claims and figures that were checked."""
    paper = papers.load(Path("papers") / key)
    claims, found = _verdicts(paper)
    figures, drawn = _figures(paper)
    return claims + figures, found + drawn


def _verdicts(paper: papers.Paper) -> tuple[list[Difference], int]:
    try:
        records = {record["id"]: record for record in store.read_json(artifact(paper.key, "verdicts"))["claims"]}
    except ArtifactError as error:
        return [Difference(paper.key, "verdicts", "a table of verdicts", str(error))], 0
    result = []
    claims = schema.load(paper)
    for claim in claims:
        record = records.pop(claim.id, None)
        verdict = record["verdict"] if record else "missing from verdicts.json"
        if verdict != claim.expected.verdict:
            errors = [f["error"] for f in (record or {}).get("findings", []) if f.get("error")]
            found = f"{verdict} ({errors[0]})" if errors else verdict
            result.append(Difference(paper.key, claim.id, claim.expected.verdict, found))
        elif claim.expected.explained_by and record and record["explained_by"] != claim.expected.explained_by:
            result.append(
                Difference(
                    paper.key, claim.id, f"explained by {claim.expected.explained_by}", str(record["explained_by"])
                )
            )
    result += [Difference(paper.key, name, "no such claim", "a stale record") for name in records]
    return result, len(claims)


def _figures(paper: papers.Paper) -> tuple[list[Difference], int]:
    result = []
    for name, entry in paper.file.figures.items():
        reference = reference_file(paper.folder, name)
        if not reference.exists():
            why = f"no file; `python -m recontrol.pipeline reference {paper.key} {name} --why ...` writes it"
            result.append(Difference(paper.key, name, f"{reference}", why))
            continue
        try:
            found = regression.parse(store.read_bytes(figure_file(paper.key, name, "csv")), name)
        except ArtifactError as error:
            result.append(Difference(paper.key, name, "figure data", str(error)))
            continue
        expected = regression.read(reference)
        looser = {curve: float(tolerance) for curve, tolerance in entry.looser.items()}
        bad = [d for d in regression.compare(found, expected, float(entry.tolerance), looser) if not d.agrees]
        if bad:
            picture = _draw_drift(paper.key, name, expected, found)
            result += [
                Difference(
                    paper.key,
                    f"{name}: {drift.curve}"[:28],
                    f"drift <= {drift.tolerance:g}",
                    f"{drift.why} {'' if drift.difference is None else format(drift.difference, '.3g')}; see {picture}",
                )
                for drift in bad
            ]
    return result, len(paper.file.figures)


def _draw_drift(key: str, name: str, expected: regression.Curves, found: regression.Curves) -> Path:
    from recontrol import plotting

    stem = Path("run/drift") / key / name
    stem.parent.mkdir(parents=True, exist_ok=True)
    return plotting.save(plotting.drift_picture(expected, found, f"{key} {name}"), stem, ("png",))[0]


def report(keys: list[str]) -> int:
    """Print the table of differences; 0 only if something was checked and nothing differs."""
    total, rows = 0, []
    for key in keys:
        found, checked = differences(key)
        rows += found
        total += checked
    for row in rows:
        print(row.row())
    print(f"{total} claims and figures checked, {len(rows)} differ from the review")
    if not total:
        print("nothing was checked: that is a failure, not a success", file=sys.stderr)
    return 1 if rows or not total else 0


def main(arguments: list[str]) -> int:
    """Command line: PAPER ... [--stamp]; with --stamp a clean review of one paper is recorded as an artifact."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline review")
    parser.add_argument("papers", nargs="*")
    parser.add_argument("--stamp", action="store_true")
    options = parser.parse_args(arguments)
    status = report(options.papers)
    if options.stamp and status == 0:
        for key in options.papers:
            content = {"paper": key, "differences": 0, "checked": differences(key)[1]}
            store.publish(
                {artifact(key, "review").as_posix(): dumps(content).encode()}, {"stage": "review", "paper": key}
            )
    return status
