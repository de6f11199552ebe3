"""Experiments, one part each: the linear loop, the nonlinear one, the functional along it, and gains of d_bar -> z."""

from .functional import functional
from .gains import gains
from .loops import loops
from .nonlinear import nonlinear

__all__ = ["functional", "gains", "loops", "nonlinear"]
