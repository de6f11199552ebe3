"""Faults injected into whole runs: a clear message, recovery by the plain command, final bytes equal to a clean run.

RECONTROL_KILLS sets the number of kills (default 20); with RECONTROL_FAULT_PAPERS=all they are made in runs of
all papers as well as of the toy.
"""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from projects import ROOT, Project, make_project

from recontrol import paper as papers

KILLS = int(os.environ.get("RECONTROL_KILLS", "20"))
ALL_PAPERS = os.environ.get("RECONTROL_FAULT_PAPERS") == "all"
IN_A_ROW = {"toy": 5, "all papers": 10}
"""Kills of one rebuild."""
LONGEST = 3600.0
"""Seconds that a run of all papers may take on a busy machine."""


REBUILDS = [
    pytest.param(name, number, id=f"{name}-{number}")
    for name in (IN_A_ROW if ALL_PAPERS else ["toy"])
    for number in range(-(-KILLS // IN_A_ROW[name]))
]


@pytest.fixture(scope="module")
def subject(request, tmp_path_factory) -> tuple[Project, dict[str, bytes], float, int]:
    """A project to break, the artifacts of its clean run, how long that run takes, and the kills of one rebuild."""
    if request.param == "toy":
        folders = {"toy2024": ROOT / "tests/toy/toy2024"}
    else:
        folders = {key: ROOT / "papers" / key for key in papers.discover(ROOT)}
    project = make_project(tmp_path_factory.mktemp("faults") / "project", folders)
    begin = time.monotonic()
    project.snakemake("all", timeout=LONGEST)
    return project, project.artifacts(), time.monotonic() - begin, IN_A_ROW[request.param]


@pytest.mark.timeout(8 * LONGEST if ALL_PAPERS else 900)
@pytest.mark.parametrize(("subject", "rebuild"), REBUILDS, indirect=["subject"])
def test_killed_at_seeded_moments(subject, rebuild, record_property):
    """kill -9 of the whole run, or of Snakemake alone so that its stages live on, as a rebuild goes on

    Every kill is followed by the plain command, the last one to the end.
    """
    project, clean, duration, in_a_row = subject
    kills = min(in_a_row, KILLS - rebuild * in_a_row)
    for name in ("results", "figures"):
        shutil.rmtree(project.folder / name, ignore_errors=True)
    rng = random.Random(rebuild)
    for _ in range(kills):
        kill(project, rng, duration * rng.uniform(0.2, 1.8) / in_a_row)
    project.snakemake("all", timeout=LONGEST)
    record_property("cases", kills)
    made = project.artifacts()
    assert {name for name in made.keys() | clean.keys() if made.get(name) != clean.get(name)} == set()


def kill(project: Project, rng: random.Random, seconds: float) -> None:
    """One kill of a live run; a run that finishes before its moment is begun anew from nothing."""
    while True:
        run = project.start("all", output=subprocess.DEVNULL)
        time.sleep(seconds)
        if run.poll() is None:
            break
        shutil.rmtree(project.folder / "results")
        seconds /= 2
    if rng.random() < 0.5:
        os.killpg(run.pid, signal.SIGKILL)
    else:
        run.kill()
    run.wait()


@pytest.mark.parametrize("damage", ["truncated", "empty", "garbage", "swapped"])
def test_damaged_artifact(toy, damage):
    """An artifact cut short, emptied, overwritten with noise, or replaced by another one."""
    clean = toy.artifacts()
    path = toy.folder / "results/toy2024/simulation/decay.npz"
    content = path.read_bytes()
    other = (toy.folder / "results/toy2024/model.json").read_bytes()
    path.write_bytes(
        {"truncated": content[: len(content) // 2], "empty": b"", "garbage": os.urandom(500), "swapped": other}[damage]
    )
    result = toy.snakemake("all")
    assert "decay.npz differs from its record" in result.stdout
    assert toy.artifacts() == clean


def test_lost_records(toy):
    """All records of provenance deleted: nothing unproven is used, everything is built anew."""
    clean = toy.artifacts()
    shutil.rmtree(toy.folder / "run/provenance")
    result = toy.snakemake("all")
    assert "has no record of who made it" in result.stdout
    assert toy.artifacts() == clean


@pytest.mark.parametrize("year", [1990, 2090])
def test_clock_far_off(toy, year):
    """Sources or results carry times decades away."""
    clean = toy.artifacts()
    moment = (year - 1970) * 365.25 * 86400
    for path in [
        *(toy.folder / "results").rglob("*"),
        *(toy.folder / "papers").rglob("*"),
        *(toy.folder / "src").rglob("*.py"),
    ]:
        os.utime(path, (moment, moment))
    toy.edit("papers/toy2024/helper.py", "FACTOR = 5", "FACTOR = 5  # the same")
    os.utime(toy.folder / "papers/toy2024/helper.py", (moment + 60, moment + 60))
    toy.snakemake("all")
    made, basis = toy.artifacts(), "results/toy2024/ensemble-basis.json"
    assert made.pop(basis) != clean.pop(basis)  # it holds the digest of the edited source
    assert made == clean


def test_results_dated_in_the_future_do_not_hide_an_edit(toy):
    """Results from a machine whose clock was ahead: an edit made now still reruns what depends on it."""
    for path in (toy.folder / "results").rglob("*.*"):
        os.utime(path, (time.time() + 1e6, time.time() + 1e6))
    toy.edit("papers/toy2024/helper.py", "FACTOR = 5", "FACTOR = 6")
    result = toy.snakemake("toy2024", check=False)
    assert "carries a time in the future" in result.stdout
    assert "eq2-k" in result.stdout
    assert '"3/2"' in (toy.folder / "results/toy2024/synthesis/gain.json").read_text()


@pytest.fixture
def small_disk(fresh_toy):
    """An unbuilt toy whose results lie on a file system of its own; yields (project, remount)."""
    project = fresh_toy("small")
    results = project.folder / "results"
    results.mkdir()

    def mount(options: str) -> None:
        command = ["mount", "-t", "tmpfs", "-o", options, "none", str(results)]
        if subprocess.run(command, capture_output=True).returncode:
            pytest.skip("a tmpfs cannot be mounted here")

    def unmount() -> None:
        subprocess.run(["umount", "-l", str(results)], capture_output=True)

    yield project, mount, unmount
    unmount()


@pytest.mark.parametrize(
    ("options", "words"), [("size=8k", "No space left on device"), ("ro,size=1m", "Read-only file system")]
)
def test_results_cannot_be_written(small_disk, built_toy, options, words):
    """A full or read-only disk under results/: the cause and the way out are named, nothing is half-written."""
    project, mount, unmount = small_disk
    mount(options)
    result = project.snakemake("all", check=False)
    assert result.returncode != 0
    assert words in result.stdout
    assert not list((project.folder / "results").rglob("*.part"))
    unmount()
    project.snakemake("all")
    assert project.artifacts() == built_toy.artifacts()


def test_half_made_environment_is_built_again(tmp_path):
    """An environment without its stamp is cleared, whatever it holds."""
    lock = tmp_path / "empty.lock"
    lock.write_text("")
    venv = tmp_path / "venv"
    (venv / "bin").mkdir(parents=True)
    (venv / "bin/python").write_text("broken")
    script = ROOT / "tools/environment.py"
    for content, said in (("", "unfinished or outdated"), ("", ""), ("# another lock\n", "unfinished or outdated")):
        lock.write_text(content)
        result = run_python(script, str(venv), str(lock))
        assert result.returncode == 0, result.stdout + result.stderr
        assert (said in result.stdout) if said else not result.stdout
        assert (venv / "complete").exists()


def test_unreadable_lock_leaves_no_environment(tmp_path):
    """A lock that pip refuses: the step that failed is named, and no stamp is left."""
    lock = tmp_path / "bad.lock"
    lock.write_text("six==1.16.0 \\\n    --hash=sha256:zz\n")
    result = run_python(ROOT / "tools/environment.py", str(tmp_path / "venv"), str(lock))
    assert result.returncode != 0
    assert "packages of" in result.stderr
    assert not (tmp_path / "venv/complete").exists()
    lock.write_text("")
    assert run_python(ROOT / "tools/environment.py", str(tmp_path / "venv"), str(lock)).returncode == 0
    assert (tmp_path / "venv/complete").exists()


def run_python(script: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    import sys

    command = [sys.executable, str(script), *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
