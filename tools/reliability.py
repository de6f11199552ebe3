"""Run every fault test and write docs/reliability.md from what pytest reports.

python tools/reliability.py          # the toy paper, 20 kills, 10,000 mutated files
python tools/reliability.py --all    # the same kills on all papers (hours)
"""

import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TESTS = ["tests/test_faults.py", "tests/test_fuzz.py", "tests/test_pipeline.py", "tests/lmi"]
HEAD = """# Reliability

What happens when things go wrong. Each row is a test: the fault is injected, the message is looked for, the plain
command is run again, and the artifacts must equal those of a clean run byte by byte. `make faults` makes this table.

| fault | cases | passed | skipped |
|---|---|---|---|
"""


def environment(everything):
    """Sizes of the long run."""
    sizes = {"RECONTROL_FUZZ": "10000", "RECONTROL_KILLS": "20"}
    if everything:
        sizes["RECONTROL_FAULT_PAPERS"] = "all"
    return os.environ | sizes


def descriptions():
    """Test name -> first line of its docstring, or its name in words."""
    import ast

    found = {}
    for path in [
        p for name in TESTS for p in ([Path(name)] if name.endswith(".py") else sorted(Path(name).glob("*.py")))
    ]:
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                words = (ast.get_docstring(node) or "").splitlines()
                found[node.name] = words[0].rstrip(".") if words else node.name[5:].replace("_", " ")
    return found


def table(report):
    """Rows of the table from a JUnit report."""
    words = descriptions()
    counts = {}
    for case in ElementTree.parse(report).iter("testcase"):
        name = case.get("name", "").partition("[")[0]
        row = counts.setdefault(words.get(name, name), [0, 0, 0])
        row[0] += 1
        row[1] += not [child for child in case if child.tag in ("failure", "error", "skipped")]
        row[2] += any(child.tag == "skipped" for child in case)
    return "".join(f"| {fault} | {n} | {passed} | {skipped} |\n" for fault, (n, passed, skipped) in counts.items())


def main(arguments):
    """Run, write the table, and pass pytest's exit code on."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.xml")
        command = [sys.executable, "-m", "pytest", "-q", "--timeout", "36000", f"--junitxml={report}", *TESTS]
        status = subprocess.run(command, env=environment("--all" in arguments)).returncode
        Path("docs/reliability.md").write_text(HEAD + table(report))
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
