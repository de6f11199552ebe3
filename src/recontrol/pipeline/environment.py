"""Thread counts and kernel choice that make equal inputs give equal bytes on one machine."""

from __future__ import annotations

import os
import platform
import sys
from pathlib import Path

THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "RAYON_NUM_THREADS",
    "NUMEXPR_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


def for_jobs(root: Path) -> None:
    """Pin this process, and let the shell commands of the rules find this interpreter and these sources."""
    pin()
    os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    os.environ["PYTHONPATH"] = os.pathsep.join([str(root / "src"), str(Path.cwd())])


def pin() -> None:
    """Set threads and kernel; must run before numpy is imported.

    RECONTROL_THREADS (default 1) is the number of threads whatever the other variables say: Snakemake sets most of them
    for each job. RAYON_NUM_THREADS is the one the interior-point solver listens to. OPENBLAS_CORETYPE, if it is not set
    yet, fixes the kernel, whose choice can flip a solver between `optimal` and `optimal_inaccurate`.
    """
    threads = os.environ.setdefault("RECONTROL_THREADS", "1")
    for name in THREADS:
        os.environ[name] = threads
    if platform.machine() in ("x86_64", "AMD64"):
        os.environ.setdefault("OPENBLAS_CORETYPE", "Haswell")
    os.environ.setdefault("SOURCE_DATE_EPOCH", "0")
    os.environ.setdefault("MPLBACKEND", "Agg")


def in_force() -> dict[str, str]:
    """What this process was pinned to, for the records of its artifacts."""
    return {
        "threads": os.environ.get("OPENBLAS_NUM_THREADS", ""),
        "kernel": os.environ.get("OPENBLAS_CORETYPE", ""),
        "solver": os.environ.get("RECONTROL_SOLVER", ""),
        "python": platform.python_version(),
    }
