"""The command line: what it prints, its exit codes, and that looking around loads no numerical library."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "report"))

import fake
import test_papers

from recontrol import cli, contract
from recontrol.errors import PaperError


@pytest.fixture
def run(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """Run a command in a tree that holds the made-up paper; returns (exit code, output, errors)."""
    fake.write(tmp_path)

    def command(*arguments: str) -> tuple[int, str, str]:
        code = cli.main(["-C", str(tmp_path), *arguments])
        return (code, *capsys.readouterr())

    return command


def test_list_counts_the_verdicts(run) -> None:
    code, out, _ = run("list")
    assert code == 0
    assert "10 claims" in out
    assert "2 erratum, 1 erratum (may be the scan's)" in out


def test_show_gives_advice_and_every_claim(run) -> None:
    code, out, _ = run("show", fake.KEY)
    assert code == 0
    assert "May I use it? The gain may be used." in out
    assert "erratum*" in out
    assert sum(line.startswith(("eq", "s2", "s3", "fig")) for line in out.splitlines()) == 10


@pytest.mark.parametrize("identity", ["fake2020/eq55-11", "fake2020/claims/eq55-11"])
def test_explain_names_the_rule_and_the_distances(run, identity: str) -> None:
    code, out, _ = run("explain", identity)
    assert code == 0
    assert "rule 5" in out
    assert "last-place units off, 0 of 4 digits agree" in out
    assert "A - 2BK   explanation: agrees" in out
    assert f"at papers/{fake.KEY}/readings/loops.py:4" in out


def test_explain_shows_the_cells_that_the_claim_is_about(run) -> None:
    out = run("explain", "fake2020/eq65-2")[1]
    (printed,) = [line.split()[1:] for line in out.splitlines() if line.startswith("printed")]
    assert printed[2] == "0.5147"
    assert set(printed) == {".", "0.5147"}


def test_explain_shows_cases_proofs_and_failures(run) -> None:
    assert "case roll: differs, margin = -0.25" in run("explain", "fake2020/s3-pattern")[1]
    assert "recontrol verify results/fake2020/certificates/loop-full.json" in run("explain", "fake2020/eq44-K")[1]
    assert "SolverError" in run("explain", "fake2020/s2-broken")[1]
    absent = run("explain", "fake2020/s2-absent")[1]
    assert "No reading has run" in absent
    assert "absent in papers/fake2020/readings/proofs.py" in absent


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["show", "nobody1999"], "papers: fake2020"),
        (["explain", "fake2020/eq5"], "near it: eq53-poles"),
        (["explain", "fake2020"], "names no claim"),
        (["check", "nobody1999"], "no such paper folder"),
        (["new", "Smith"], "such as smith2024"),
        (["new", fake.KEY], "exists already"),
    ],
)
def test_errors_are_one_clear_line(run, arguments: list[str], said: str) -> None:
    code, out, err = run(*arguments)
    assert code == 1
    assert out == ""
    assert said in err
    assert len(err.splitlines()) == 1


def test_outside_a_project_says_where_to_go(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["-C", str(tmp_path), "list"]) == 1
    assert "give -C DIR" in capsys.readouterr().err


def test_looking_around_loads_no_numerical_library(tmp_path: Path) -> None:
    fake.write(tmp_path)
    heavy = "numpy flint scipy cvxpy pydantic matplotlib"
    script = (
        "import sys; from recontrol import cli; "
        f"cli.main(['-C', {str(tmp_path)!r}, 'list']); cli.main(['-C', {str(tmp_path)!r}, 'show', 'fake2020']); "
        f"sys.exit(' '.join(set({heavy!r}.split()) & set(sys.modules)) or 0)"
    )
    source = Path(cli.__file__).parents[1]
    environment = {**os.environ, "PYTHONPATH": str(source)}
    command = [sys.executable, "-c", script]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr


def test_a_new_folder_passes_the_contract_and_says_what_to_fill_in(run, tmp_path: Path) -> None:
    code, out, _ = run("new", "smith2024")
    assert code == 0
    assert "FILL IN" in out
    assert run("check", "smith2024")[0] == 0
    folder = tmp_path / "papers" / "smith2024"
    assert "smith2024" in (folder / "paper.yaml").read_text()
    assert not [path for path in folder.rglob("*") if path.is_file() and "KEY" in path.read_text()]
    for name, contract_test in vars(test_papers).items():
        if name.startswith("test_"):
            contract_test(folder)


@pytest.mark.parametrize(
    ("file", "old", "new", "said"),
    [
        ("readings.py", "def stable", "def steady", "has no function stable"),
        ("readings.py", "def gain(synthesis)", "def gain(synthesized)", "argument 'synthesized' of gain is unknown"),
        ("synthesis.py", "def gain(data, model)", "def gain(data, simulation)", "argument 'simulation' of gain"),
        ("figures.py", "def decay", "def response", "figures.decay asks for it"),
        ("model.py", "def model(data):", "def model(data:", "model.py:4"),
        ("paper.yaml", "unit: 1/s, where: \"(2)\"", "units: 1/s, where: \"(2)\"", "data.pole"),
        ("paper.yaml", "what: published gain}", "what: published gain, as printed}", "quote it"),
        ("claims.yaml", "note: plants", "note: planets", "planets"),
        ("claims.yaml", "data: k", "data: kk", "kk"),
        ("claims.yaml", "readings:\n    - {name: pole placement, kind: definition, function: gain}", "readings: []",
         "at least one reading"),
        ("claims.yaml", "missing: [a noise model, a criterion]", "missing: []", "what the paper does not give"),
        ("claims.yaml", "expected: {verdict: reproduced}", "expected: {verdict: fine}", "verdict"),
        ("NOTES.md", "## plants", "# plants", "note 'plants' has no heading"),
    ],
)  # fmt: skip
def test_check_names_what_is_wrong(run, tmp_path: Path, file: str, old: str, new: str, said: str) -> None:
    run("new", "smith2024")
    path = tmp_path / "papers" / "smith2024" / file
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))
    code, _, err = run("check", "smith2024")
    assert code == 1
    assert said in err
    assert file.removesuffix(".py") in err


@pytest.mark.parametrize("name", ["paper.yaml", "claims.yaml", "NOTES.md", "model.py", "readings.py"])
def test_check_asks_for_missing_files(run, tmp_path: Path, name: str) -> None:
    run("new", "smith2024")
    (tmp_path / "papers" / "smith2024" / name).unlink()
    code, out, err = run("check", "smith2024")
    assert (code, out) == (1, "")
    assert name in err
    assert "Traceback" not in err


def test_check_asks_for_missing_stage_files(run, tmp_path: Path) -> None:
    run("new", "smith2024")
    folder = tmp_path / "papers" / "smith2024"
    (folder / "quantities.py").unlink()
    with pytest.raises(PaperError, match=r"quantities\.py: missing"):
        contract.check(folder)


def test_functions_of_a_package_are_found_by_topic(run, tmp_path: Path) -> None:
    run("new", "smith2024")
    folder = tmp_path / "papers" / "smith2024"
    (folder / "readings").mkdir()
    (folder / "readings.py").rename(folder / "readings" / "loop.py")
    (folder / "readings" / "__init__.py").write_text("from .loop import gain\n")
    claims = folder / "claims.yaml"
    claims.write_text(claims.read_text().replace("function: stable", "function: loop.stable"))
    assert contract.check(folder) == 3
