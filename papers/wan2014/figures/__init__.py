"""Figures of wan2014: the paper's, redrawn from the two-body motion, and the findings."""

from .findings import bounds, digits_n, fig4_zero, observer_blocks, poles, si_answers, z_freedom
from .published import fig2, fig3, fig4, fig5

__all__ = [
    "bounds",
    "digits_n",
    "fig2",
    "fig3",
    "fig4",
    "fig4_zero",
    "fig5",
    "observer_blocks",
    "poles",
    "si_answers",
    "z_freedom",
]
