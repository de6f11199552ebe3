"""Write the reviewed reference data of figures into the paper folder, with the reason."""

from __future__ import annotations

import argparse
from pathlib import Path

from recontrol import paper as papers
from recontrol.errors import StageError
from recontrol.pipeline import regression, store
from recontrol.pipeline.figure import curves_to_csv
from recontrol.pipeline.layout import figure_file, reference_file


def renew(key: str, figures: list[str], why: str) -> list[Path]:
    """Decimate figures/<key>/<name>.csv of the last run into papers/<key>/reference/, and note why.

    Raises StageError without a reason or for an unknown figure, ArtifactError if a figure is not built.
    """
    paper = papers.load(Path("papers") / key)
    names = figures or list(paper.file.figures)
    unknown = [name for name in names if name not in paper.file.figures]
    if unknown:
        raise StageError(f"papers/{key}/paper.yaml: no figure {unknown[0]!r}")
    if len(why.split()) < 3:
        raise StageError("--why: say in a few words why the reference changes; it is kept beside the data")
    written = []
    for name in names:
        curves = regression.parse(store.read_bytes(figure_file(key, name, "csv")), name)
        path = reference_file(paper.folder, name)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(curves_to_csv(regression.decimate(curves), str(path)))
        written.append(path)
    reasons = paper.folder / "reference" / "REASONS.md"
    head = "" if reasons.exists() else "# Why each reference was written or renewed\n\n"
    with reasons.open("a", encoding="utf-8") as file:
        file.write(f"{head}- {', '.join(names)}: {' '.join(why.split())}\n")
    return written


def main(arguments: list[str]) -> int:
    """Command line: PAPER [FIGURE ...] --why TEXT."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline reference", description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("figures", nargs="*")
    parser.add_argument("--why", required=True)
    options = parser.parse_args(arguments)
    for path in renew(options.paper, options.figures, options.why):
        print(path)
    return 0
