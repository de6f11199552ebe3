"""Proofs on the loop, for the printed and for the mended controller."""

from recontrol.lmi import loops

from .conditions import problem_data

ORIGIN = {"paper": "made2024", "source": "papers.made2024.conditions:problem_data"}


def loop(data):
    """The loop with the mended controller is stable."""
    case = "A_k_mended"
    return loops.prove_stable(problem_data(data, case)["M"], says="the mended loop is stable", case=case, **ORIGIN)


def unstable(data):
    """The loop with the printed controller is unstable."""
    case = "A_k"
    return loops.prove_unstable(problem_data(data, case)["M"], says="the printed loop is unstable", case=case, **ORIGIN)
