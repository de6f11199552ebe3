"""Gains of the recipe, the recipes that were rejected, and how sharply the print identifies the weights."""

from .gains import gains
from .identifiability import identifiability
from .rejected import rejected

__all__ = ["gains", "identifiability", "rejected"]
