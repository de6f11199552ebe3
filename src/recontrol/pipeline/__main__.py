"""`python -m recontrol.pipeline COMMAND ...`: what the rules of the chain call."""

from __future__ import annotations

import importlib
import sys

from recontrol.pipeline import environment

COMMANDS = (
    "stage",
    "figure",
    "verdicts",
    "quantities",
    "collect",
    "review",
    "reference",
    "salvage",
    "campaign",
)


def main(arguments: list[str]) -> int:
    """Run one command; an error of operation is one message and exit code 1 (a traceback only if it is a bug)."""
    environment.pin()
    if not arguments or arguments[0] not in COMMANDS:
        print(f"usage: python -m recontrol.pipeline {{{','.join(COMMANDS)}}} ...", file=sys.stderr)
        return 2
    from recontrol.errors import RecontrolError

    command = importlib.import_module(f"recontrol.pipeline.{arguments[0]}")
    try:
        return int(command.main(arguments[1:]))
    except RecontrolError as error:
        print(f"recontrol: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
