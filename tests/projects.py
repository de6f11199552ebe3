"""Small projects to run the chain in, shared by the tests."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from tools import tree

ROOT = tree.ROOT


class Project:
    """A working copy of the chain in a folder of its own."""

    def __init__(self, folder: Path):
        self.folder = folder

    def snakemake(self, *arguments: str, check: bool = True, timeout: float = 240) -> subprocess.CompletedProcess[str]:
        """Run `snakemake --cores 2 ...` and return its output; with `check`, a failure shows the whole output."""
        result = subprocess.run(
            self.command(*arguments),
            cwd=self.folder,
            env=clean_environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=timeout,
        )
        if check and result.returncode:
            raise AssertionError(f"snakemake failed with {result.returncode}\n{result.stdout}")
        return result

    def start(self, *arguments: str, output: int = subprocess.PIPE) -> subprocess.Popen[str]:
        """Start a run in a process group of its own. Nobody may read its output for long: then send it elsewhere."""
        return subprocess.Popen(
            self.command(*arguments),
            cwd=self.folder,
            env=clean_environment(),
            stdout=output,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def pipeline(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run one command of recontrol.pipeline."""
        environment = clean_environment() | {"PYTHONPATH": f"{self.folder / 'src'}{os.pathsep}{self.folder}"}
        command = [sys.executable, "-m", "recontrol.pipeline", *arguments]
        return subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=240)

    @staticmethod
    def command(*arguments: str) -> list[str]:
        return [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]

    def edit(self, name: str, old: str, new: str) -> None:
        """Replace text of one file; the text must be there."""
        path = self.folder / name
        text = path.read_text()
        assert old in text, f"{name} does not contain {old!r}"
        path.write_text(text.replace(old, new))

    def artifacts(self) -> dict[str, bytes]:
        """All bytes under results/ and figures/."""
        return {
            path.relative_to(self.folder).as_posix(): path.read_bytes()
            for top in ("results", "figures")
            for path in sorted((self.folder / top).rglob("*"))
            if path.is_file()
        }


def clean_environment() -> dict[str, str]:
    """The environment without what a developer's shell or pytest may have set."""
    return {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "RECONTROL_RUN")}


def make_project(folder: Path, papers: dict[str, Path]) -> Project:
    """Copy the chain and some paper folders into `folder`."""
    tree.copy(folder, tree.CHAIN)
    for key, source in papers.items():
        tree.copy_into(source, folder / "papers" / key)
    return Project(folder)
