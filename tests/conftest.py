"""Fixtures shared by all tests: pinned threads, and small projects to run the chain in."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from projects import ROOT, Project, make_project

from recontrol.pipeline import environment

environment.pin()


@pytest.fixture(scope="session")
def built_toy(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The toy paper, built once by `all`; tests copy it."""
    toy = make_project(tmp_path_factory.mktemp("toy") / "project", {"toy2024": ROOT / "tests/toy/toy2024"})
    toy.snakemake("all")
    return toy


@pytest.fixture
def toy(built_toy: Project, tmp_path: Path) -> Project:
    """A copy of the built toy project that a test may break."""
    shutil.copytree(built_toy.folder, tmp_path / "project")
    return Project(tmp_path / "project")


@pytest.fixture
def fresh_toy(tmp_path: Path) -> Callable[[str], Project]:
    """A maker of unbuilt toy projects."""
    return lambda name: make_project(tmp_path / name, {"toy2024": ROOT / "tests/toy/toy2024"})
