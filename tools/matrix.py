"""Build everything under several environments and write docs/reproducibility.md: what stays equal, and how.

    python tools/matrix.py [--only NAME ...]

Each environment is one cold `snakemake all` in a folder of its own, compared with the first one. What was measured is
kept in run/matrix/ until the sources change, so that a stopped run goes on where it was. Exit code 1 if a verdict or a
byte of VERDICTS.md differs.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import tree

from recontrol.pipeline.encode import canonical_digest

KEPT = Path("run/matrix")
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS")
ENVIRONMENTS = {
    "reference": {},
    "reference, again": {},
    "two threads": dict.fromkeys(THREADS, "2"),
    "kernel SkylakeX": {"OPENBLAS_CORETYPE": "SkylakeX"},
    "kernel Sandybridge": {"OPENBLAS_CORETYPE": "Sandybridge"},
    "default solver CVXOPT": {"solver": "cvxopt"},
    "default solver SDPA": {"solver": "sdpa"},
    "Python 3.12": {"python": "3.12"},
    "Python 3.13": {"python": "3.13"},
}
KINDS = ("model", "synthesis", "certificates", "simulation", "quantities", "verdicts", "ensemble", "figures")
HEAD = """# Reproducibility across environments

`make matrix` builds all papers from nothing in each environment and compares with the first, byte by byte and, for
JSON artifacts, by the digest of their numbers rounded to six digits. The reference is Python {python}, one thread,
the kernel Haswell, CLARABEL.

| environment | claims with the same verdict | VERDICTS.md | artifacts of equal bytes | JSON artifacts of equal digits |
|---|---|---|---|---|
"""
KIND_HEAD = """
## By kind

Artifacts of equal bytes, and those whose numbers are equal to six digits, of all that the reference has (for figures
the CSV of the plotted data and the pictures, by bytes).

| environment | {kinds} |
|---|{rule}|
"""
TAIL = """
## What follows

A verdict never rests on a solver's last digits: it comes from enclosures, proofs and stated margins. Bytes do rest on
them, so they are compared on one machine in the pinned environment only (`make test` builds hashim2015 twice and
compares). Searches end at another point of a non-unique answer wherever a kernel or a solver rounds differently;
certificates then hold another witness of the same statement, and each was verified in its own environment.
"""


def sources():
    """Digest of everything that a run is made from."""
    total = hashlib.sha256()
    for top in ("Snakefile", "rules", "config", "profiles", "environment.lock", "src", "papers"):
        for path in [Path(top)] if Path(top).is_file() else sorted(Path(top).rglob("*.*")):
            if path.is_file() and path.suffix != ".pyc":
                total.update(f"{path} {hashlib.sha256(path.read_bytes()).hexdigest()}\n".encode())
    return total.hexdigest()


def interpreter(version):
    """A Python with the locked packages, made if its interpreter can be had; None if not."""
    if version is None:
        return sys.executable
    found = shutil.which(f"python{version}")
    homes = sorted(Path.home().glob(f".pyenv/versions/{version}.*/bin/python{version}"))
    found = str(homes[-1]) if homes else found
    if found is None or subprocess.run([found, "-c", "pass"], capture_output=True).returncode:
        return None
    venv = Path("run", f"venv-{version}")
    venv.parent.mkdir(exist_ok=True)
    subprocess.run([found, "tools/environment.py", str(venv), "environment-test.lock"], check=True)
    return str((venv / "bin/python").absolute())


def build(folder, variables, python):
    """One cold run and its verdict book; returns the exit code of the run."""
    tree.copy(folder)
    dropped = {"PYTHONPATH", "OPENBLAS_CORETYPE", *THREADS}
    environment = {key: value for key, value in os.environ.items() if key not in dropped}
    environment |= {key: value for key, value in variables.items() if key.isupper()}
    if "solver" in variables:
        config = folder / "config/config.yaml"
        config.write_text(config.read_text().replace("solver: clarabel", f"solver: {variables['solver']}"))
    with (folder / "run.log").open("w") as log:
        command = [python, "-m", "snakemake", "--cores", "2", "all"]
        code = subprocess.run(command, cwd=folder, env=environment, stdout=log, stderr=log).returncode
        book = [python, "-m", "recontrol.report", "book"]
        subprocess.run(book, cwd=folder, env=environment | {"PYTHONPATH": "src"}, stdout=log, stderr=log)
    return code


def measure(name):
    """Build one environment and keep the digests of what it made; None if its interpreter cannot be had."""
    variables = ENVIRONMENTS[name]
    python = interpreter(variables.get("python"))
    if python is None:
        return None
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        code = build(folder, variables, python)
        made = {p.relative_to(folder).as_posix(): p.read_bytes() for p in files(folder)}
        book = folder / "VERDICTS.md"
        found = {
            "code": code,
            "bytes": {key: hashlib.sha256(content).hexdigest() for key, content in made.items()},
            "digits": {key: canonical_digest(json.loads(made[key])) for key in made if numeric(key)},
            "verdicts": verdicts(made),
            "book": book.read_text().splitlines() if book.exists() else [],
            "python": subprocess.check_output([python, "-V"], text=True).split()[1],
            "log": (folder / "run.log").read_text()[-20_000:],
        }
    print(f"{name}: exit code {code}, {len(made)} artifacts, {time.monotonic() - begin:.0f} s", flush=True)
    return found


def files(folder):
    """Everything that a run made, but the crate, which names the run."""
    paths = [path for top in ("results", "figures") for path in (folder / top).rglob("*")]
    return [path for path in sorted(paths) if path.is_file() and "crate" not in path.parts]


def numeric(name):
    """Whether an artifact is a JSON of numbers."""
    return name.endswith(".json") and kind(name) in KINDS


def kind(name):
    """Which stage made an artifact of a paper."""
    parts = name.removesuffix(".json").split("/")
    if parts[0] == "figures":
        return "figures"
    return parts[2] if len(parts) > 2 and Path("papers", parts[1]).is_dir() else ""


def verdicts(made):
    """`paper/claim` -> verdict."""
    tables = json.loads(made.get("results/verdicts.json", b"[]"))
    return {f"{t['paper']}/{c['id']}": c["verdict"] for t in tables for c in t["claims"]}


def remembered(name, key):
    """What an earlier run measured from the same sources, or what is measured now."""
    file = KEPT / f"{name.replace(' ', '-').replace(',', '')}.json"
    if file.exists() and (old := json.loads(file.read_text()))["sources"] == key:
        return old
    found = measure(name)
    if found is not None:
        KEPT.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(found | {"sources": key}, indent=1))
    return found


def share(mine, first, chosen):
    """`equal of all` over the chosen names of the reference."""
    names = [name for name in first if chosen(name)]
    equal = sum(mine.get(name) == first[name] for name in names)
    return "all" if names and equal == len(names) else f"{equal} of {len(names)}"


def row(name, found, first):
    """One line of the first table."""
    if found is None:
        return f"| {name} | not run: no such interpreter | | | |\n"
    cells = [
        f"{sum(found['verdicts'].get(k) == v for k, v in first['verdicts'].items())} of {len(first['verdicts'])}",
        "equal" if found["book"] == first["book"] else f"lines that differ: {len(other_lines(found, first))}",
        share(found["bytes"], first["bytes"], lambda _: True),
        share(found["digits"], first["digits"], lambda _: True),
    ]
    label = f"{name} ({found['python']})" if "Python" in name else name
    return f"| {label} | {' | '.join(cells)} |\n"


def kind_row(name, found, first):
    """One line of the second table: bytes, digits."""
    cells = []
    for wanted in KINDS:
        cell = share(found["bytes"], first["bytes"], lambda n, w=wanted: kind(n) == w)
        if cell != "all" and any(kind(n) == wanted for n in first["digits"]):
            cell += f", {share(found['digits'], first['digits'], lambda n, w=wanted: kind(n) == w)}"
        cells.append(cell)
    return f"| {name} | {' | '.join(cells)} |\n"


def differing(name, found, first):
    """Claims whose verdict is another one."""
    pairs = [(k, v, found["verdicts"].get(k, "missing")) for k, v in first["verdicts"].items()]
    return [f"- {name}: {k}: {new}, in the reference {old}\n" for k, old, new in pairs if new != old]


def other_lines(found, first):
    """Lines of the verdict book that the reference does not have."""
    return [line for line in found["book"] if line not in set(first["book"])]


def missing(name, found, first):
    """What an environment did not make: a job failed there."""
    absent = [key for key in first["bytes"] if key not in found["bytes"]]
    return [f"- {name}: {', '.join(absent)}\n"] if absent else []


def wrong(table):
    """Environments in which a verdict or VERDICTS.md differs, or whose run failed."""
    first = table["reference"]
    had = {name: found for name, found in table.items() if found is not None}
    return [n for n, f in had.items() if differing(n, f, first) or f["book"] != first["book"] or f["code"]]


def page(table):
    """docs/reproducibility.md from what was measured."""
    first = table["reference"]
    had = {name: found for name, found in table.items() if found is not None}
    text = HEAD.format(python=first["python"]) + "".join(row(name, found, first) for name, found in table.items())
    text += KIND_HEAD.format(kinds=" | ".join(KINDS), rule="|".join(["---"] * len(KINDS)))
    text += "".join(kind_row(name, found, first) for name, found in had.items() if name != "reference")
    lines = [line for name, found in had.items() for line in differing(name, found, first)]
    text += "\n## Verdicts that differ\n\n" + ("".join(lines) if lines else "None.\n")
    lines = [f"- {name}: `{line}`\n" for name, found in had.items() for line in other_lines(found, first)]
    text += "\n## Lines of VERDICTS.md that differ\n\n" + ("".join(lines) if lines else "None.\n")
    lines = [line for name, found in had.items() for line in missing(name, found, first)]
    text += "\n## Artifacts that were not made\n\n" + ("".join(lines) if lines else "None.\n")
    return text + TAIL


def main(arguments):
    """Measure what is not known yet, write the page; exit code 1 if a verdict differs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=[n for n in ENVIRONMENTS if n != "reference"], default=None)
    only = parser.parse_args(arguments).only
    key = sources()
    names = [n for n in ENVIRONMENTS if only is None or n in only or n == "reference"]
    table = {name: remembered(name, key) for name in names}
    Path("docs/reproducibility.md").write_text(page(table))
    bad = wrong(table)
    print(f"verdicts, VERDICTS.md or the exit code differ under: {', '.join(bad)}" if bad else "all the same")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
