"""After a failure: verdicts and report from what exists, so that a failing stage does not hide the rest.

What this writes carries no record of provenance: the next plain run sets it aside and builds it anew.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from recontrol import paper as papers
from recontrol.errors import RecontrolError
from recontrol.pipeline import store, verdicts
from recontrol.pipeline.encode import dumps, encode
from recontrol.pipeline.layout import artifact


def run(keys: list[str]) -> None:
    """Write verdict tables with `failed` claims for what is missing, then the report."""
    tables = []
    for key in keys:
        path = artifact(key, "verdicts")
        if path.exists() and store.mismatch(path) is None:
            tables.append(encode(store.read_json(path)))
            continue
        try:
            content = {"paper": key, "claims": verdicts.evaluate(papers.load(Path("papers") / key))}
        except RecontrolError as error:
            print(f"recontrol: no verdicts for {key}: {error}", file=sys.stderr)
            continue
        _write(path, dumps(content))
        tables.append(encode(content))
    _write(Path("results/verdicts.json"), dumps(tables))
    _report(keys)
    failed = sum(claim["verdict"] == "failed" for table in tables for claim in table["claims"])
    print(f"recontrol: the run failed; {failed} claims are marked failed in results/report/index.html", file=sys.stderr)


def _write(path: Path, text: str) -> None:
    store.record_path(path).unlink(missing_ok=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _report(keys: list[str]) -> None:
    from recontrol import report

    try:
        report.build(Path(), keys)
    except Exception as error:
        print(f"recontrol: the report could not be built: {type(error).__name__}: {error}", file=sys.stderr)
    for path in Path("results/report").rglob("*"):
        store.record_path(path).unlink(missing_ok=True)


def main(arguments: list[str]) -> int:
    """Command line: PAPER ..."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline salvage")
    parser.add_argument("papers", nargs="*")
    run(parser.parse_args(arguments).papers)
    return 0
