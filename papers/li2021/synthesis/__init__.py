"""Designs and analyses; each part is one job."""

from .analysis import analysis
from .nominal import early_stop, nominal
from .printed import printed
from .robustness import scaled, vertices
from .steps import state_feedback, torque, two_step

__all__ = [
    "analysis",
    "early_stop",
    "nominal",
    "printed",
    "scaled",
    "state_feedback",
    "torque",
    "two_step",
    "vertices",
]
