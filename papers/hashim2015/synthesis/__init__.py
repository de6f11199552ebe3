"""Gains of the recipe, LQR by other routes, rejected recipes, and how sharply the print identifies the weights."""

from .gains import gains
from .identifiability import identifiability
from .lqr import lqr
from .rejected import rejected

__all__ = ["gains", "identifiability", "lqr", "rejected"]
