"""Robustness campaigns: seeded chunks of trajectories, merged into distributions.

A paper's campaign.py holds one function a campaign: it draws `count` members of the ensemble with the generator `rng`
and returns the outcomes of their trajectories, one array of `count` numbers for each outcome that paper.yaml names. Its
campaign_bounds.py holds a function of the same name, which says what is proven of each outcome for all members.
Chunk k always draws the same members, whatever the size of the campaign and the order of the jobs.
"""

from __future__ import annotations

import argparse
import math
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from recontrol.campaign.proven import Bound
from recontrol.campaign.sketch import Sketch
from recontrol.errors import StageError, UnknownNameError
from recontrol.paper import Paper
from recontrol.pipeline import closure, inputs, job, store
from recontrol.pipeline.encode import dumps, sha256
from recontrol.pipeline.layout import basis_file, chunk_ranges, chunks_file, distribution_file
from recontrol.pipeline.progress import progress

SETTINGS = ("config/config.yaml", "environment.lock")
LEVELS = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)


def generator(seed: int, chunk: int) -> np.random.Generator:
    """The generator of a chunk: independent streams of one seed."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(chunk,)))


def basis(key: str) -> None:
    """Publish the digests of code, settings, paper.yaml and earlier artifacts, the one input of every chunk."""
    paper = job.open_paper(key)
    sources = [*closure.code_of("campaign", key), *SETTINGS, f"papers/{key}/paper.yaml"]
    content = {
        "paper": key,
        "sources": {name: sha256(Path(name).read_bytes()) for name in sources},
        "artifacts": {path.as_posix(): store.digest_of(path) for path in _earlier(paper)},
    }
    job.publish("campaign", key, None, {basis_file(key): dumps(content).encode()}, _earlier(paper))


def run_chunks(key: str, name: str, first: int, last: int) -> None:
    """Simulate the chunks `first` to `last`, one after the other, and publish the merged sketches of their outcomes."""
    paper = job.open_paper(key)
    entry = _entry(paper, name)
    config = inputs.load_config()
    size = int(config["chunk"])
    function = inputs.function_of(key, "campaign", name)
    available = inputs.Inputs(paper, config, inputs.before("campaign"))
    merged = {outcome: Sketch(described.worst) for outcome, described in entry.outcomes.items()}
    for chunk in range(first, last + 1):
        outcomes = available.call(function, rng=generator(int(entry.seed), chunk), count=size)
        found = sketch_all(outcomes, entry, size, chunk * size, inputs.where(function))
        merged = {outcome: merged[outcome].merge(sketch) for outcome, sketch in found.items()}
    sketches = {outcome: sketch.to_json() for outcome, sketch in merged.items()}
    content = {"paper": key, "campaign": name, "first": first, "last": last, "chunk": size, "outcomes": sketches}
    contents = {chunks_file(key, name, first, last): dumps(content).encode()}
    job.publish("campaign", key, name, contents, _earlier(paper))


def sketch_all(outcomes: Any, entry: Any, count: int, first: int, home: str) -> dict[str, Sketch]:
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
        sketches[outcome] = sketch
    return sketches


def merge(key: str, name: str, sizes: tuple[int, int, int], target: str) -> None:
    """Merge the first chunks into the distribution of each outcome.

    sizes: the arguments of `chunk_ranges`; target: `ensemble` (part of every run) or `campaign` (the large one). Raises
    StageError if a trajectory contradicts its proven bound.
    """
    paper = job.open_paper(key)
    entry = _entry(paper, name)
    merged = {outcome: Sketch(described.worst) for outcome, described in entry.outcomes.items()}
    files = [chunks_file(key, name, *ends) for ends in chunk_ranges(*sizes)]
    size = 0
    for path in files:
        content = store.read_json(path)
        size = int(content["chunk"])
        for outcome in merged:
            merged[outcome] = merged[outcome].merge(Sketch.from_json(content["outcomes"][outcome]))
    bounds = bounds_of(paper, name)
    content = {
        "paper": key,
        "campaign": name,
        "what": entry.what,
        "seed": int(entry.seed),
        "chunk": size,
        "outcomes": {
            outcome: describe(sketch, bounds[outcome])
            | {"unit": entry.outcomes[outcome].unit, "what": entry.outcomes[outcome].what}
            for outcome, sketch in merged.items()
        },
    }
    refuse_contradictions(content)
    contents = {distribution_file(key, name, target): dumps(content).encode(), **_pictures(content, target)}
    job.publish("campaign", key, name, contents, [*files, basis_file(key), *_earlier(paper)])


def refuse_contradictions(content: Mapping[str, Any]) -> None:
    """Raise StageError, naming the worst trajectory, if an outcome lies beyond what is proven for every member."""
    said = []
    for outcome, row in content["outcomes"].items():
        bound = Bound(row["bound"], row["bound_by"])
        value = row["maximum"] if row["worst"] == "max" else row["minimum"]
        value = math.inf if row["diverged"] or value is None else value
        if bound.contradicted_by(value, row["worst"]):
            chunk, member = divmod(row["worst_index"], content["chunk"])
            said.append(
                f"outcome {outcome!r}: trajectory {row['worst_index']} (chunk {chunk}, member {member}, seed "
                f"{content['seed']}) gives {'no finite value' if math.isinf(value) else f'{value!r}'}, beyond the "
                f"bound {bound.value!r} [{row['unit']}] that is proven for all ({bound.by})"
            )
    if said:
        raise StageError(f"papers/{content['paper']}/campaign.py: campaign {content['campaign']}: " + "; ".join(said))


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


def describe(sketch: Sketch, bound: Bound) -> dict[str, Any]:
    """Extremes, bracketed quantiles (null where not finite), the worst trajectory's number, and the proven bound."""
    row = sketch.to_json()
    found = {f"{level:g}": sketch.quantile(level) for level in LEVELS}
    row["quantiles"] = {level: None if ends is None else list(ends) for level, ends in found.items()}
    return row | bound.to_json()


def bounds_of(paper: Paper, name: str) -> dict[str, Bound]:
    """What is proven by outcome, from the function of campaign_bounds.py that bears the campaign's name.

    Raises StageError unless it gives a bound, or says why there is none, for every outcome.
    """
    try:
        function = inputs.function_of(paper.key, closure.BOUNDS, name)
    except StageError as error:
        raise StageError(
            f"{error}; campaign {name!r} needs a function of its name there, which says what is proven of each outcome"
        ) from None
    available = inputs.Inputs(paper, inputs.load_config(), inputs.before("campaign"))
    found = available.call(function)
    wanted = set(_entry(paper, name).outcomes)
    stated = {outcome for outcome, bound in dict(found).items() if isinstance(bound, Bound)}
    if stated != wanted:
        raise StageError(
            f"{inputs.where(function)}: states {sorted(stated)}, paper.yaml names the outcomes {sorted(wanted)}; "
            "give each a Bound of recontrol.campaign.proven, or unproven('why')"
        )
    return dict(found)


def _entry(paper: Paper, name: str) -> Any:
    if name not in paper.file.campaigns:
        known = ", ".join(paper.file.campaigns) or "none"
        raise UnknownNameError(f"papers/{paper.key}/paper.yaml: no campaign {name!r}; campaigns: {known}")
    return paper.file.campaigns[name]


def _earlier(paper: Paper) -> list[Path]:
    return inputs.earlier(paper, "campaign")


def main(arguments: list[str]) -> int:
    """Command line: basis PAPER | chunks PAPER NAME FIRST LAST | merge PAPER NAME TARGET SIZES | progress SIZES NAMES.

    NAMES: PAPER/NAME ...; SIZES: chunks of the campaign, chunks in a job, chunks of every run.
    """
    parser = argparse.ArgumentParser(prog="recontrol.pipeline campaign", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    simulating, merging, showing = (commands.add_parser(name) for name in ("chunks", "merge", "progress"))
    commands.add_parser("basis").add_argument("paper")
    for command in (simulating, merging):
        command.add_argument("paper")
        command.add_argument("name")
    simulating.add_argument("first", type=int)
    simulating.add_argument("last", type=int)
    merging.add_argument("target", choices=("ensemble", "campaign"))
    for command in (merging, showing):
        command.add_argument("sizes", type=int, nargs=3)
    showing.add_argument("targets", nargs="*")
    options = parser.parse_args(arguments)
    if options.command == "basis":
        basis(options.paper)
    elif options.command == "chunks":
        run_chunks(options.paper, options.name, options.first, options.last)
    elif options.command == "merge":
        merge(options.paper, options.name, tuple(options.sizes), options.target)
    else:
        print(progress(options.targets, tuple(options.sizes)), flush=True)
    return 0
