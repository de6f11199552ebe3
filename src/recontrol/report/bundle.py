"""What one would deposit in an archive: sources, locks, paper folders, results, figures, and a manifest of digests."""

from __future__ import annotations

import gzip
import hashlib
import io
import tarfile
from pathlib import Path

from recontrol.errors import MissingArtifactError
from recontrol.report import bibtex

KEPT = (
    "README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md", "VERDICTS.md", "Makefile", "Snakefile", "pyproject.toml",
    "environment.lock", "environment-test.lock", "config", "docs", "papers", "profiles", "rules", "schemas", "src",
    "tests", "tools", "results", "figures",
)  # fmt: skip
LEFT_OUT = ("__pycache__", ".part")


def build(root: Path, target: Path | None = None) -> Path:
    """Write run/bundle/recontrol-<version>.tar.gz, equal bytes for equal trees, and return its path.

    Raises MissingArtifactError before a run is finished.
    """
    if not (root / "results" / "report" / "index.html").is_file():
        raise MissingArtifactError("results/report/index.html: missing; run `snakemake --cores 2 all` first")
    name = f"recontrol-{bibtex.version()}"
    target = target or root / "run" / "bundle" / f"{name}.tar.gz"
    target.parent.mkdir(parents=True, exist_ok=True)
    paths = files(root)
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as archive:
        _add(archive, f"{name}/MANIFEST.sha256", manifest(root, paths).encode())
        for path in paths:
            _add(archive, f"{name}/{path.as_posix()}", (root / path).read_bytes())
    with target.open("wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
        packed.write(buffer.getvalue())
    return target


def files(root: Path) -> list[Path]:
    """Return the files of the bundle, relative to the project, sorted."""
    found: list[Path] = []
    for name in KEPT:
        top = root / name
        found += [top] if top.is_file() else [path for path in top.rglob("*") if path.is_file()]
    kept = [path.relative_to(root) for path in found if not any(word in path.as_posix() for word in LEFT_OUT)]
    return sorted(kept)


def manifest(root: Path, paths: list[Path]) -> str:
    """Return one line a file, in the form that `sha256sum --check` reads."""
    lines = [f"{hashlib.sha256((root / path).read_bytes()).hexdigest()}  {path.as_posix()}" for path in paths]
    return "\n".join(lines) + "\n"


def _add(archive: tarfile.TarFile, name: str, content: bytes) -> None:
    entry = tarfile.TarInfo(name)
    entry.size, entry.mode = len(content), 0o644
    archive.addfile(entry, io.BytesIO(content))
