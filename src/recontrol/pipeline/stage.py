"""Run one stage (model, synthesis, certificates or simulation) of a paper, or one part of it."""

from __future__ import annotations

import argparse
import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from recontrol.errors import StageError
from recontrol.pipeline import inputs, job, store
from recontrol.pipeline.closure import MODULES, ORDER
from recontrol.pipeline.encode import dumps
from recontrol.pipeline.layout import artifact, conclusions, series_file


def run(stage: str, key: str, part: str | None) -> None:
    """Call the stage function and publish what it returns. Raises RecontrolError with the file at fault."""
    store.retract(conclusions(key))
    paper = job.open_paper(key)
    if part is not None and part not in paper.parts(stage):
        raise StageError(f"papers/{key}/paper.yaml: stage {stage} has no part {part!r}")
    function = inputs.function_of(key, MODULES[stage], part or stage)
    config = inputs.load_config()
    os.environ["RECONTROL_SOLVER"] = str(config["solver"]).upper()
    available = inputs.Inputs(paper, config, inputs.before(stage))
    result = available.call(function)
    home = inputs.where(function)
    contents: dict[Path, bytes] = {}
    if stage == "simulation":
        assert part is not None
        if not (isinstance(result, tuple) and len(result) == 2 and all(isinstance(r, Mapping) for r in result)):
            raise StageError(f"{home}: a simulation returns (values, series), two mappings")
        result, series = result
        contents[series_file(key, part)] = pack_series(series, home)
    if not isinstance(result, Mapping) or not result:
        raise StageError(f"{home}: {part or stage} returned {type(result).__name__}; expected a mapping with content")
    contents[artifact(key, stage, part)] = dumps(result).encode()
    job.publish(stage, key, part, contents, inputs.earlier(paper, stage))


def pack_series(series: Mapping[str, Any], home: str) -> bytes:
    """Float arrays as .npz bytes, equal for equal content. Raises StageError for object or non-finite arrays."""
    import numpy as np

    arrays: dict[str, Any] = {}
    for name in sorted(series):
        array = np.asarray(series[name])
        if array.dtype.kind not in "bif":
            raise StageError(f"{home}: series {name!r} has type {array.dtype}; expected real numbers")
        if not np.all(np.isfinite(array)):
            raise StageError(f"{home}: series {name!r} is not finite everywhere")
        arrays[name] = array
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    return buffer.getvalue()


def main(arguments: list[str]) -> int:
    """Command line: STAGE PAPER [PART]."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline stage")
    parser.add_argument("stage", choices=ORDER)
    parser.add_argument("paper")
    parser.add_argument("part", nargs="?")
    options = parser.parse_args(arguments)
    run(options.stage, options.paper, options.part)
    return 0
