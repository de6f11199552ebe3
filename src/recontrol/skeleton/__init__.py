"""`recontrol new`: a paper folder that already runs, with FILL IN where the new paper's own content goes."""

from __future__ import annotations

import re
import shutil
from importlib.resources import files
from pathlib import Path

from recontrol.errors import PaperError

REFERENCE = ("decay.csv", "REASONS.md")
"""Files that go into reference/."""


def create(root: Path, key: str) -> str:
    """Write papers/<key> from the skeleton and return what to do next.

    Raises PaperError for a key of another form, a folder that exists, or a place that is no project. The folder appears
    as a whole or not at all.
    """
    if not re.fullmatch(r"[a-z]+[0-9]{4}[a-z]?", key):
        raise PaperError(f"key {key!r}: expected the first author and the year in small letters, such as smith2024")
    if not (root / "papers").is_dir():
        raise PaperError(f"{root.resolve()}: holds no papers/ folder; go to the project's folder or give -C DIR")
    folder = root / "papers" / key
    if folder.exists():
        raise PaperError(f"{folder}: exists already; choose another key or remove the folder")
    scratch = folder.with_name(f".{key}.new")
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "reference").mkdir(parents=True)
    year = re.sub(r"\D", "", key)
    for entry in sorted(files("recontrol.skeleton").joinpath("files").iterdir(), key=lambda item: item.name):
        name = entry.name.removesuffix(".txt")
        target = scratch / "reference" / name if name in REFERENCE else scratch / name
        text = entry.read_text(encoding="utf-8").replace("KEY", key).replace("YEAR", year)
        target.write_text(text, encoding="utf-8")
    scratch.rename(folder)
    return _next(folder, key)


def _next(folder: Path, key: str) -> str:
    marked = sorted(path.name for path in folder.iterdir() if path.is_file() and "FILL IN" in path.read_text())
    return "\n".join(
        [
            f"{folder}: made, and it runs as it is: snakemake --cores 2 {key}",
            f"Now replace what is marked FILL IN ({', '.join(marked)}) and the made-up plant in the other files:",
            "  1. paper.yaml     data and published matrices as printed, quantities, figures",
            "  2. claims.yaml    everything the paper prints, with its readings and the verdict you expect",
            "  3. model.py, synthesis.py, simulation.py, figures.py, quantities.py, readings.py",
            "  4. NOTES.md       what is ambiguous or assumed",
            f"Check the folder at any time without running it: recontrol check {key}",
            f"New reference data of a figure: python -m recontrol.pipeline reference {key} FIGURE --why '...'",
        ]
    )
