"""``python -m recontrol.report COMMAND``: what the rules of the chain call to make what readers see."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from recontrol.errors import RecontrolError


def build(papers: list[str]) -> None:
    """Write results/report and record its files."""
    from recontrol import report

    report.build(Path(), papers)
    _publish("report", Path("results/report"))


def _publish(stage: str, *folders: Path) -> None:
    from recontrol.pipeline import publish

    publish.run(stage, list(folders))


COMMANDS: dict[str, Callable[[list[str]], None]] = {"build": build}


def main(arguments: list[str] | None = None) -> int:
    """Run one command; an error of operation is one message and exit code 1."""
    parser = argparse.ArgumentParser(prog="python -m recontrol.report")
    parser.add_argument("command", choices=sorted(COMMANDS))
    parser.add_argument("papers", nargs="*")
    options = parser.parse_args(arguments)
    try:
        COMMANDS[options.command](options.papers)
    except RecontrolError as error:
        print(f"recontrol: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
