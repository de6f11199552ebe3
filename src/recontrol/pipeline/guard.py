"""Before the chain runs: one run at a time, and no artifact is used that differs from its record."""

from __future__ import annotations

import fcntl
import os
import re
import sys
import time
import uuid
from pathlib import Path
from typing import IO, Any

from recontrol.errors import RecontrolError
from recontrol.pipeline import store

LOCK = Path("run/lock")
SOURCES = ("Snakefile", "environment.lock", "config", "rules", "papers", "src")
WHOLE = {"results/report": "index.html", "results/crate": "ro-crate-metadata.json"}
"""Folders made as a whole by a rule that declares one file: if any file of one is wrong, all of it is made again."""
LOOKING = re.compile(
    r"-[a-zA-Z]*n[a-zA-Z]*|--(dry-?run|lint|report|dag|rulegraph|filegraph|d3dag|list.*|summary|detailed-summary|"
    r"unlock|delete-all-output|delete-temp-output|help|version|generate-unit-tests|print-compilation|containerize|"
    r"cleanup-.*|archive)(=.*)?"
)
_held: list[IO[str]] = []


def only_looking(arguments: list[str]) -> bool:
    """True if the command line asks to show something rather than to build."""
    return any(LOOKING.fullmatch(argument) for argument in arguments)


def enter(arguments: list[str] | None = None) -> None:
    """Take the lock of this working directory and set untrusted artifacts aside.

    The lock is the kernel's (flock): it goes with the process that holds it, even if that is killed. Raises
    RecontrolError in words if another run holds it. A command that only looks names the artifacts and touches nothing.
    """
    look = only_looking(sys.argv[1:] if arguments is None else arguments)
    if not look:
        _lock()
    for path in _dated_in_the_future():
        print(f"recontrol: {path} carries a time in the future (a clock was off); taken as of now", file=sys.stderr)
        if not look:
            os.utime(path)
    wrong = store.untrusted()
    wrong += [(path, "stands in a folder where a file is wrong or missing") for path in _spoiled(wrong)]
    for path, reason in wrong:
        if look:
            print(f"recontrol: {path} {reason}; a run will rebuild it", file=sys.stderr)
        elif path.exists():
            print(f"recontrol: {path} {reason}; moved to {store.set_aside(path)}, will be rebuilt", file=sys.stderr)


def lift_rate_limit(workflow: Any) -> None:
    """Take Snakemake's limit of jobs a second off a run on this machine, where nothing is submitted to anybody.

    With the limit, every choice of a job starts a timer whose end is another choice, so that the scheduler wakes the
    more often the more jobs have run, and each time asks for the size of every input of every job that could run.
    """
    scheduler = workflow.scheduler
    if workflow.local_exec and hasattr(scheduler, "job_rate_limiter"):
        scheduler.job_rate_limiter = None


def _dated_in_the_future() -> list[Path]:
    """Sources that Snakemake would take for newer than anything it makes."""
    limit = time.time() + store.CLOCK_SLACK
    paths = [path for top in SOURCES for path in ([Path(top)] if Path(top).is_file() else Path(top).rglob("*"))]
    return sorted(path for path in paths if path.is_file() and path.stat().st_mtime > limit)


def _spoiled(wrong: list[tuple[Path, str]]) -> list[Path]:
    """Declared files of folders in which some other file is wrong or missing."""
    found = []
    for name, file in WHOLE.items():
        folder, known = Path(name), {path for path, _ in wrong}
        inside = any(path.is_relative_to(folder) for path in known)
        if (folder / file).exists() and folder / file not in known and (inside or _missing(folder)):
            found.append(folder / file)
    return found


def _missing(folder: Path) -> list[Path]:
    """Recorded files of a folder that do not exist."""
    records = (store.RECORDS / folder).rglob("*.json")
    return [file for record in records if not (file := record.relative_to(store.RECORDS).with_suffix("")).exists()]


def _lock() -> None:
    LOCK.parent.mkdir(parents=True, exist_ok=True)
    file = LOCK.open("a+")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        file.seek(0)
        holder = file.read().strip()
        file.close()
        raise RecontrolError(
            f"another run is going on in this directory (process {holder or 'unknown'}); "
            "wait until it has finished, or stop it, then run the same command again"
        ) from None
    file.truncate(0)
    file.write(str(os.getpid()))
    file.flush()
    _held.append(file)
    os.environ["RECONTROL_RUN"] = uuid.uuid4().hex
    Path("run/current").write_text(os.environ["RECONTROL_RUN"])
