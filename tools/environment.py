"""Make the virtual environment from a lock file. Needs nothing but Python, its venv module and pip.

    python3 tools/environment.py VENV LOCK [LOCK ...]

An environment is complete when its stamp names the locks' digest; anything else is cleared and built again, so that a
half-made or outdated one is never used.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

OLDEST, NEWEST = (3, 11), (3, 13)
DISK_MB = 2500
NO_VENV = "The venv module may be missing: on Debian and Ubuntu install python3-venv, then run the same command again"
NO_PACKAGES = (
    "If the network or the package index was the cause, run the same command again; if a hash differs, the lock file "
    "or the download was altered"
)
NO_FIT = (
    "The lock contradicts itself: take environment.lock and environment-test.lock from one commit, or run `make lock`"
)


def fail(message):
    """Say what is wrong and what to do, and stop."""
    sys.exit(f"environment: {message}")


def check_python():
    """Refuse an interpreter that the lock has no wheels for."""
    if not OLDEST <= sys.version_info[:2] <= NEWEST:
        fail(
            f"this is Python {sys.version_info[0]}.{sys.version_info[1]}; the lock covers 3.11 to 3.13. "
            "Install one of these and name it: make PYTHON=python3.12 ..."
        )


def check_disk(folder):
    """Refuse to begin what cannot be finished."""
    if not folder.is_dir():
        fail(f"{folder} does not exist; make it, or set VENV to a place in a folder that does")
    free = shutil.disk_usage(folder).free // 2**20
    if free < DISK_MB:
        fail(f"{free} MB free in {folder}; the environment needs {DISK_MB} MB. Free some space or set VENV=/elsewhere")


def digest(locks):
    """Digest of the lock files and the interpreter's version."""
    total = hashlib.sha256(repr(sys.version_info[:2]).encode())
    for lock in locks:
        total.update(Path(lock).read_bytes())
    return total.hexdigest()


def build_backend(lock):
    """The setuptools pin of the lock: the one source distribution in it must build with that and nothing newer."""
    for line in Path(lock).read_text().splitlines():
        if line.startswith("setuptools=="):
            return line.split()[0].rstrip("\\")
    return "setuptools"


def run(step, command, advice, env=None):
    """One step with its progress shown; a failure says what to do."""
    print(f"environment: {step}", flush=True)
    result = subprocess.run(command, env=env)
    if result.returncode:
        fail(f"{step} failed (exit code {result.returncode}). {advice}")


def make(venv, locks):
    """Build the environment from nothing, and stamp it when it is complete."""
    check_disk(venv.parent)
    begin = time.monotonic()
    print(f"environment: making {venv} from {', '.join(locks)} (one to three minutes)", flush=True)
    run("new virtual environment", [sys.executable, "-m", "venv", "--clear", str(venv)], NO_VENV)
    python = str(venv / "bin" / "python")
    constraint = venv / "build-constraints.txt"
    constraint.write_text(build_backend(locks[0]) + "\n")
    env = dict(os.environ, PIP_CONSTRAINT=str(constraint), PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_INPUT="1")
    only_wheels = ["--only-binary", ":all:", "--no-binary", "connection-pool"]
    for lock in locks:
        command = [python, "-m", "pip", "install", "--quiet", "--progress-bar", "off", "--require-hashes", *only_wheels]
        run(f"packages of {lock}", [*command, "-r", lock], NO_PACKAGES, env)
    run("checking that the packages fit together", [python, "-m", "pip", "check"], NO_FIT)
    home = subprocess.check_output([python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"], text=True)
    Path(home.strip(), "recontrol-here.pth").write_text(f"{Path('src').resolve()}\n{Path.cwd()}\n")
    command_line = venv / "bin" / "recontrol"
    command_line.write_text(f"#!{python}\nimport sys\nfrom recontrol.cli import main\nsys.exit(main())\n")
    command_line.chmod(0o755)
    print(f"environment: ready after {time.monotonic() - begin:.0f} s", flush=True)


def main(arguments):
    """Make the environment unless its stamp says that it is complete."""
    if len(arguments) < 2:
        fail("usage: environment.py VENV LOCK [LOCK ...]")
    check_python()
    venv, locks = Path(arguments[0]).resolve(), arguments[1:]
    wanted = digest(locks)
    stamp = venv / "complete"
    if stamp.exists() and stamp.read_text() == wanted:
        return
    if venv.exists():
        print(f"environment: {venv} is unfinished or outdated; building it again", flush=True)
    make(venv, locks)
    stamp.write_text(wanted)


if __name__ == "__main__":
    main(sys.argv[1:])
