"""The gain."""

from flint import fmpq

from .helper import FACTOR


def gain(model):
    return {"k": fmpq(FACTOR, 2) * model["a"]}


def other(model):
    return {"twice": 2 * model["a"]}
