"""A small paper with proofs, and a certificate of each kind."""

from __future__ import annotations

import pytest
from proven import CONDITIONS, CONTEXT, PAPER, boxed

from recontrol.exact import rational
from recontrol.lmi.conditions import minimise
from recontrol.lmi.enclosure import enclose
from recontrol.lmi.loops import entry_box, prove_box_stable
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import prove_feasible, prove_infeasible, prove_member
from recontrol.lmi.variables import scalar, symmetric


@pytest.fixture(scope="session")
def root(tmp_path_factory):
    folder = tmp_path_factory.mktemp("project")
    paper = folder / "papers" / "proven2024"
    paper.mkdir(parents=True)
    (paper / "paper.yaml").write_text(PAPER)
    (paper / "conditions.py").write_text(CONDITIONS)
    return folder


@pytest.fixture(scope="session")
def conditions(root):
    from recontrol.lmi.rebuild import _importable, locate

    names = ("definite", "lyapunov", "bounded_real", "squared_gain")
    with _importable(root):
        return {name: locate(f"papers.proven2024.conditions:{name}", "proven2024") for name in names}


@pytest.fixture(scope="session")
def data(root):
    from recontrol.paper import load

    found = load(root / "papers" / "proven2024").data
    return {name: found[name] for name in "ABC"}


@pytest.fixture(scope="session")
def made(conditions, data, root):
    """One certificate of each kind, by statement."""
    c = conditions
    stable = Problem("stable", {"P": symmetric(2)}, [c["definite"], c["lyapunov"]], {"A": data["A"]}, **CONTEXT)
    flipped = {**CONTEXT, "case": "flipped"}
    unstable = Problem("unstable", {"P": symmetric(2)}, [c["definite"], c["lyapunov"]], {"A": -data["A"]}, **flipped)
    unknowns = {"P": symmetric(2), "gamma2": scalar()}
    gain = Problem("gain", unknowns, [c["definite"], c["bounded_real"]], data, minimise(c["squared_gain"]), **CONTEXT)
    proven = enclose(gain)
    inside, outside = (boxed(c, data, root, case) for case in ("plain", "flipped"))
    return {
        "definite": prove_feasible(stable, stable.solve()),
        "infeasible": prove_infeasible(unstable),
        "upper": proven.upper_certificate,
        "lower": proven.lower_certificate,
        "membership": prove_member(inside),
        "exclusion": prove_member(outside),
        "box": prove_box_stable(data["A"], *entry_box(rational.matrix("0 0\n1 1"))),
    }
