"""Solvers that crash, hang, lie, panic or take their stage along: messages, failed verdicts, and recovery."""

from __future__ import annotations

import json

import pytest
from projects import Project

SYNTHESIS = '''"""Gains, each with a proof that its loop is stable, by the solver of its name."""

import os
import time

from flint import fmpq

from .helper import FACTOR

FAULTY = False


def proven(model, fault, seconds=60.0):
    import numpy as np

    from recontrol.lmi import loops
    from recontrol.lmi.problem import Problem
    from recontrol.lmi.proof import prove_feasible
    from recontrol.lmi.solvers import Profile
    from recontrol.lmi.variables import symmetric

    k = fmpq(FACTOR, 2) * model["a"]
    data = {"M": np.array([[model["a"] - k]], dtype=object), "weight": np.array([[fmpq(2)]], dtype=object)}
    problem = Problem("loop", {"P": symmetric(1)}, [loops.definite, loops.hurwitz, loops.bounded], data)
    solver, limit = "CLARABEL", 60.0
    if FAULTY:
        solver, limit = Profile("faulty", "faulty", "none", "interior point", run=fault), seconds
    certificate = prove_feasible(problem, problem.solve(solver, margin="0.1", time_limit=limit))
    return {"k": k, "P": certificate["witness"]["point"]["P"][0][0]}


def gain(model):
    return {"k": fmpq(FACTOR, 2) * model["a"]}


def other(model):
    return {"twice": 2 * model["a"]}


def crash(model):
    return proven(model, lambda problem: os._exit(11))


def hang(model):
    return proven(model, lambda problem: time.sleep(600), seconds=1.0)


def lie(model):
    def wrong(problem):
        problem.solve(solver="CLARABEL")
        problem.variables()[0].value = -problem.variables()[0].value

    return proven(model, wrong)


def lose(model):
    def not_finite(problem):
        problem.solve(solver="CLARABEL")
        problem.variables()[0].value[:] = float("nan")

    return proven(model, not_finite)


class Panic(BaseException):
    pass


def panic(model):
    def broken(problem):
        raise Panic("index out of bounds")

    return proven(model, broken)


def vanish(model):
    if FAULTY:
        os.kill(os.getpid(), 9)
    return proven(model, None)
'''

FAULTS = {
    "crash": "crashed: the solver's process ended with code 11",
    "hang": "out of time: stopped after 1 s",
    "lie": "violated",
    "lose": "not finite",
    "panic": "error: Panic: index out of bounds",
    "vanish": "",
}
"""Part of the synthesis -> what its log says; a stage that is killed from outside says nothing itself."""
CLAIM = """
- id: gain-{name}
  where: "(2)"
  title: the gain that the solver called {name} finds
  compare: digits
  data: k
  readings:
    - {{name: found, kind: definition, function: {name}}}
  expected: {{verdict: reproduced}}
  because: The gain is five halves of the pole.
"""


@pytest.fixture
def solved(fresh_toy) -> Project:
    """The toy with one solver a part in its synthesis, built."""
    project = fresh_toy("solved")
    folder = project.folder / "papers/toy2024"
    (folder / "synthesis.py").write_text(SYNTHESIS)
    parts = ", ".join(f"{name}: solver that may {name}" for name in FAULTS)
    project.edit("papers/toy2024/paper.yaml", "other: a second part}", f"other: a second part, {parts}}}")
    with (folder / "claims.yaml").open("a") as claims, (folder / "readings.py").open("a") as readings:
        for name in FAULTS:
            claims.write(CLAIM.format(name=name))
            readings.write(f'\n\ndef {name}(synthesis):\n    return synthesis["{name}"]["k"]\n')
    project.snakemake("toy2024")
    return project


def test_faulty_solvers_fail_their_stages_in_words(solved, record_property):
    """A solver that crashes, hangs, says "optimal" of a wrong or a non-finite point, panics, or kills its stage"""
    record_property("cases", len(FAULTS))
    clean = solved.artifacts()
    solved.edit("papers/toy2024/synthesis.py", "FAULTY = False", "FAULTY = True")
    result = solved.snakemake("toy2024", check=False)
    assert result.returncode != 0
    for name, words in FAULTS.items():
        log = f"run/log/toy2024/synthesis/{name}.log"
        assert log in result.stdout
        said = (solved.folder / log).read_text()
        assert words in said
        assert words in result.stdout
        assert "Traceback" not in said
    content = json.loads((solved.folder / "results/toy2024/verdicts.json").read_text())
    found = {claim["id"]: claim["verdict"] for claim in content["claims"]}
    assert {found[f"gain-{name}"] for name in FAULTS} == {"failed"}
    assert found["eq2-k"] == "reproduced"
    solved.edit("papers/toy2024/synthesis.py", "FAULTY = True", "FAULTY = False")
    solved.snakemake("toy2024")
    recovered = solved.artifacts()
    assert {name: recovered.get(name) for name in clean} == clean
