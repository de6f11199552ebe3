"""The command line: look at papers and claims, check and start folders, verify proofs, cite and compare results."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from recontrol.errors import RecontrolError


def main(arguments: list[str] | None = None) -> int:
    """Run one command; an error is one clear line on the error stream and an exit code that is not 0."""
    options = parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except RecontrolError as error:
        print(f"recontrol: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    top = argparse.ArgumentParser(prog="recontrol", description=__doc__)
    top.add_argument(
        "-C", dest="root", type=Path, default=Path(), metavar="DIR", help="the project's folder (default: here)"
    )
    commands = top.add_subparsers(title="commands", required=True, metavar="COMMAND")

    def add(name: str, run: object, help: str, *names: tuple[str, str]) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=help, description=help)
        for argument, meaning in names:
            command.add_argument(argument.lower(), metavar=argument, help=meaning)
        command.set_defaults(run=run)
        return command

    add("list", _list, "list the papers with their verdict counts")
    add("show", _show, "show one paper: advice, claims and verdicts", ("PAPER", "a key such as hashim2015"))
    add("explain", _explain, "explain one verdict", ("CLAIM", "paper/claim, such as hashim2015/eq55-11"))
    add("check", _check, "validate a paper folder without running it", ("PAPER", "a key or the path of a folder"))
    add("new", _new, "start a paper folder from a skeleton", ("KEY", "first author and year, such as smith2024"))
    verify = add("verify", _verify, "verify certificates, standing alone and against the printed data")
    verify.add_argument("arguments", nargs=argparse.REMAINDER, metavar="FILE", help="certificate files")
    add("cite", _cite, "print how to cite a claim or an artifact", ("ID", "an identity, such as wan2014/eq44-K"))
    add("diff", _diff, "compare two runs", ("RUN_A", "a folder that holds results/"), ("RUN_B", "another one"))
    return top


def _list(options: argparse.Namespace) -> int:
    from recontrol.report import terminal

    print(terminal.list_papers(options.root))
    return 0


def _show(options: argparse.Namespace) -> int:
    from recontrol.report import terminal

    print(terminal.show_paper(options.root, options.paper))
    return 0


def _explain(options: argparse.Namespace) -> int:
    from recontrol.report import terminal

    print(terminal.explain(options.root, options.claim))
    return 0


def _check(options: argparse.Namespace) -> int:
    from recontrol import contract

    given = Path(options.paper)
    folder = given if given.is_dir() else options.root / "papers" / options.paper
    claims = contract.check(folder)
    print(f"{folder}: valid, {claims} claims")
    return 0


def _new(options: argparse.Namespace) -> int:
    from recontrol import skeleton

    print(skeleton.create(options.root, options.key))
    return 0


def _verify(options: argparse.Namespace) -> int:
    from importlib import import_module

    return int(import_module("recontrol.lmi.verify").main(options.arguments, options.root))


def _cite(options: argparse.Namespace) -> int:
    from recontrol.report import cite

    print(cite.text(options.root, options.id))
    return 0


def _diff(options: argparse.Namespace) -> int:
    from recontrol.report import difference

    lines = difference.between(Path(options.run_a), Path(options.run_b))
    print("\n".join(lines) if lines else "The two runs agree.")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
