"""Experiments on the exact two-body motion and on the paper's linear model; each part returns (values, series)."""

from .linear import floquet, linear_cost
from .runs import drift, gains, main, routes
from .sweeps import ensemble, sweeps

__all__ = ["drift", "ensemble", "floquet", "gains", "linear_cost", "main", "routes", "sweeps"]
