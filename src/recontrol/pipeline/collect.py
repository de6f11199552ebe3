"""Collect the verdicts of all papers into results/verdicts.json."""

from __future__ import annotations

import argparse
from pathlib import Path

from recontrol.pipeline import store
from recontrol.pipeline.encode import dumps, encode
from recontrol.pipeline.layout import artifact


def run(keys: list[str]) -> None:
    """Write the list of the papers' verdict tables, in the order of their keys."""
    tables = [encode(store.read_json(artifact(key, "verdicts"))) for key in keys]
    inputs = {artifact(key, "verdicts").as_posix(): store.digest_of(artifact(key, "verdicts")) for key in keys}
    made_by = {"stage": "collect", "paper": None, "inputs": inputs}
    store.publish({Path("results/verdicts.json").as_posix(): dumps(tables).encode()}, made_by)


def main(arguments: list[str]) -> int:
    """Command line: PAPER ..."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline collect")
    parser.add_argument("papers", nargs="*")
    run(parser.parse_args(arguments).papers)
    return 0
