"""The tutorial paper: one folder, no edit elsewhere, and the whole chain agrees with its review."""

from __future__ import annotations

import json
import subprocess
import sys

from projects import ROOT, make_project

from recontrol import contract

FOLDER = ROOT / "docs" / "tutorial" / "made2024"


def test_the_folder_is_valid_and_short() -> None:
    assert contract.check(FOLDER) == 6
    lines = [line for path in FOLDER.glob("*.py") for line in path.read_text().splitlines()]
    assert len(lines) < 250


def test_the_chain_agrees_with_the_review_and_the_certificates_verify(tmp_path) -> None:
    project = make_project(tmp_path / "project", {"made2024": FOLDER})
    project.snakemake("all")
    content = json.loads((project.folder / "results" / "made2024" / "verdicts.json").read_text())
    verdicts = {claim["id"]: (claim["verdict"], claim["strength"]) for claim in content["claims"]}
    assert verdicts["eq4-Ak"][0] == "erratum"
    assert verdicts["eq5-bound"] == ("reproduced-under-assumption", "ball")
    assert verdicts["s4-stable"] == ("erratum", "exact")
    files = sorted((project.folder / "results" / "made2024" / "certificates").glob("*.json"))
    command = [sys.executable, "-m", "recontrol.cli", "verify", *map(str, files)]
    environment = {"PYTHONPATH": str(project.folder / "src"), "PATH": ""}
    result = subprocess.run(
        command, cwd=project.folder, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stdout.count("rebuilt from papers/made2024") == 2
