"""What solving, proving and verifying cost against the size of a problem: `python -m recontrol.lmi.bench`.

The problem is the bounded-real lemma of a random stable system with n states, two inputs and two outputs: unknowns P
and gamma^2. Proving is `enclose`: both bounds of the optimum, with everything it solves on the way. Times are CPU
seconds of this process and its children; ratios are what carries over to another machine.
"""

from __future__ import annotations

import argparse
import json
import resource
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from recontrol.exact import rational
from recontrol.lmi import verify
from recontrol.lmi.blocks import block, eye, he, negative, positive
from recontrol.lmi.conditions import minimise
from recontrol.lmi.duality import NotProvenError
from recontrol.lmi.enclosure import bound_by_point, enclose
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import scalar, symmetric

SIZES = (3, 6, 12, 18, 24)
LARGE = 60
LIMIT = 120.0
"""Time limit of each solve [s], stated in the page."""
BEGIN, END = "<!-- cost: begin -->", "<!-- cost: end -->"
COLUMNS = ("states", "order", "unknowns", "solve", "prove", "verify", "prove / solve", "verify / solve", "kB", "width")


@positive
def positive_P(P: Any) -> Any:
    """P > 0."""
    return P


@negative
def bounded_real(P: Any, gamma2: Any, A: Any, B: Any, C: Any) -> Any:
    """[A'P + PA + C'C, PB; B'P, -gamma2 I] < 0."""
    return block([[he(P @ A) + C.T @ C, P @ B], [-gamma2 * eye(B.shape[1])]])


def squared_gain(gamma2: Any) -> Any:
    """gamma2."""
    return gamma2


def random_problem(n: int) -> Problem:
    """The bounded-real lemma of (J - R, B, C) with J skew and R > 0, entries to three decimals, seed n."""
    rng = np.random.default_rng(n)
    J, R = rng.standard_normal((n, n)), rng.standard_normal((n, n))
    A = rational.rounded((J - J.T) / 2 - R @ R.T / n - 0.5 * np.eye(n), 3)
    data = {
        "A": A,
        "B": rational.rounded(rng.standard_normal((n, 2)), 3),
        "C": rational.rounded(rng.standard_normal((2, n)), 3),
    }
    unknowns = {"P": symmetric(n), "gamma2": scalar()}
    return Problem(f"gain of {n} states", unknowns, [positive_P, bounded_real], data, minimise(squared_gain))


def _cpu() -> float:
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in usages)


@dataclass(frozen=True)
class Cost:
    """Counts and CPU seconds for one size; ``width`` is the relative width of the enclosure, None if unproven."""

    states: int
    order: int
    unknowns: int
    solve: float
    prove: float
    verify: float
    kilobytes: float
    width: float | None

    def row(self) -> list[str]:
        """The row of the table."""
        ratios = [f"{self.prove / self.solve:.1f}", f"{self.verify / self.solve:.2f}"]
        times = [f"{t:.2g}" for t in (self.solve, self.prove, self.verify)]
        width = "not proven" if self.width is None else f"{self.width:.0e}"
        counts = [str(self.states), str(self.order), str(self.unknowns)]
        return [*counts, *times, *ratios, f"{self.kilobytes:.0f}", width]


def measure(n: int, limit: float = LIMIT) -> Cost:
    """Cost of one size."""
    problem = random_problem(n)
    started = _cpu()
    problem.solve(time_limit=limit)
    solved = _cpu()
    certificates: list[dict[str, Any]] = []
    width = None
    try:
        found = enclose(problem, time_limit=limit)
        certificates, width = [found.lower_certificate, found.upper_certificate], found.relative_width
    except NotProvenError:
        pass
    proven = _cpu()
    if not all(verify.check(c).holds for c in certificates):
        raise AssertionError("a certificate that was just made does not verify")
    verified = _cpu()
    size = sum(len(json.dumps(c)) for c in certificates) / 1000
    times = (solved - started, proven - solved, verified - proven)
    return Cost(n, n + 2, problem.size, *times, size, width)


def large(n: int = LARGE, limit: float = LIMIT) -> str:
    """One sentence on a size that is too large for a routine solve: a Riccati point, proven and verified."""
    import scipy.linalg

    problem = random_problem(n)
    A, B, C = (problem.float_data[name] for name in "ABC")
    started = _cpu()
    words = problem.solve(time_limit=limit).words
    solved = _cpu()
    sweep = (C @ np.linalg.solve(1j * w * np.eye(n) - A, B) for w in np.linspace(0, 20, 400))
    gamma2 = 1.21 * max(np.linalg.norm(G, 2) for G in sweep) ** 2
    P = scipy.linalg.solve_continuous_are(A, B, C.T @ C + 1e-6 * np.eye(n), -gamma2 * np.eye(B.shape[1]))
    before = _cpu()
    certificate = bound_by_point(problem, {"P": P, "gamma2": gamma2 * (1 + 1e-9)})[1]
    proven = _cpu()
    holds = verify.check(certificate).holds
    checked = _cpu() - proven
    size = len(json.dumps(certificate)) / 1000
    return (
        f"With {n} states ({problem.size} unknowns) and a limit of {limit:g} s for the solve: {words} "
        f"({solved - started:.0f} s of CPU). A point from a Riccati equation was proven feasible in "
        f"{proven - before:.2f} s and verified in {checked:.2f} s ({'holds' if holds else 'REFUSED'}, {size:.0f} kB)."
    )


def table(costs: list[Cost]) -> str:
    """The table in Markdown."""
    rows = [list(COLUMNS), ["---:"] * len(COLUMNS), *(c.row() for c in costs)]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def plot(costs: list[Cost], path: Path) -> None:
    """CPU seconds against the number of states, log-log, as SVG."""
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    with plt.rc_context({"svg.hashsalt": "recontrol", "font.size": 8}):
        figure, axes = plt.subplots(figsize=(3.46, 2.4), layout="constrained")
        lines = (("solve", "o-"), ("prove", "s--"), ("verify", "^:"))
        for (name, style), colour in zip(lines, ("#0072B2", "#D55E00", "#000000"), strict=True):
            axes.loglog([c.states for c in costs], [getattr(c, name) for c in costs], style, color=colour, label=name)
        axes.set_xlabel("number of states")
        axes.set_ylabel("CPU time in s")
        axes.set_xticks([c.states for c in costs], [str(c.states) for c in costs])
        axes.minorticks_off()
        axes.legend(frameon=False)
        figure.savefig(path, metadata={"Date": None})
        plt.close(figure)


def main(argv: list[str] | None = None) -> int:
    """Measure, and write the table and the plot into docs/ if asked."""
    parser = argparse.ArgumentParser(prog="python -m recontrol.lmi.bench", description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[*SIZES], help="numbers of states")
    parser.add_argument("--large", action="store_true", help=f"also one sentence on {LARGE} states")
    parser.add_argument("--limit", type=float, default=LIMIT, help="time limit of each solve in s")
    parser.add_argument("--write", type=Path, metavar="DOCS", help="folder of lmi.md, to put table and plot in")
    options = parser.parse_args(argv)
    random_problem(2).solve()
    enclose(random_problem(2))
    costs = [measure(n, options.limit) for n in options.sizes]
    text = table(costs) + (f"\n\n{large(limit=options.limit)}" if options.large else "")
    print(text)
    if options.write:
        page = options.write / "lmi.md"
        before, rest = page.read_text(encoding="utf-8").split(BEGIN)
        page.write_text(f"{before}{BEGIN}\n{text}\n{END}{rest.split(END)[1]}", encoding="utf-8")
        plot(costs, options.write / "lmi-cost.svg")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
