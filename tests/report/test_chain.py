"""The rules of report, exports, index, LaTeX and crate on the toy paper."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest


def test_all_makes_the_citable_artifacts(built_toy) -> None:
    results = built_toy.folder / "results"
    for name in ("toy2024/synthesis.mat", "toy2024/series.zip", "index.json", "latex/toy2024-claims.tex"):
        assert (results / name).is_file()
    index = json.loads((results / "index.json").read_text())
    gain = next(entry for entry in index["artifacts"] if entry["identity"] == "toy2024/synthesis/gain/k")
    made = index["files"][gain["file"]]
    assert made["stage"] == "synthesis"
    assert "results/toy2024/model.json" in made["inputs"]
    listed = {entity["@id"] for entity in json.loads((results / "crate/ro-crate-metadata.json").read_text())["@graph"]}
    assert {"Snakefile", "results/toy2024/verdicts.json", "figures/toy2024/decay.csv"} <= listed


@pytest.mark.parametrize(
    ("name", "edit"),
    [
        ("results/report/toy2024.html", True),
        ("results/crate/results/toy2024/verdicts.json", False),
    ],
)
def test_a_page_or_crate_file_that_is_edited_or_deleted_comes_back(toy, name: str, edit: bool) -> None:
    before = toy.artifacts()
    path = toy.folder / name
    if edit:
        path.write_text("by hand")
    else:
        path.unlink()
    output = toy.snakemake("all").stdout
    assert "stands in a folder where a file is wrong or missing" in output
    assert toy.artifacts() == before
    assert "Nothing to be done" in toy.snakemake("all").stdout


def test_the_report_of_snakemake_carries_figures_with_captions(built_toy, tmp_path: Path) -> None:
    page = tmp_path / "audit.html"
    built_toy.snakemake("--report", str(page))
    text = page.read_text(encoding="utf-8")
    assert "State over time." in text
    assert "decay.svg" in text
    assert "results/report/index.html" in text


def test_the_book_of_a_run_can_be_made(toy) -> None:
    command = [sys.executable, "-m", "recontrol.report", "book"]
    environment = {"PYTHONPATH": str(toy.folder / "src"), "PATH": ""}
    result = subprocess.run(command, cwd=toy.folder, env=environment, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == ["VERDICTS.md", "docs/errata/toy2024.md"]
    assert "eq2-k" in Path(toy.folder, "VERDICTS.md").read_text()
