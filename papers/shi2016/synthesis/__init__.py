"""Parts of the synthesis stage; paper.yaml names them."""

from .analysis import floquet, norms
from .designs import dilated, h2_effort, nonfragile, single
from .solvers import solvers
from .values import fixed_gain, vanishing

__all__ = [
    "dilated",
    "fixed_gain",
    "floquet",
    "h2_effort",
    "nonfragile",
    "norms",
    "single",
    "solvers",
    "vanishing",
]
