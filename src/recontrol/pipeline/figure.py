"""Draw one figure of a paper: SVG, PDF, PNG, and the plotted data beside them as CSV."""

from __future__ import annotations

import argparse
import csv
import io
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from recontrol.errors import StageError
from recontrol.pipeline import inputs, job
from recontrol.pipeline.layout import figure_file


def run(key: str, figure: str) -> None:
    """Call the figure's function and publish its four files."""
    from recontrol import plotting

    paper = job.open_paper(key)
    if figure not in paper.file.figures:
        raise StageError(f"papers/{key}/paper.yaml: no figure {figure!r}; figures: {', '.join(paper.file.figures)}")
    function = inputs.function_of(key, "figures", figure)
    result = inputs.Inputs(paper, inputs.load_config(), inputs.before("figure")).call(function)
    home = inputs.where(function)
    if not (isinstance(result, tuple) and len(result) == 2):
        raise StageError(f"{home}: a figure function returns (figure, curves)")
    drawing, curves = result
    contents = {figure_file(key, figure, "csv"): curves_to_csv(curves, home)}
    with tempfile.TemporaryDirectory() as folder:
        for path in plotting.save(drawing, Path(folder, figure)):
            contents[figure_file(key, figure, path.suffix[1:])] = path.read_bytes()
    job.publish("figure", key, figure, contents, inputs.earlier(paper, "figure"))


def curves_to_csv(curves: Mapping[str, Any], home: str) -> bytes:
    """CSV with columns curve, x, y. Raises StageError for empty, unequal or non-finite data."""
    import numpy as np

    if not isinstance(curves, Mapping) or not curves:
        raise StageError(f"{home}: a figure returns its plotted curves, label -> (x, y)")
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["curve", "x", "y"])
    for label, pair in curves.items():
        x, y = (np.asarray(axis, dtype=float).ravel() for axis in pair)
        if x.shape != y.shape or not x.size:
            raise StageError(f"{home}: curve {label!r} has {x.size} x and {y.size} y values")
        if not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
            raise StageError(f"{home}: curve {label!r} is not finite everywhere")
        writer.writerows([label, repr(float(a)), repr(float(b))] for a, b in zip(x, y, strict=True))
    return text.getvalue().encode()


def main(arguments: list[str]) -> int:
    """Command line: PAPER FIGURE."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline figure")
    parser.add_argument("paper")
    parser.add_argument("figure")
    options = parser.parse_args(arguments)
    run(options.paper, options.figure)
    return 0
