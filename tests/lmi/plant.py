"""The plant of the proofs, and what they ask of a certificate."""

from inequalities import bounded_real, lyapunov, positive_P, squared_gain

from recontrol.exact import rational
from recontrol.lmi import verify
from recontrol.lmi.conditions import minimise
from recontrol.lmi.problem import Problem
from recontrol.lmi.variables import scalar, symmetric

A, B, C = rational.matrix("0 1\n-2 -3"), rational.matrix("0\n1"), rational.matrix("1 0")
PLANT = {"A": A, "B": B, "C": C}


def holds(certificate, strength="exact"):
    found = verify.check(certificate)
    return found.holds and found.strength == strength


def lyapunov_problem(M, **boxes):
    return Problem("lyapunov", {"P": symmetric(M.shape[0])}, [positive_P, lyapunov], {"A": M}, boxes=boxes)


def gain():
    return Problem(
        "gain", {"P": symmetric(2), "gamma2": scalar()}, [positive_P, bounded_real], PLANT, minimise(squared_gain)
    )
