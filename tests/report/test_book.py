"""The committed pages: verdict book, errata sheets, counts; and the bundle for an archive."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tarfile
from pathlib import Path

import fake
import pytest

from recontrol.errors import MissingArtifactError
from recontrol.report import book, bundle

ROOT = Path(__file__).parents[2]


def test_the_verdict_book_lists_every_claim_and_counts_scans_apart(tree: Path) -> None:
    text = book.files(tree, [fake.KEY])["VERDICTS.md"]
    rows = [line for line in text.splitlines() if line.startswith(("| eq", "| s2", "| s3", "| fig"))]
    assert len(rows) == 10
    assert all(row.count("|") - row.count("\\|") == 8 for row in rows)
    assert "| fake2020 | 1 | 1 | 1 | 2 | 1 | 1 | 1 | 2 | 10 |" in text
    assert "| eq65-2 | (65) | second entry of the gain | 0.5147 | 0.5148 | erratum; explained by cut | ball |" in text
    assert "| erratum (may be the scan's) | exact |" in text


def test_the_errata_sheet_gives_place_print_finding_reason_and_proof(tree: Path) -> None:
    text = book.files(tree, [fake.KEY])[f"docs/errata/{fake.KEY}.md"]
    first = text[text.index("### 1. (55) rows 1-4") : text.index("### 2.")]
    assert "- Printed: 16 entries" in first
    assert "- Origin: A - 2BK" in first
    assert "`recontrol explain fake2020/eq55-11`" in first
    last = text[text.index("### 1. (55)(6,5)") :]
    assert "- Correct: a shift row has $1$" in last
    assert "- The paper's numbers: the right version" in last
    assert text.index("## In print") < text.index("may be the scan's") < text.index("(55)(6,5)")


def test_the_readme_keeps_everything_outside_the_markers(tree: Path, tmp_path: Path) -> None:
    start, end = book.COUNTS
    text = book.with_counts(f"before\n{start}\nold\n{end}\nafter\n", [])
    assert text.startswith(f"before\n{start}\n| paper |")
    assert text.endswith(f"{end}\nafter\n")
    assert "old" not in text
    assert book.with_counts("no markers", []) == "no markers"


def test_without_verdicts_the_book_is_refused(tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    (root / "results" / fake.KEY / "verdicts.json").unlink()
    with pytest.raises(MissingArtifactError, match="run `snakemake"):
        book.files(root, [fake.KEY])


def test_the_committed_book_is_that_of_the_last_build() -> None:
    """`make test` builds everything from nothing first and says where."""
    built = os.environ.get("RECONTROL_BUILT")
    if not built:
        pytest.skip("no finished build named by RECONTROL_BUILT")
    papers = sorted(path.parent.name for path in ROOT.glob("papers/*/paper.yaml"))
    made = book.files(Path(built), papers)
    stale = [name for name, text in made.items() if not (ROOT / name).is_file() or (ROOT / name).read_text() != text]
    assert stale == [], f"stale: {', '.join(stale)}; run `make book` and look at the difference"


def test_the_bundle_has_a_manifest_that_checks_and_repeats(tmp_path: Path) -> None:
    root = fake.write(tmp_path / "project")
    with pytest.raises(MissingArtifactError):
        bundle.build(root)
    page = root / "results" / "report" / "index.html"
    page.parent.mkdir()
    page.write_text("report")
    (root / "run").mkdir(exist_ok=True)
    first = bundle.build(root).read_bytes()
    assert bundle.build(root, tmp_path / "again.tar.gz").read_bytes() == first
    with tarfile.open(tmp_path / "again.tar.gz") as archive:
        archive.extractall(tmp_path / "out", filter="data")
    (folder,) = (tmp_path / "out").iterdir()
    lines = (folder / "MANIFEST.sha256").read_text().splitlines()
    assert {line.split("  ")[1] for line in lines} >= {"results/report/index.html", "papers/fake2020/claims.yaml"}
    for line in lines:
        digest, name = line.split("  ")
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest
    if shutil.which("sha256sum"):
        subprocess.run(["sha256sum", "--check", "--quiet", "MANIFEST.sha256"], cwd=folder, check=True)
