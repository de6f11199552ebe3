"""``python -m recontrol.report COMMAND``: what the rules of the chain and the Makefile call."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from recontrol.errors import RecontrolError

ROOT = Path()


def build(papers: list[str]) -> None:
    """Write results/report."""
    from recontrol import report
    from recontrol.pipeline import publish

    _forget(Path("results/report"))
    report.build(ROOT, papers)
    publish.run("report", [Path("results/report")])


def export(papers: list[str]) -> None:
    """Write MATLAB files, plain JSON and time series of the papers."""
    from recontrol.report import exports

    for key in papers:
        _publish("export", exports.files(ROOT, key), key)


def index(papers: list[str]) -> None:
    """Write results/index.json."""
    from recontrol.report import artifacts

    text = json.dumps(artifacts.index(ROOT, papers), sort_keys=True, indent=1, ensure_ascii=False) + "\n"
    _publish("index", {"results/index.json": text.encode()})


def latex(papers: list[str]) -> None:
    """Write results/latex."""
    from recontrol.report import latex as texts

    _publish("latex", {f"results/latex/{name}": text.encode() for name, text in texts.files(ROOT, papers).items()})


def crate(papers: list[str]) -> None:
    """Write results/crate."""
    from recontrol.pipeline import publish
    from recontrol.report import crate as crates

    _forget(Path("results/crate"))
    crates.build(ROOT, papers, Path("results/crate"))
    publish.run("crate", [Path("results/crate")])


def book(papers: list[str]) -> None:
    """Write VERDICTS.md, docs/errata and the counts of the README."""
    from recontrol.report import book as pages

    for name, text in pages.files(ROOT, papers).items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text, encoding="utf-8")
        print(name)


def bundle(papers: list[str]) -> None:
    """Write run/bundle/recontrol-<version>.tar.gz."""
    from recontrol.report import bundle as bundles

    print(bundles.build(ROOT))


def _forget(folder: Path) -> None:
    """Drop the records of a folder that is made anew as a whole, so that none outlives its file."""
    from recontrol.pipeline import store

    for record in (store.RECORDS / folder).rglob("*.json"):
        record.unlink()


def _publish(stage: str, contents: Mapping[str, bytes], paper: str | None = None) -> None:
    from recontrol.pipeline import store

    store.publish(contents, {"stage": stage, "paper": paper})


COMMANDS: dict[str, Callable[[list[str]], None]] = {
    command.__name__: command for command in (build, export, index, latex, crate, book, bundle)
}


def main(arguments: list[str] | None = None) -> int:
    """Run one command; an error of operation is one message and exit code 1."""
    parser = argparse.ArgumentParser(prog="python -m recontrol.report")
    parser.add_argument("command", choices=COMMANDS)
    parser.add_argument("papers", nargs="*", help="keys; all folders under papers/ if none is given")
    options = parser.parse_args(arguments)
    papers = options.papers or sorted(path.parent.name for path in ROOT.glob("papers/*/paper.yaml"))
    try:
        COMMANDS[options.command](papers)
    except RecontrolError as error:
        print(f"recontrol: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
