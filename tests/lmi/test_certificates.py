"""Certificate files: what a reader can check, and every way to tamper with one that must not work."""

import copy
import json
from pathlib import Path

import pytest

from recontrol.exact import ball, rational
from recontrol.lmi import verify
from recontrol.lmi.certificate import decode, encode

KINDS = ("definite", "infeasible", "upper", "lower")


@pytest.mark.parametrize("kind", KINDS)
def test_certificates_hold_alone_and_against_the_paper(made, root, tmp_path, kind):
    alone = verify.check(made[kind], tmp_path)
    assert alone.holds
    assert "arithmetic alone" in alone.why
    rebuilt = verify.check(made[kind], root)
    assert rebuilt.holds, rebuilt.why
    assert "rebuilt from papers/proven2024" in rebuilt.why
    assert rebuilt.strength == "exact"


@pytest.mark.parametrize("kind", KINDS)
def test_a_changed_file_is_refused_by_its_digest(made, root, kind):
    altered = copy.deepcopy(made[kind])
    altered["says"] = "something else"
    found = verify.check(altered, root)
    assert not found.holds
    assert "digest" in found.why


def test_certificates_survive_their_file(made):
    for certificate in made.values():
        assert verify.check(json.loads(json.dumps(certificate, indent=1))).holds


def test_balls_are_stored_outwards():
    x = ball.ball("0.1", "0.05")
    again = decode(encode(x))
    assert again.contains(x)
    M = ball.box(rational.matrix("1 2"), rational.matrix("0.5 0"))
    assert all(b.contains(a) for a, b in zip(M.flat, decode(encode(M)).flat, strict=True))


def test_the_verifier_stands_alone(made, tmp_path):
    """It imports nothing of this project: run it with the one file and python-flint."""
    import subprocess
    import sys

    source = Path(verify.__file__).read_text(encoding="utf-8")
    (tmp_path / "verifier.py").write_text(source)
    for kind, certificate in made.items():
        (tmp_path / f"{kind}.json").write_text(json.dumps(certificate))
    command = [sys.executable, "-I", "verifier.py", *(f"{kind}.json" for kind in made)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("holds, exact") == len(made)


def test_command_line_says_what_it_found(made, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("good.json").write_text(json.dumps(made["upper"]))
    Path("bad.json").write_text(json.dumps({**made["upper"], "says": "x"}))
    Path("list.json").write_text("[]")
    assert verify.main(["good.json"]) == 0
    assert verify.main(["good.json", "bad.json"]) == 1
    assert "bad.json: REFUSED" in capsys.readouterr().out
    assert verify.main(["list.json"]) == 2
    assert verify.main(["absent.json"]) == 2
    assert verify.main([]) == 2
