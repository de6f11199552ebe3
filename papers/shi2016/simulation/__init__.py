"""Parts of the simulation stage; paper.yaml names them."""

from .linear import linear
from .nonlinear import nonlinear

__all__ = ["linear", "nonlinear"]
