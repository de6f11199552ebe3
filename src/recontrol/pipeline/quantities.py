"""Every number beyond the claims that a paper folder computes, under the names of its paper.yaml."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import Any

import numpy as np

from recontrol.claims.values import STRENGTHS, strength_of, weakest
from recontrol.errors import StageError
from recontrol.paper import Paper
from recontrol.pipeline import inputs, job
from recontrol.pipeline.encode import dumps, encode
from recontrol.pipeline.layout import artifact


def run(key: str) -> None:
    """Write results/<key>/quantities.json."""
    paper = job.open_paper(key)
    rows: list[dict[str, Any]] = []
    if paper.file.quantities:
        function = inputs.function_of(key, "quantities", "quantities")
        available = inputs.Inputs(paper, inputs.load_config(), inputs.before("quantities"))
        rows = table(paper, available.call(function), inputs.where(function))
    job.publish(
        "quantities",
        key,
        None,
        {artifact(key, "quantities"): dumps(rows).encode()},
        inputs.earlier(paper, "quantities"),
    )


def table(paper: Paper, values: Any, home: str) -> list[dict[str, Any]]:
    """Rows name, case, value, unit, strength, description; the names must be exactly those of paper.yaml.

    Raises StageError naming missing and surplus names.
    """
    if not isinstance(values, Mapping):
        raise StageError(f"{home}: quantities returns a mapping name -> value, got {type(values).__name__}")
    missing = sorted(set(paper.file.quantities) - set(values))
    surplus = sorted(set(values) - set(paper.file.quantities))
    if missing or surplus:
        raise StageError(
            f"{home}: quantities of paper.yaml without a value: {', '.join(missing) or 'none'}; "
            f"values without an entry in paper.yaml: {', '.join(surplus) or 'none'}"
        )
    rows = []
    for name, entry in paper.file.quantities.items():
        value = values[name]
        by_case = value if isinstance(value, Mapping) else {None: value}
        for case, item in by_case.items():
            rows.append(
                {
                    "name": name,
                    "case": case,
                    "value": encode(item, name),
                    "unit": entry.unit,
                    "strength": strength(item),
                    "description": entry.what,
                }
            )
    return rows


def strength(value: Any) -> str | None:
    """Strength of a quantity; words and booleans have none, a float without a bound is the weakest."""
    if value is None or isinstance(value, (str, bool)):
        return None
    if isinstance(value, (float, complex, np.generic)):
        return STRENGTHS[0]
    if isinstance(value, np.ndarray):
        return STRENGTHS[0] if value.dtype != object else weakest([strength(item) or "exact" for item in value.ravel()])
    if isinstance(value, (list, tuple)):
        return weakest([strength(item) or "exact" for item in value])
    return strength_of(value)


def main(arguments: list[str]) -> int:
    """Command line: PAPER."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline quantities")
    parser.add_argument("paper")
    run(parser.parse_args(arguments).paper)
    return 0
