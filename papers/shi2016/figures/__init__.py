"""Figures of shi2016: each function returns the drawing and the curves in it."""

from .findings import conservatism, floquet, hinf, pareto, resonance, rho_gamma, settling
from .runs import fig1, fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9, fig10, fig11, fig12

__all__ = [
    "conservatism",
    "fig1",
    "fig2",
    "fig3",
    "fig4",
    "fig5",
    "fig6",
    "fig7",
    "fig8",
    "fig9",
    "fig10",
    "fig11",
    "fig12",
    "floquet",
    "hinf",
    "pareto",
    "resonance",
    "rho_gamma",
    "settling",
]
