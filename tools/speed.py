"""Time the chain from nothing, without change and after single edits; write the marked section of docs/performance.md.

    python tools/speed.py [FOLDER]

Works in a copy of the tree, in an empty FOLDER that is kept or else in a temporary one. Processor time of the jobs
comes from their records (run/provenance), that of the whole run from the operating system. Run it on a quiet machine:
wall times are compared with each other.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import tree

PAGE = Path("docs/performance.md")
BEGIN, END = "<!-- speed -->", "<!-- /speed -->"
CORES = 2
ALLOWED = 1.5
EDITS = {
    "nothing": None,
    "one topic of figures": "papers/wan2014/figures/published.py",
    "one topic of readings": "papers/wan2014/readings/gains.py",
    "claims.yaml of one paper": "papers/wan2014/claims.yaml",
    "NOTES.md of one paper": "papers/wan2014/NOTES.md",
    "simulation of one paper": "papers/hashim2015/simulation/limits.py",
    "model of one paper": "papers/hashim2015/model.py",
    "the figure style": "src/recontrol/plotting.py",
}
STAGES = ("model", "synthesis", "certificates", "simulation", "figure", "verdicts", "quantities")
TEXT = """{begin}
## The chain

Made by `make speed` (tools/speed.py): one cold run of all papers in an empty directory, then reruns after single
edits. {jobs} jobs; the stages took {cpu:.0f} processor seconds, and the wall time of the cold run was {ratio:.2f}
times what {cores} cores need for them ({allowed} is allowed): the rest is Snakemake, the report and the last jobs that
run alone. Wall times below are shares of the cold run, which took {wall:.0f} s here.

| after an edit of | jobs run | share of the cold run |
| --- | --- | --- |
{edits}

Processor time by paper and stage, in parts of a thousand of all stages, with the number of jobs:

| paper | {stages} | all |
| --- |{rule}
{table}

A job that proves one matrix inequality costs mostly the import of the solver's modelling layer; where no solver is
needed nothing heavy is loaded.
{end}
"""


def run(folder):
    """One plain run: wall seconds and the messages of the jobs that ran. Stops the program if it fails."""
    command = [sys.executable, "-m", "snakemake", "--cores", str(CORES), "all"]
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    begin = time.monotonic()
    result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    wall = time.monotonic() - begin
    if result.returncode:
        sys.exit(f"speed: the run failed\n{result.stdout[-4000:]}{result.stderr[-4000:]}")
    lines = (result.stdout + result.stderr).splitlines()
    return wall, [line for line in lines if line.startswith("Job ")]


def costs(folder):
    """(paper, stage) -> processor seconds and number of jobs, from the records of the artifacts."""
    seconds, jobs, seen = Counter(), Counter(), set()
    for path in (folder / "run/provenance").rglob("*.json"):
        record = json.loads(path.read_text())
        job = (record.get("paper"), record.get("stage"), record.get("part"))
        if "cpu_seconds" in record and job not in seen:
            seen.add(job)
            seconds[job[:2]] += record["cpu_seconds"]
            jobs[job[:2]] += 1
    return seconds, jobs


def table(seconds, jobs):
    """Rows of the table by paper and stage."""
    total = sum(seconds.values())
    rows = []
    for paper in sorted({key[0] for key in seconds}):
        cells = [f"{1000 * seconds[paper, s] / total:.0f} ({jobs[paper, s]})" for s in STAGES]
        whole = sum(v for key, v in seconds.items() if key[0] == paper)
        rows.append(f"| {paper} | {' | '.join(cells)} | {1000 * whole / total:.0f} |")
    return "\n".join(rows)


def section(wall, jobs_run, reruns, seconds, jobs):
    """The text between the marks."""
    total = sum(seconds.values())
    edits = [f"| {name} | {len(ran)} | {100 * t / wall:.1f} % |" for name, (t, ran) in reruns.items()]
    return TEXT.format(
        begin=BEGIN, end=END, jobs=len(jobs_run), cpu=total, ratio=wall / (total / CORES), cores=CORES, allowed=ALLOWED,
        wall=wall, edits="\n".join(edits), stages=" | ".join(STAGES), rule=" --- |" * (len(STAGES) + 1),
        table=table(seconds, jobs),
    )  # fmt: skip


def write(text):
    """Put the section into the page, in place of the old one or at its end."""
    page = PAGE.read_text()
    if BEGIN in page:
        head, rest = page.split(BEGIN, 1)
        page = head + text.strip() + rest.split(END, 1)[1]
    else:
        page = f"{page.rstrip()}\n\n{text}"
    PAGE.write_text(page)


def main(arguments):
    """Measure and write; exit code 1 if the cold run takes longer than its jobs allow."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(arguments[0] if arguments else place).resolve()
        tree.copy(folder)
        wall, ran = run(folder)
        print(f"cold: {wall:.0f} s, {len(ran)} jobs", flush=True)
        seconds, jobs = costs(folder)
        reruns = {}
        for name, edited in EDITS.items():
            if edited is not None:
                file = folder / edited
                file.write_text(file.read_text() + ("\n" if edited.endswith(".md") else "# edited\n"))
            reruns[name] = run(folder)
            print(f"{name}: {reruns[name][0]:.1f} s, {len(reruns[name][1])} jobs", flush=True)
    write(section(wall, ran, reruns, seconds, jobs))
    ratio = wall / (sum(seconds.values()) / CORES)
    print(f"cold run over stage time on {CORES} cores: {ratio:.2f}, allowed {ALLOWED}")
    return 0 if ratio <= ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
