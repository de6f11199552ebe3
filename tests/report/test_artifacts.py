"""Identities, digests, citations, comparison of runs, and LaTeX."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import bibtexparser
import fake
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recontrol.errors import MissingArtifactError, UnknownNameError
from recontrol.report import artifacts, cite, difference, latex, tex


def test_identities_are_unique_and_cover_every_kind(tree: Path) -> None:
    index = artifacts.index(tree, [fake.KEY])
    entries = index["artifacts"]
    names = [entry["identity"] for entry in entries]
    assert len(names) == len(set(names))
    expected = "claims/eq55-11 quantities/margin/yaw synthesis/lqr/K synthesis/lqr certificates/loop-full figures/fig3"
    assert {f"{fake.KEY}/{name}" for name in expected.split()} <= set(names)
    assert {entry["file"] for entry in entries} == set(index["files"])
    assert all(re.fullmatch("[0-9a-f]{64}", file["sha256"]) for file in index["files"].values())


@pytest.mark.parametrize(
    ("short", "full"),
    [
        ("fake2020/eq55-11", "fake2020/claims/eq55-11"),
        ("fake2020/K", "fake2020/synthesis/lqr/K"),
        ("fake2020/fig3", "fake2020/figures/fig3"),
        ("fake2020/synthesis/lqr", "fake2020/synthesis/lqr"),
    ],
)
def test_short_forms_lead_to_one_identity(tree: Path, short: str, full: str) -> None:
    assert artifacts.lookup(tree, short)["identity"] == full


def test_ambiguous_and_unknown_identities_say_what_there_is(tree: Path) -> None:
    with pytest.raises(
        UnknownNameError, match="is ambiguous; there are: fake2020/synthesis/lqr/sdp/solvers/CLARABEL/value"
    ):
        artifacts.lookup(tree, "fake2020/value")
    with pytest.raises(UnknownNameError, match="is unknown; `recontrol show fake2020` and"):
        artifacts.lookup(tree, "fake2020/nothing-of-the-kind")
    with pytest.raises(UnknownNameError, match="no paper 'nobody1999'"):
        artifacts.lookup(tree, "nobody1999/x")


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e50, max_value=1e50))
@settings(derandomize=True, deadline=None)
def test_canonical_numbers_keep_six_digits(value: float) -> None:
    shown = artifacts.canonical(value)
    assert float(shown) == pytest.approx(value, rel=0.51e-5, abs=1e-12)


def test_last_bits_change_the_digest_and_not_the_canonical_one() -> None:
    a = {"K": [[0.1 + 0.2, 1e-17]], "text": "x = 0.30000000000000004", "exact": "1/3", "n": 3}
    b = {"K": [[0.3, -3e-18]], "text": "x = 0.3000000001", "exact": "1/3", "n": 3}
    assert artifacts.digest(a) != artifacts.digest(b)
    assert artifacts.digest(artifacts.canonical(a)) == artifacts.digest(artifacts.canonical(b))
    assert artifacts.canonical({"K": 0.3001}) != artifacts.canonical({"K": 0.3})
    for text in ("(55), 2013, 1/3", "sha256:4e99999e3456", "1.2.3", "0.15.0e5f"):
        assert artifacts.canonical(text) == text
    assert artifacts.canonical("-0.4675123456+1.0786123456i.") == "-4.67512e-01+1.07861e+00i."


def test_inputs_and_stage_come_from_the_record_of_the_artifact(tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    record = root / "run" / "provenance" / "results" / fake.KEY / "synthesis" / "lqr.json.json"
    record.parent.mkdir(parents=True)
    record.write_text(json.dumps({"stage": "synthesis", "inputs": {"results/fake2020/model.json": "ab"}}))
    entry = artifacts.lookup(root, "fake2020/synthesis/lqr")
    assert entry["stage"] == "synthesis"
    assert entry["inputs"] == {"results/fake2020/model.json": "ab"}


def test_citing_gives_a_sentence_valid_bibtex_and_the_digest(tree: Path) -> None:
    text = cite.text(tree, "fake2020/eq65-2")
    first = text.splitlines()[0]
    assert first.startswith("Author and Author (2020), (65): second entry of the gain, printed as 0.5147,")
    assert "“erratum” in ball arithmetic; found: 0.514823" in first
    library = bibtexparser.parse_string(text)
    assert library.failed_blocks == []
    assert [entry.key for entry in library.entries] == ["fake2020", "recontrol-fake2020-claims-eq65-2"]
    digest = artifacts.lookup(tree, "fake2020/eq65-2")["digest"]
    assert f"note = {{SHA-256 {digest}}}" in text
    assert f"digest             {digest}" in text


def test_a_scanned_erratum_is_cited_as_such(tree: Path) -> None:
    assert "possibly the scan's" in cite.text(tree, "fake2020/eq55-e65")
    assert "was computed from the problem data" in cite.text(tree, "fake2020/quantities/margin/yaw")


def test_equal_runs_do_not_differ(tree: Path, tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    assert difference.between(tree, root) == []
    assert difference.between(tree / "results", root) == []


def test_a_changed_verdict_quantity_and_figure_are_each_one_line(tree: Path, tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    for path, old, new in [
        (root / "results" / fake.KEY / "verdicts.json", '"verdict": "certified"', '"verdict": "failed"'),
        (root / "results" / fake.KEY / "quantities.json", "12.25", "12.26"),
        (root / "figures" / fake.KEY / "fig3.csv", "full,0,0", "full,0,1"),
    ]:
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))
    lines = difference.between(tree, root)
    assert [line.split()[0].split("/")[1] for line in lines] == ["claims", "figures", "quantities"]
    assert "certified [exact] definite  ->  failed [exact] definite" in lines[0]


def test_a_folder_without_results_is_refused(tree: Path, tmp_path: Path) -> None:
    with pytest.raises(MissingArtifactError, match="folder of a finished run"):
        difference.between(tree, tmp_path)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a_b & 50 %", r"a\_b \& 50 \%"),
        ("the gain $K_1$ of `A_ce`", r"the gain $K_1$ of \texttt{A\_ce}"),
        ("≤ 2", r"$\leq$ 2"),
    ],
)
def test_text_is_escaped_and_formulas_are_kept(text: str, shown: str) -> None:
    assert tex.markdown(text) == shown


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("-0.0250", "$-0.0250$"),
        ("3.036e+02", r"$3.036\times10^{2}$"),
        ("1.13e-3", r"$1.13\times10^{-3}$"),
        ("-0.4675+-1.0786i", r"$-0.4675\pm 1.0786\mathrm{i}$"),
    ],
)
def test_numbers_are_set_in_math(text: str, shown: str) -> None:
    assert tex.number(text) == shown


DOCUMENT = r"""\documentclass{article}
\usepackage{amsmath,booktabs,longtable}
\input{claims.tex}
\begin{document}
(55) prints \RCprinted{fake2020/eq55-11}, found \RCfound{fake2020/eq55-11}: \RCverdict{fake2020/eq55-11}
(\RCstrength{fake2020/eq55-11}, \RCwhere{fake2020/eq55-11}, \RCtitle{fake2020/eq55-11}, \RCreading{fake2020/eq65-2}
\RCunit{fake2020/eq65-2}). \RCcount{fake2020}{erratum} of \RCcount{fake2020}{reproduced}, \RCcount{fake2020}{nothing}.
\input{counts.tex}
\input{fake2020-claims.tex}
\cite{fake2020}\bibliographystyle{plain}\bibliography{papers}
\end{document}
"""


def test_macros_and_tables_compile(tree: Path, tmp_path: Path) -> None:
    if shutil.which("pdflatex") is None and os.environ.get("RECONTROL_REQUIRE_TEX") != "1":
        pytest.skip("no pdflatex on this machine (Debian: texlive-latex-recommended)")
    for name, text in latex.files(tree, [fake.KEY]).items():
        (tmp_path / name).write_text(text)
    (tmp_path / "report.tex").write_text(DOCUMENT)
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "report.tex"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout[-2000:]
    assert "Undefined control" not in result.stdout
    (tmp_path / "report.tex").write_text(
        DOCUMENT.replace(r"\RCverdict{fake2020/eq55-11}", r"\RCverdict{fake2020/eq99}")
    )
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode != 0
    assert "no claim or paper fake2020/eq99" in result.stdout


def test_bibliography_is_valid(tree: Path) -> None:
    library = bibtexparser.parse_string(latex.files(tree, [fake.KEY])["papers.bib"])
    assert library.failed_blocks == []
    assert library.entries[0].fields_dict["doi"].value == "10.1000/fake"
