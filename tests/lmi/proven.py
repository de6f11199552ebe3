"""A small paper with proofs: its two files, and a question about a printed matrix."""

from recontrol.lmi.conditions import condition
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import symmetric

CONTEXT = {"paper": "proven2024", "case": "plain", "source": "papers.proven2024.conditions:problem_data"}

CONDITIONS = """
from flint import fmpq
from recontrol.lmi.blocks import block, eye, he, negative, positive

@positive
def definite(P):
    return P

@negative
def lyapunov(P, A):
    return he(P @ A)

@negative
def bounded_real(P, gamma2, A, B, C):
    return block([[he(P @ A) + C.T @ C, P @ B], [-gamma2 * eye(1)]])

def squared_gain(gamma2):
    return gamma2

def problem_data(data, case):
    sign = -1 if case == "flipped" else 1
    return {"A": sign * data["A"], "B": data["B"], "C": data["C"], "K": data.ball("K")}
"""

PAPER = """
key: proven2024
title: A paper with a proof
authors: [A. Author]
year: 2024
venue: Nowhere
doi: ""
bibtex: {type: article, key: proven2024}
about: a test
use: for tests only
data:
  A: {printed: "0 1\\n-2 -3", unit: "1", where: "(1)", what: state matrix, exact: true}
  B: {printed: "0\\n1", unit: "1", where: "(1)", what: input matrix, exact: true}
  C: {printed: "1 0", unit: "1", where: "(1)", what: output matrix, exact: true}
  K: {printed: "0.25", unit: "1", where: "(2)", what: a printed gain}
  S: {printed: "1.25 0.25\\n0.25 0.25", unit: "1", where: "(3)", what: a printed Lyapunov matrix}
cases:
  plain: {what: as printed}
  flipped: {what: with the sign of A turned}
"""


def boxed(c, data, root, case):
    """Is a member of the printed S a Lyapunov matrix?"""
    from recontrol.paper import load

    given = load(root / "papers" / "proven2024").data
    named = [condition(c[name], rename={"P": "S"}) for name in ("definite", "lyapunov")]
    box = {"S": (given["S"] - given.half("S"), given["S"] + given.half("S"))}
    A = data["A"] if case == "plain" else -data["A"]
    return Problem("member", {"S": symmetric(2)}, named, {"A": A}, boxes=box, **{**CONTEXT, "case": case})
