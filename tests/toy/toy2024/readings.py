"""The findings."""

import numpy as np
from flint import fmpq

from recontrol.claims.values import Approx, Statement


def gain(synthesis):
    return synthesis["gain"]["k"]


def matrix():
    third = fmpq(1, 3)
    return np.array([[fmpq(1), third], [third, fmpq(2)]], dtype=object)


def stable(model, synthesis, case):
    factor = {"slow": 1, "fast": 2}[case]
    return Statement({"decay rate": synthesis["gain"]["k"] - factor * model["a"]})


def decayed(simulation):
    return Statement({"room": Approx(0.01 - float(simulation["decay"]["series"]["x"][-1]), 1e-12)})
