"""Experiments: attitude runs (Figs 4-7), one orbit, random gains (Figs 8, 9), constant random gains, integrators."""

from .random_gains import constant_gains, draws
from .runs import attitude, integrators, orbit

__all__ = ["attitude", "constant_gains", "draws", "integrators", "orbit"]
