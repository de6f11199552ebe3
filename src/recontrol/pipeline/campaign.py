"""Robustness campaigns: seeded chunks of trajectories, merged into distributions.

A paper's campaign.py holds one function a campaign: it draws `count` members of the ensemble with the generator `rng`
and returns the outcomes of their trajectories, one array of `count` numbers for each outcome that paper.yaml names.
Chunk k always draws the same members, whatever the size of the campaign and the order of the jobs.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from recontrol.campaign.sketch import Sketch
from recontrol.errors import StageError, UnknownNameError
from recontrol.paper import Paper
from recontrol.pipeline import inputs, job, store
from recontrol.pipeline.encode import dumps
from recontrol.pipeline.layout import chunk_file, distribution_file

LEVELS = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)


def generator(seed: int, chunk: int) -> np.random.Generator:
    """The generator of a chunk: independent streams of one seed."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(chunk,)))


def run_chunk(key: str, name: str, chunk: int) -> None:
    """Simulate one chunk and publish the sketches of its outcomes."""
    paper = job.open_paper(key)
    entry = _entry(paper, name)
    config = inputs.load_config()
    count = int(config["chunk"])
    function = inputs.function_of(key, "campaign", name)
    available = inputs.Inputs(paper, config, inputs.before("campaign"))
    outcomes = available.call(function, rng=generator(int(entry.seed), chunk), count=count)
    sketches = sketch_all(outcomes, entry, count, chunk * count, inputs.where(function))
    content = {"paper": key, "campaign": name, "chunk": chunk, "count": count, "outcomes": sketches}
    job.publish("campaign", key, name, {chunk_file(key, name, chunk): dumps(content).encode()}, _earlier(paper))


def sketch_all(outcomes: Any, entry: Any, count: int, first: int, home: str) -> dict[str, Any]:
    """Sketch each outcome. Raises StageError if names or sizes are not those that paper.yaml and the chunk ask for."""
    if not isinstance(outcomes, Mapping) or set(outcomes) != set(entry.outcomes):
        found = sorted(outcomes) if isinstance(outcomes, Mapping) else type(outcomes).__name__
        raise StageError(f"{home}: returned {found}, paper.yaml names the outcomes {sorted(entry.outcomes)}")
    sketches = {}
    for outcome, values in outcomes.items():
        array = np.asarray(values, dtype=float)
        if array.shape != (count,):
            raise StageError(f"{home}: outcome {outcome!r} has shape {array.shape}, expected ({count},)")
        sketch = Sketch(entry.outcomes[outcome].worst)
        sketch.add(array, first)
        sketches[outcome] = sketch.to_json()
    return sketches


def merge(key: str, name: str, chunks: int, target: str) -> None:
    """Merge the first `chunks` chunks into the distribution of each outcome.

    target: `ensemble` (part of every run) or `campaign` (the large one).
    """
    paper = job.open_paper(key)
    entry = _entry(paper, name)
    merged = {outcome: Sketch(described.worst) for outcome, described in entry.outcomes.items()}
    files = [chunk_file(key, name, chunk) for chunk in range(chunks)]
    size = 0
    for path in files:
        content = store.read_json(path)
        size = int(content["count"])
        for outcome in merged:
            merged[outcome] = merged[outcome].merge(Sketch.from_json(content["outcomes"][outcome]))
    bounds = _bounds(paper, name)
    rows = {
        outcome: describe(sketch, bounds.get(outcome))
        | {"unit": entry.outcomes[outcome].unit, "what": entry.outcomes[outcome].what}
        for outcome, sketch in merged.items()
    }
    content = {
        "paper": key,
        "campaign": name,
        "what": entry.what,
        "seed": int(entry.seed),
        "chunk": size,
        "outcomes": rows,
    }
    contents = {distribution_file(key, name, target): dumps(content).encode(), **_pictures(content, target)}
    job.publish("campaign", key, name, contents, [*files, *_earlier(paper)])


def _pictures(content: Mapping[str, Any], target: str) -> dict[Path, bytes]:
    """The files of the distribution figure."""
    from recontrol import plotting
    from recontrol.campaign.figure import draw
    from recontrol.pipeline.figure import curves_to_csv

    key, name = content["paper"], content["campaign"]
    drawing, curves = draw(content)
    files = {distribution_file(key, name, target, "csv"): curves_to_csv(curves, f"campaign {key}/{name}")}
    with tempfile.TemporaryDirectory() as folder:
        for path in plotting.save(drawing, Path(folder, name)):
            files[distribution_file(key, name, target, path.suffix[1:])] = path.read_bytes()
    return files


def describe(sketch: Sketch, bound: Any = None) -> dict[str, Any]:
    """Extremes, bracketed quantiles (null where not finite), the worst trajectory's number, and the proven bound."""
    row = sketch.to_json()
    found = {f"{level:g}": sketch.quantile(level) for level in LEVELS}
    row["quantiles"] = {level: None if ends is None else list(ends) for level, ends in found.items()}
    row["bound"] = bound
    return row


def _bounds(paper: Paper, name: str) -> dict[str, Any]:
    """Proven bounds by outcome, from the function `<name>_bounds` of campaign.py where there is one."""
    module = inputs.module_of(paper.key, "campaign")
    function = getattr(module, f"{name.replace('-', '_')}_bounds", None)
    if function is None:
        return {}
    available = inputs.Inputs(paper, inputs.load_config(), inputs.before("campaign"))
    return dict(available.call(function))


def _entry(paper: Paper, name: str) -> Any:
    if name not in paper.file.campaigns:
        known = ", ".join(paper.file.campaigns) or "none"
        raise UnknownNameError(f"papers/{paper.key}/paper.yaml: no campaign {name!r}; campaigns: {known}")
    return paper.file.campaigns[name]


def _earlier(paper: Paper) -> list[Path]:
    return inputs.earlier(paper, "campaign")


def finished(targets: list[str], chunks: int) -> int:
    """How many chunks of some campaigns (`paper/name`) are there."""
    names = [target.split("/", 1) for target in targets]
    return sum(chunk_file(key, name, chunk).exists() for key, name in names for chunk in range(chunks))


def progress(targets: list[str], chunks: int, new: int = 0, seconds: float = 0.0) -> str:
    """How far a campaign has come, and what remains at the pace of the `new` chunks of the last `seconds`."""
    total, done = len(targets) * chunks, finished(targets, chunks)
    text = f"campaign: {done} of {total} chunks"
    if done == total or not new:
        return text
    remaining = (total - done) * seconds / new
    return text + (
        f", about {remaining:.0f} s remain" if remaining < 120 else f", about {remaining / 60:.0f} min remain"
    )


def watch(targets: list[str], chunks: int, every: float = 20.0) -> None:
    """Print the progress of the running campaign now and then, from a thread that ends with the process."""
    begin, first = time.monotonic(), finished(targets, chunks)

    def show() -> None:
        while True:
            new = finished(targets, chunks) - first
            print(progress(targets, chunks, new, time.monotonic() - begin), file=sys.stderr, flush=True)
            time.sleep(every)

    threading.Thread(target=show, daemon=True).start()


def main(arguments: list[str]) -> int:
    """Command line: chunk PAPER NAME K | merge PAPER NAME CHUNKS TARGET | progress CHUNKS PAPER/NAME ..."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline campaign", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    chunk = commands.add_parser("chunk")
    chunk.add_argument("paper")
    chunk.add_argument("name")
    chunk.add_argument("chunk", type=int)
    merging = commands.add_parser("merge")
    merging.add_argument("paper")
    merging.add_argument("name")
    merging.add_argument("chunks", type=int)
    merging.add_argument("target", choices=("ensemble", "campaign"))
    showing = commands.add_parser("progress")
    showing.add_argument("chunks", type=int)
    showing.add_argument("targets", nargs="*")
    options = parser.parse_args(arguments)
    if options.command == "chunk":
        run_chunk(options.paper, options.name, options.chunk)
    elif options.command == "merge":
        merge(options.paper, options.name, options.chunks, options.target)
    else:
        print(progress(options.targets, options.chunks), flush=True)
    return 0
