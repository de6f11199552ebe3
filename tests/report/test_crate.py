"""The crate of a run: complete, the same bytes each time, and valid by the validator of its profile."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import contexts
import fake
import pytest

from recontrol.report import crate

PROFILE = "workflow-run-crate-0.5"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = fake.write(tmp_path_factory.mktemp("crate"))
    (root / "config").mkdir()
    (root / "config" / "config.yaml").write_text("solver: clarabel\n")
    (root / "Snakefile").write_text("rule all:\n")
    (root / "environment.lock").write_text("numpy==2.4.6\n")
    (root / "CITATION.cff").write_text("cff-version: 1.2.0\n")
    crate.build(root, [fake.KEY], root / "results" / "crate")
    return root


def validate(folder: Path, cache: Path) -> tuple[int, dict]:
    options = ["--no-paging", "-p", PROFILE, "--offline", "--cache-path", str(cache), "-f", "json", "-o", "found.json"]
    command = [
        Path(sys.executable).with_name("rocrate-validator"),
        "-y",
        "--disable-color",
        "validate",
        folder,
        *options,
    ]
    result = subprocess.run(command, cwd=cache.parent, capture_output=True, text=True, check=False, timeout=120)
    found = cache.parent / "found.json"
    assert found.is_file(), result.stdout + result.stderr
    return result.returncode, json.loads(found.read_text())


def test_the_crate_is_valid_without_network(project: Path, tmp_path: Path) -> None:
    code, found = validate(project / "results" / "crate", contexts.seed(tmp_path / "cache"))
    assert found["issues"] == []
    assert code == 0


def test_a_crate_with_a_missing_file_is_refused(project: Path, tmp_path: Path) -> None:
    target = tmp_path / "crate"
    crate.build(project, [fake.KEY], target)
    (target / "results" / fake.KEY / "verdicts.json").unlink()
    code, found = validate(target, contexts.seed(tmp_path / "cache"))
    assert code != 0
    assert any("verdicts.json" in issue["message"] for issue in found["issues"])


def test_everything_listed_is_there_and_everything_there_is_listed(project: Path) -> None:
    folder = project / "results" / "crate"
    graph = json.loads((folder / "ro-crate-metadata.json").read_text())["@graph"]
    listed = {entity["@id"] for entity in graph if "File" in entity["@type"]}
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert there - {"ro-crate-metadata.json"} == listed
    assert f"results/{fake.KEY}/certificates/loop-full.json" in listed
    action = next(entity for entity in graph if entity["@id"] == "#run")
    assert len(action["object"]) + len(action["result"]) == len(listed) - 1


def test_equal_runs_give_equal_metadata(project: Path, tmp_path: Path) -> None:
    crate.build(project, [fake.KEY], tmp_path / "again")
    name = "ro-crate-metadata.json"
    assert (tmp_path / "again" / name).read_bytes() == (project / "results" / "crate" / name).read_bytes()
