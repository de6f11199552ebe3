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
