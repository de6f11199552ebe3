"""Build everything under several environments and write docs/reproducibility.md: what stays equal, and how.

    python tools/matrix.py [--only NAME ...]

Each environment is one cold `snakemake all` of a copy of the tree as it was at the start, compared with the first one.
What was measured is kept in run/matrix/ until the sources change, so that a stopped run goes on where it was; the page
shows all that is known, also under --only. Exit code 1 if a run fails or a verdict or a byte of VERDICTS.md differs.
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
PINNED = {"threads": "1", "kernel": "Haswell", "solver": "CLARABEL"}
ENVIRONMENTS = {
    "reference": {},
    "reference, again": {},
    "two threads": {"threads": "2"},
    "kernel SkylakeX": {"kernel": "SkylakeX"},
    "kernel Sandybridge": {"kernel": "Sandybridge"},
    "default solver CVXOPT": {"solver": "CVXOPT"},
    "default solver SDPA": {"solver": "SDPA"},
    "Python 3.12": {"python": "3.12"},
    "Python 3.13": {"python": "3.13"},
}
KINDS = ("model", "synthesis", "certificates", "simulation", "quantities", "verdicts", "ensemble", "figures")
HEAD = """# Reproducibility across environments

`make matrix` builds all papers from nothing in each environment and compares with the first, byte by byte and, for
JSON artifacts, by the digest of their numbers rounded to six digits. The reference is Python {python}, BLAS threads:
{threads}, kernel of OpenBLAS: {kernel}, default solver: {solver}. Every job notes the first three as set for it, a
stage also the default solver, and a row counts only if all of them noted what the row says. CLARABEL has one thread in
all rows.

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

No verdict and no printed line of VERDICTS.md rested on the environment: they come from enclosures, proofs and stated
margins, and what is printed is rounded to what carries. Bytes do rest on it, so they are compared on one machine in
the pinned environment only (`make test` builds hashim2015 twice and compares). Searches end at another point of a
non-unique answer wherever a kernel or a solver rounds differently; certificates then hold another witness of the same
statement, and the verdicts took each from the verifier in its own environment. A solver that is asked by name, for a
second opinion or in a search that is proven afterwards, is the same in all rows.
"""


def sources(folder):
    """Digest of everything that a run is made from."""
    total = hashlib.sha256()
    for top in (*tree.CHAIN, "papers"):
        for path in [folder / top] if (folder / top).is_file() else sorted((folder / top).rglob("*.*")):
            if path.is_file():
                name = path.relative_to(folder).as_posix()
                total.update(f"{name} {hashlib.sha256(path.read_bytes()).hexdigest()}\n".encode())
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


def build(folder, chosen, python):
    """One cold run and its verdict book; returns the exit code of the run, or else of the book."""
    dropped = ("RECONTROL_", "OPENBLAS_", "PYTHONPATH")
    environment = {key: value for key, value in os.environ.items() if not key.startswith(dropped)}
    environment |= {"RECONTROL_THREADS": chosen["threads"], "OPENBLAS_CORETYPE": chosen["kernel"]}
    config = folder / "config/config.yaml"
    config.write_text(config.read_text().replace("solver: clarabel", f"solver: {chosen['solver'].lower()}"))
    with (folder / "run.log").open("w") as log:
        command = [python, "-m", "snakemake", "--cores", "2", "all"]
        code = subprocess.run(command, cwd=folder, env=environment, stdout=log, stderr=log).returncode
        command = [python, "-m", "recontrol.report", "book"]
        book = subprocess.run(command, cwd=folder, env=environment | {"PYTHONPATH": "src"}, stdout=log, stderr=log)
    return code or book.returncode


def check_jobs(folder, chosen):
    """Stop the program if a job of a run noted another environment than the chosen one, or if none noted any.

    Jobs that ask no solver note an empty one; reports and exports note nothing.
    """
    records = {path.name: json.loads(path.read_text()) for path in (folder / "run/provenance").rglob("*.json")}
    noted = {name: record["environment"] for name, record in records.items() if "environment" in record}
    if not any(found["solver"] for found in noted.values()):
        sys.exit("matrix: no job noted its environment")
    for name, found in noted.items():
        strange = {k: found.get(k) for k in chosen if found.get(k) != chosen[k] and (k != "solver" or found.get(k))}
        if strange:
            sys.exit(f"matrix: {name}: made under {strange}, wanted {chosen}")


def measure(name, snapshot):
    """Build one environment and keep the digests of what it made; None if its interpreter cannot be had."""
    python = interpreter(ENVIRONMENTS[name].get("python"))
    if python is None:
        return None
    version = subprocess.check_output([python, "-V"], text=True).split()[1]
    chosen = PINNED | ENVIRONMENTS[name] | {"python": version}
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "tree"
        shutil.copytree(snapshot, folder)
        code = build(folder, chosen, python)
        check_jobs(folder, chosen)
        made = {p.relative_to(folder).as_posix(): p.read_bytes() for p in files(folder)}
        book = folder / "VERDICTS.md"
        found = {
            "code": code,
            "bytes": {key: hashlib.sha256(content).hexdigest() for key, content in made.items()},
            "digits": {key: canonical_digest(json.loads(made[key])) for key in made if numeric(key)},
            "verdicts": verdicts(made),
            "book": book.read_text().splitlines() if book.exists() else [],
            "environment": chosen,
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


def kept(name):
    """File of what was measured."""
    return KEPT / f"{name.replace(' ', '-').replace(',', '')}.json"


def remembered(name, key):
    """What an earlier run that did not fail measured from the same sources, or None."""
    if not kept(name).exists():
        return None
    old = json.loads(kept(name).read_text())
    return old if old["sources"] == key and old["code"] == 0 else None


def known(name, key, snapshot):
    """What was or is now measured; None if the interpreter cannot be had."""
    found = remembered(name, key) or measure(name, snapshot)
    if found is not None:
        KEPT.mkdir(parents=True, exist_ok=True)
        kept(name).write_text(json.dumps(found | {"sources": key}, indent=1))
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
    label = f"{name} ({found['environment']['python']})" if "Python" in name else name
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
    """Environments in which a verdict or VERDICTS.md differs or is missing, or whose run failed."""
    first = table["reference"]
    had = {name: found for name, found in table.items() if found is not None}
    return [
        n for n, f in had.items() if f["code"] or not f["book"] or f["book"] != first["book"] or differing(n, f, first)
    ]


def page(table):
    """docs/reproducibility.md from what was measured."""
    first = table["reference"]
    had = {name: found for name, found in table.items() if found is not None}
    text = HEAD.format(**first["environment"]) + "".join(row(name, found, first) for name, found in table.items())
    text += KIND_HEAD.format(kinds=" | ".join(KINDS), rule="|".join(["---"] * len(KINDS)))
    text += "".join(kind_row(name, found, first) for name, found in had.items() if name != "reference")
    lines = [line for name, found in had.items() for line in differing(name, found, first)]
    text += "\n## Verdicts that differ\n\n" + ("".join(lines) if lines else "None.\n")
    lines = [f"- {name}: `{line}`\n" for name, found in had.items() for line in other_lines(found, first)]
    text += "\n## Lines of VERDICTS.md that differ\n\n" + ("".join(lines) if lines else "None.\n")
    lines = [line for name, found in had.items() for line in missing(name, found, first)]
    text += "\n## Artifacts that were not made\n\n" + ("".join(lines) if lines else "None.\n")
    return text if wrong(table) else text + TAIL


def main(arguments):
    """Measure what is not known yet, write the page; exit code 1 if a verdict differs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=[n for n in ENVIRONMENTS if n != "reference"], default=None)
    only = parser.parse_args(arguments).only
    table = {}
    with tempfile.TemporaryDirectory() as place:
        snapshot = Path(place) / "tree"
        tree.copy(snapshot)
        key = sources(snapshot)
        for name in ENVIRONMENTS:
            if only is None or name in only or name == "reference":
                table[name] = known(name, key, snapshot)
            elif (old := remembered(name, key)) is not None:
                table[name] = old
            Path("docs/reproducibility.md").write_text(page(table))
    bad, absent = wrong(table), [name for name in ENVIRONMENTS if table.get(name) is None]
    print(f"verdicts, VERDICTS.md or the exit code differ under: {', '.join(bad)}" if bad else "all the same")
    if absent:
        print(f"not compared: {', '.join(absent)}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
