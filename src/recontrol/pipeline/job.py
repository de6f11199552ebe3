"""The frame around every job: load the paper, do the work, refuse undeclared modules, publish with provenance."""

from __future__ import annotations

import resource
import sys
from collections.abc import Mapping
from pathlib import Path

from recontrol import paper as papers
from recontrol.errors import StageError
from recontrol.pipeline import closure, environment, store


def publish(stage: str, key: str, part: str | None, contents: Mapping[Path, bytes], inputs: list[Path]) -> None:
    """Publish the artifacts of one job after checking that it imported only what its rule declared."""
    declared = closure.code_of(stage, key, figure=part if stage == "figure" else None)
    loaded = {name: file for name, module in list(sys.modules.items()) if (file := getattr(module, "__file__", None))}
    surplus = closure.undeclared(loaded, declared)
    if surplus:
        raise StageError(
            f"stage {stage} of {key} imported {', '.join(surplus)}, which its rule does not declare as input; "
            "import it by a plain import statement, so that an edit of it reruns the stage"
        )
    made_by = {
        "paper": key,
        "stage": stage,
        "part": part,
        "code": closure.digest_of(declared),
        **costs(),
        "environment": environment.in_force(),
        "inputs": {path.as_posix(): store.digest_of(path) for path in inputs if store.record_path(path).exists()},
    }
    store.publish({path.as_posix(): content for path, content in contents.items()}, made_by)


def costs() -> dict[str, float]:
    """Processor time and largest memory of this job so far, imports and solvers in child processes included.

    The job notes them itself: Snakemake's `benchmark` asks the system again and again for every job that ever ran,
    which came to a fifth of the processor time of a cold run.
    """
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    seconds = sum(part.ru_utime + part.ru_stime for part in used)
    return {"cpu_seconds": round(seconds, 2), "max_rss_mb": round(max(part.ru_maxrss for part in used) / 1024)}


def open_paper(key: str) -> papers.Paper:
    """papers/<key>, validated."""
    return papers.load(Path("papers") / key)
