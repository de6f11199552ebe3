"""The campaign on a real SLURM: submit, kill a job, resume, and compare every byte with a local run.

    python tests/slurm/campaign.py [PAPER]

PAPER is a folder of papers/, or the toy of the tests (the default). Both runs work in copies of this tree with small
ensembles; cluster and copies live in a temporary folder. Exit code 0 only if the bytes agree.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))

import cluster
import tree

SIZES = {"chunk": 500, "campaign_chunks": 16, "campaign_batch": 4}  # four jobs a campaign, and one for the small one
LIMIT = 1500.0


def copy(paper: str, target: Path) -> None:
    """A tree with one paper and small ensembles."""
    places = [tree.ROOT / place / paper for place in ("tests/toy", "papers")]
    source = next((place for place in places if place.is_dir()), None)
    if source is None:
        sys.exit(f"slurm: there is no papers/{paper}; name a folder of papers/, or nothing for the toy")
    tree.copy(target, tree.CHAIN)
    tree.copy_into(source, target / "papers" / paper)
    for config in (target / "config").glob("*.yaml"):
        text = config.read_text()
        for name, value in SIZES.items():
            text = re.sub(rf"^{name}: \d+$", f"{name}: {value}", text, flags=re.MULTILINE)
        config.write_text(text)


def start(folder: Path, *options: str) -> subprocess.Popen[str]:
    """Start the campaign in a folder; its output goes to run.log there."""
    command = [sys.executable, "-m", "snakemake", *options, "campaign"]
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM_", "RECONTROL_"))}
    with (folder / "run.log").open("a") as log:
        return subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT, text=True)


def submit(folder: Path) -> subprocess.Popen[str]:
    """Start the campaign through the cluster, with the project's own profile."""
    options = ("--profile", "profiles/slurm", "--default-resources", "slurm_partition=main", "mem_mb=500", "runtime=20")
    return start(folder, *options, "--latency-wait", "10")


def wait(run: subprocess.Popen[str], folder: Path, wanted: bool) -> None:
    """Wait for a run; stops the program unless it ends as wanted."""
    code = run.wait(timeout=LIMIT)
    if (code == 0) != wanted:
        sys.exit(f"slurm: exit code {code}\n{(folder / 'run.log').read_text()[-6000:]}")


def kill_one(folder: Path) -> str:
    """Cancel the first job that works on chunks when some of them are finished; returns its number."""
    end = time.monotonic() + LIMIT
    while time.monotonic() < end:
        jobs = cluster.running_jobs()
        if jobs and list(folder.glob("results/*/ensemble/*/chunks-*.json")):
            cluster.cancel(jobs[0])
            return jobs[0]
        time.sleep(0.2)
    sys.exit("slurm: no job on chunks was seen running")


def artifacts(folder: Path) -> dict[str, bytes]:
    """Bytes of everything that the campaign made."""
    files = sorted(path for path in (folder / "results").rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def main(paper: str = "toy2024") -> None:
    """Local run, cluster run with a killed job, resumed run, comparison."""
    reason = cluster.missing()
    if reason:
        sys.exit(f"slurm: skipped, {reason}")
    with tempfile.TemporaryDirectory(prefix="recontrol-slurm-") as name:
        local, remote, home = Path(name, "local"), Path(name, "remote"), Path(name, "cluster")
        copy(paper, local)
        copy(paper, remote)
        begin = time.monotonic()
        wait(start(local, "--cores", "2"), local, True)
        print(f"local run: {time.monotonic() - begin:.0f} s, {len(artifacts(local))} artifacts", flush=True)
        with cluster.Cluster(home):
            begin = time.monotonic()
            run = submit(remote)
            try:
                job = kill_one(remote)
            except BaseException:
                run.kill()
                raise
            print(f"cluster run: job {job} killed after {time.monotonic() - begin:.0f} s", flush=True)
            wait(run, remote, False)
            kept = len(list(remote.glob("results/*/ensemble/*/chunks-*.json")))
            print(f"cluster run ended with an error as it should; {kept} jobs of chunks are kept", flush=True)
            begin = time.monotonic()
            wait(submit(remote), remote, True)
            print(f"resumed run: {time.monotonic() - begin:.0f} s", flush=True)
            states = cluster.completions(home)
            print("jobs: " + ", ".join(f"{states.count(s)} {s}" for s in sorted(set(states))), flush=True)
        ours, theirs = artifacts(local), artifacts(remote)
        differing = sorted(k for k in {**ours, **theirs} if ours.get(k) != theirs.get(k))
        if differing or not ours:
            sys.exit(f"slurm: {len(differing)} of {len(ours)} artifacts differ: {', '.join(differing[:10])}")
        print(f"slurm: all {len(ours)} artifacts equal byte for byte")


if __name__ == "__main__":
    main(*sys.argv[1:])
