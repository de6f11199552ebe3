"""The benchmark refuses to time methods that disagree. Its ratios are shown in docs/performance.md, never tested."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest

from tests.conftest import ROOT

SPEC = importlib.util.spec_from_file_location("bench", ROOT / "tools/bench.py")
bench = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(bench)


def test_methods_agree_on_the_printed_loops():
    deviations = bench.agreement(*bench.printed_loops(4))
    assert set(deviations) == set(bench.OTHERS)


def test_disagreement_stops_the_benchmark(monkeypatch):
    wrong = lambda A, x0: bench.batched(1.001 * A, x0)  # noqa: E731
    monkeypatch.setitem(bench.OTHERS, "solve_ivp", wrong)
    with pytest.raises(SystemExit, match="solve_ivp deviates"):
        bench.agreement(*bench.printed_loops(3))


def test_exponent_of_a_power_law():
    assert bench.exponent({k: k**1.5 for k in (1, 2, 4, 8)}) == pytest.approx(1.5)


def test_random_loops_are_stable():
    A, x0 = bench.random_loops(20, 6)
    assert np.linalg.eigvals(A).real.max() == pytest.approx(-0.1)
    assert np.linalg.norm(x0, axis=1) == pytest.approx(np.ones(20))


def test_section_of_another_program_is_kept():
    section = "<!-- speed -->\n## How long\n\n| a | b |\n<!-- /speed -->"
    first = bench.with_kept("# new page\n", f"# old page\n\n{section}\n")
    assert first == f"# new page\n\n{section}\n"
    assert bench.with_kept("# new page\n", first) == first
    assert bench.with_kept("# new page\n", "# old page\n") == "# new page\n"


def test_the_motion_agrees_with_its_plain_loop():
    batch = bench.rendezvous(2)
    ours, theirs = bench.batched_motion(batch), bench.motion_loop(batch)
    assert ours.shape == theirs.shape == (2, 598, 12)
    assert np.abs(ours - theirs).max() < bench.MOTION_TOLERANCE * np.abs(theirs).max()


def test_a_ratio_below_the_required_one_fails(monkeypatch, capsys):
    rates = {"this project": 99.0, "solve_ivp": 1.0, "forced_response": 2.0}
    found = {
        "agreement": dict.fromkeys(bench.OTHERS, 1e-12),
        "rates": rates,
        "growth": {"states": {1: 1.0, 2: 2.0}},
        "motion": {"deviation": 1e-9, "ratio": 7.0, "runs": 5},
    }
    monkeypatch.setattr(bench, "measure", lambda quick: found)
    monkeypatch.setattr(bench.sys, "argv", ["bench.py"])
    with pytest.raises(SystemExit, match="only 99 times the plain solve_ivp loop, required 100"):
        bench.main()
    rates["this project"] = 101.0
    bench.main()
    assert "| solve_ivp | 1 | 101 |" in capsys.readouterr().out
