"""Run the fault tests at full size and write docs/reliability.md from what pytest reports.

python tools/reliability.py          # the toy paper, 20 kills, 10,000 damaged files of each kind (half an hour)
python tools/reliability.py --all    # 20 kills in runs of all papers too (another half an hour)

The certificates of a finished run of all papers are damaged and its printed digits changed too: RECONTROL_BUILT names
its folder, else it is the one here.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from reliability_rows import ROWS, Row

SIZES = {"RECONTROL_FUZZ": "10000", "RECONTROL_KILLS": "20", "RECONTROL_CERTIFICATES": "20"}
HEAD = """# Reliability

What happens when things go wrong. Every row is a set of tests that inject the fault, look for the message, mend the
cause where there is one, run the plain command again and compare all artifacts with those of a clean run, byte by byte.
`make faults` makes this page from what the tests report; the quick ones also run in `make test`.

The runs that are broken here are those of a toy paper of four small stages, which passes through every rule of the
chain that a real paper passes through; where all papers take part, the row says so.

"""
COLUMNS = "| fault | cases | result | message |\n|---|---|---|---|\n"


@dataclass
class Tally:
    """What the tests of one row reported: cases, outcomes of tests, and the properties that they recorded."""

    cases: int = 0
    outcomes: Counter[str] = field(default_factory=Counter)
    properties: list[tuple[str, str]] = field(default_factory=list)

    def total(self, name: str) -> int:
        """Sum of a recorded number."""
        return sum(int(value) for key, value in self.properties if key == name)

    def listed(self, name: str) -> list[str]:
        """All recorded texts of one name."""
        return [value for key, value in self.properties if key == name]


def outcome(case: ElementTree.Element) -> str:
    """passed, failed or skipped."""
    tags = {child.tag for child in case}
    return "failed" if tags & {"failure", "error"} else "skipped" if "skipped" in tags else "passed"


def tallies(report: Path) -> dict[str, Tally]:
    """Tally of every test function, "file::function", and of every parametrised one, "file::function[...]"."""
    found: dict[str, Tally] = {}
    for case in ElementTree.parse(report).iter("testcase"):
        file = case.get("classname", "").replace(".", "/") + ".py"
        name = f"{file}::{case.get('name', '')}"
        properties = [(p.get("name", ""), p.get("value", "")) for p in case.iter("property")]
        counts = [int(value) for key, value in properties if key == "cases"]
        for key in {name, name.partition("[")[0]}:
            tally = found.setdefault(key, Tally())
            tally.outcomes[outcome(case)] += 1
            tally.cases += sum(counts) if counts else 1
            tally.properties += properties
    return found


def joined(row: Row, found: dict[str, Tally]) -> Tally:
    """The tallies of a row's tests together; a name that ends in "[x" takes the parametrised tests that begin so."""
    total = Tally()
    for test in row.tests:
        keys = [key for key in found if key == test or ("[" in test and key.startswith(test))]
        for key in keys:
            total.cases += found[key].cases
            total.outcomes += found[key].outcomes
            total.properties += found[key].properties
    total.cases *= int(SIZES["RECONTROL_FUZZ"]) if row.hypothesis else 1
    return total


def result(row: Row, tally: Tally) -> str:
    """The third column: what the row's tests found, or how many of them did not pass."""
    if not tally.outcomes:
        return "not run"
    if tally.outcomes["failed"]:
        return f"**{tally.outcomes['failed']} of {tally.outcomes.total()} tests failed**"
    if not tally.outcomes["passed"]:
        return "skipped"
    skipped = f" ({tally.outcomes['skipped']} tests skipped)" if tally.outcomes["skipped"] else ""
    numbers = {name: f"{tally.total(name):,}" for name in ("accepted", "changed")}
    return row.result.format(**numbers) + skipped


def sections(found: dict[str, Tally]) -> Iterator[str]:
    """One table and its explanations for each heading."""
    for heading in dict.fromkeys(row.heading for row in ROWS):
        rows = [row for row in ROWS if row.heading == heading]
        yield f"## {heading}\n\n{COLUMNS}"
        for row in rows:
            tally = joined(row, found)
            yield f"| {row.fault} | {tally.cases:,} | {result(row, tally)} | {row.message} |\n"
        yield "\n" + "\n".join(f"- **{row.fault}.** {row.means}" for row in rows) + "\n\n"


def digits(found: dict[str, Tally]) -> str:
    """The claims whose digits may change without a change of verdict, with the reason."""
    tally = found.get("tests/test_built.py::test_every_printed_digit_that_agrees_matters", Tally())
    if not tally.outcomes["passed"]:
        return ""
    aside: dict[str, list[str]] = {}
    for text in tally.listed("aside"):
        name, _, reason = text.partition(": ")
        aside.setdefault(reason, []).append(f"`{name}`")
    lines = [f"- {reason} ({len(names)}): {', '.join(names)}" for reason, names in aside.items()]
    kept = [f"- `{name}`: {reason}." for name, _, reason in (text.partition(": ") for text in tally.listed("kept"))]
    return (
        "## Digits that may change\n\n"
        "A change of a digit that leaves the verdict as it is, by the nature of the comparison:\n\n"
        + "\n".join(kept)
        + "\n\nAgreeing claims whose print is not compared as a number, so that no digit of it is changed:\n\n"
        + "\n".join(lines)
        + "\n"
    )


def finished_run() -> str:
    """Folder of a finished run of all papers. Stops the program if there is none: the page would lose rows."""
    folder = Path(os.environ.get("RECONTROL_BUILT", ".")).resolve()
    if not (folder / "results/verdicts.json").exists():
        sys.exit(f"reliability: no finished run in {folder}; run `make reproduce`, or name one in RECONTROL_BUILT")
    return str(folder)


def main(arguments: list[str]) -> int:
    """Run, write the page, and pass pytest's exit code on."""
    built = finished_run()
    everything = "--all" in arguments
    sizes = SIZES | ({"RECONTROL_FAULT_PAPERS": "all"} if everything else {})
    tests = list(dict.fromkeys(test.partition("[")[0] for row in ROWS for test in row.tests))
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.xml")
        options = ["-q", "--timeout", "36000", "-o", "junit_family=xunit1", f"--junitxml={report}"]
        command = [sys.executable, "-m", "pytest", *options, *tests]
        status = subprocess.run(command, env=os.environ | sizes | {"RECONTROL_BUILT": built}).returncode
        found = tallies(report)
    page = HEAD + "".join(sections(found)) + digits(found)
    Path("docs/reliability.md").write_text(page.rstrip() + "\n")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
