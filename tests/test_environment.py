"""Setting up: what is refused before anything is made, and what a failing step says."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections import namedtuple
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

import environment

Usage = namedtuple("Usage", "total used free")


@pytest.fixture
def lock(tmp_path: Path) -> Path:
    """A lock without packages."""
    path = tmp_path / "some.lock"
    path.write_text("")
    return path


def refused(*arguments: Path) -> str:
    """The message with which making an environment stops."""
    with pytest.raises(SystemExit) as stopped:
        environment.main([str(argument) for argument in arguments])
    return str(stopped.value)


@pytest.mark.parametrize("version", [(3, 10, 4), (3, 14, 0)])
def test_a_python_without_wheels_is_refused_with_the_way_out(tmp_path, lock, monkeypatch, version):
    monkeypatch.setattr(environment.sys, "version_info", version)
    said = refused(tmp_path / "venv", lock)
    assert f"this is Python {version[0]}.{version[1]}" in said
    assert "make PYTHON=" in said
    assert not (tmp_path / "venv").exists()


def test_a_full_disk_is_refused_before_anything_is_made(tmp_path, lock, monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: Usage(0, 0, 100 * 2**20))
    said = refused(tmp_path / "venv", lock)
    assert "100 MB free" in said
    assert f"needs {environment.DISK_MB} MB" in said
    assert not (tmp_path / "venv").exists()


def test_a_place_that_does_not_exist_is_named(tmp_path, lock):
    assert f"{tmp_path / 'nowhere'} does not exist" in refused(tmp_path / "nowhere" / "venv", lock)


@pytest.mark.parametrize(
    ("failing", "said"),
    [("venv", "install python3-venv"), ("install", "run the same command again"), ("check", "lock")],
)
def test_a_failing_step_says_what_to_do_and_leaves_no_stamp(tmp_path, lock, monkeypatch, capsys, failing, said):
    def step(command, env=None):
        if "venv" in command:
            Path(command[-1]).mkdir()
        return subprocess.CompletedProcess(command, 7 if failing in command else 0)

    monkeypatch.setattr(environment.subprocess, "run", step)
    message = refused(tmp_path / "venv", lock)
    assert "exit code 7" in message
    assert said in message
    assert not (tmp_path / "venv/complete").exists()
    assert "environment: new virtual environment" in capsys.readouterr().out
