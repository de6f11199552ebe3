"""A SLURM of one node on the loopback interface, from Debian's slurmctld, slurmd, slurm-client and munge.

Needs root: the daemons run as it, and the configuration has to stand in /etc/slurm, since the executor plugin clears
the variables that could name another place. A configuration that is there already is never touched.
"""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "sinfo")
CONFIGURATION = Path("/etc/slurm/slurm.conf")
MARK = "# made by tests/slurm\n"
EXTRA_PATH = "/usr/sbin:/sbin"


def missing() -> str | None:
    """Why no cluster can be started here, or None."""
    path = os.pathsep.join([os.environ.get("PATH", ""), EXTRA_PATH])
    absent = [name for name in PROGRAMS if shutil.which(name, path=path) is None]
    if absent:
        return f"{', '.join(absent)} not installed (Debian: slurmctld slurmd slurm-client munge)"
    if os.geteuid():
        return "starting the daemons needs root"
    if CONFIGURATION.exists() and not CONFIGURATION.read_text().startswith(MARK):
        return f"{CONFIGURATION} belongs to another cluster"
    return None


class Cluster:
    """`with Cluster(folder):` the node is idle; on leaving, its daemons are stopped by their pid files."""

    def __init__(self, home: Path):
        self.home = home

    def __enter__(self) -> Cluster:
        for name in ("state", "spool", "log", "run"):
            (self.home / name).mkdir(parents=True, exist_ok=True)
        self._start_munge()
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20 * 2 // 3
        template = (Path(__file__).parent / "slurm.conf.in").read_text()
        text = template.format(host=socket.gethostname().split(".")[0], home=self.home, memory=memory)
        CONFIGURATION.parent.mkdir(exist_ok=True)
        CONFIGURATION.write_text(MARK + text)
        try:
            for daemon in ("slurmctld", "slurmd"):
                _run([daemon])
            self._wait_until_idle()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        for name in ("slurmd", "slurmctld", "munged"):
            _stop(self.home / "run" / f"{name}.pid")
        if CONFIGURATION.exists() and CONFIGURATION.read_text().startswith(MARK):
            CONFIGURATION.unlink()

    def _start_munge(self) -> None:
        key = self.home / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        run, log = self.home / "run", self.home / "log"
        places = {"key-file": key, "socket": run / "munge.socket", "pid-file": run / "munged.pid"}
        places |= {"log-file": log / "munged.log", "seed-file": run / "munge.seed"}
        _run(["munged", "--force", *(f"--{name}={path}" for name, path in places.items())])

    def _wait_until_idle(self, seconds: float = 60.0) -> None:
        end = time.monotonic() + seconds
        while _run(["sinfo", "-h", "-o", "%t"], check=False).strip() != "idle":
            if time.monotonic() > end:
                raise TimeoutError(f"the node did not become idle; see {self.home / 'log'}")
            time.sleep(0.5)


def running_jobs() -> list[str]:
    """Numbers of the jobs that run now."""
    return _run(["squeue", "-h", "-t", "RUNNING", "-o", "%i"]).split()


def cancel(job: str) -> None:
    """Kill one job."""
    _run(["scancel", job])


def completions(home: Path) -> list[str]:
    """State of every job that has ended."""
    log = home / "log" / "jobcomp.log"
    lines = log.read_text().splitlines() if log.exists() else []
    return [word.split("=")[1] for line in lines for word in line.split() if word.startswith("JobState=")]


def _run(command: list[str], check: bool = True) -> str:
    environment = dict(os.environ, PATH=os.pathsep.join([os.environ.get("PATH", ""), EXTRA_PATH]))
    result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    if check and result.returncode:
        raise RuntimeError(f"{' '.join(command)}: {result.stderr.strip() or result.stdout.strip()}")
    return result.stdout


def _stop(pid_file: Path) -> None:
    try:
        pid = int(pid_file.read_text())
        os.kill(pid, signal.SIGTERM)
    except (OSError, ValueError):
        return
    end = time.monotonic() + 20
    while Path(f"/proc/{pid}").exists() and time.monotonic() < end:
        time.sleep(0.2)
