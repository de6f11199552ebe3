"""Experiments of hashim2015, one part each; see the module of a part for what its artifact holds."""

from .limits import limits
from .pitch import pitch
from .published import published
from .recovery import recovery
from .regulator import regulator
from .robustness import robustness
from .steps import steps
from .sweep import sweep

__all__ = ["limits", "pitch", "published", "recovery", "regulator", "robustness", "steps", "sweep"]
