"""Run `snakemake --lint` and fail on every finding but the one that asks for a conda environment or a container.

Snakemake's linter exits with 1 for each rule without a software environment of its own; here one locked environment
serves all rules, so its titles are read instead of its exit code.
"""

import re
import subprocess
import sys

ACCEPTED = {
    "Specify a conda environment or container for each rule.",
}


def main():
    """Print the findings that count; exit code 1 if there are any."""
    result = subprocess.run([sys.executable, "-m", "snakemake", "--lint"], capture_output=True, text=True)
    titles = re.findall(r"^    \* (.+?)(?::\s*$|:\n|$)", result.stderr + result.stdout, re.MULTILINE)
    if not titles and result.returncode:
        print(result.stderr)
        return 1
    bad = [title for title in titles if title.rstrip(":") not in ACCEPTED]
    for title in bad:
        print(title)
    print(f"{len(titles)} findings, {len(bad)} count")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
