"""Build everything under several environments and write docs/reproducibility.md: what stays equal, and how.

Each environment is one cold `snakemake all` in a folder of its own, compared with the first one.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from recontrol.pipeline.encode import canonical_digest

TREE = ("Snakefile", "rules", "config", "profiles", "environment.lock", "pyproject.toml", "src", "papers")
ENVIRONMENTS = {
    "pinned": {},
    "pinned, again": {},
    "two BLAS threads": {"OMP_NUM_THREADS": "2", "OPENBLAS_NUM_THREADS": "2", "RAYON_NUM_THREADS": "2"},
    "kernel SkylakeX": {"OPENBLAS_CORETYPE": "SkylakeX"},
    "kernel Sandybridge": {"OPENBLAS_CORETYPE": "Sandybridge"},
    "default solver cvxopt": {"solver": "cvxopt"},
}
HEAD = """# Reproducibility across environments

`make matrix` builds all papers from nothing in each environment and compares with the first. A verdict never depends on
a solver's last digits; bytes do. Interpreter: Python {python}.


| environment | verdicts | artifacts with equal bytes | JSON artifacts with equal canonical digest | failed jobs |
|---|---|---|---|---|
"""


def build(folder, variables):
    """One cold run; returns its exit code."""
    for name in TREE:
        if Path(name).is_dir():
            shutil.copytree(name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(name, folder / name)
    command = [sys.executable, "-m", "snakemake", "--cores", "2", "all"]
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    if "solver" in variables:
        config = folder / "config/config.yaml"
        config.write_text(config.read_text().replace("solver: clarabel", f"solver: {variables['solver']}"))
    environment |= {key: value for key, value in variables.items() if key.isupper()}
    log = (folder / "run.log").open("w")
    return subprocess.run(command, cwd=folder, env=environment, stdout=log, stderr=log).returncode


def artifacts(folder):
    """Path -> bytes of everything made."""
    paths = [path for top in ("results", "figures") for path in (folder / top).rglob("*") if path.is_file()]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def verdicts(made):
    """Paper and claim -> verdict."""
    tables = json.loads(made.get("results/verdicts.json", b"[]"))
    return {(t["paper"], c["id"]): c["verdict"] for t in tables for c in t["claims"]}


def canonical(made):
    """JSON artifacts by canonical digest."""
    kept = {name: content for name, content in made.items() if name.endswith(".json") and "/crate/" not in name}
    return {name: canonical_digest(json.loads(content)) for name, content in kept.items()}


def row(name, made, first, status):
    """One line of the table."""
    mine, theirs = verdicts(made), verdicts(first)
    same = sum(mine.get(key) == value for key, value in theirs.items())
    equal = sum(made.get(key) == value for key, value in first.items())
    digests, reference = canonical(made), canonical(first)
    alike = sum(digests.get(key) == value for key, value in reference.items())
    cells = [f"{same} of {len(theirs)}", f"{equal} of {len(first)}", f"{alike} of {len(reference)}", str(status)]
    return f"| {name} | {' | '.join(cells)} |\n"


def main():
    """Build all environments, write the table; exit code 1 if a verdict differs."""
    rows, first = [], {}
    for name, variables in ENVIRONMENTS.items():
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            status = build(folder, variables)
            made = artifacts(folder)
        first = first or made
        rows.append(row(name, made, first, status))
        print(rows[-1].strip(), f"({time.monotonic() - begin:.0f} s)", flush=True)
        python = ".".join(map(str, sys.version_info[:3]))
        Path("docs/reproducibility.md").write_text(HEAD.format(python=python) + "".join(rows))
    different = [
        r for r in rows if r.split("|")[2].split(" of ")[0].strip() != r.split("|")[2].split(" of ")[1].strip()
    ]
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
