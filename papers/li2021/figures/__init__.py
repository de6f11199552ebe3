"""The paper's figures redrawn, and those that show the findings."""

from .findings import certified_drift, draws, gamma_lambda, lemma_region, responses
from .poles import fig3
from .runs import fig4, fig5, fig6, fig7, fig8, fig9

__all__ = [
    "certified_drift",
    "draws",
    "fig3",
    "fig4",
    "fig5",
    "fig6",
    "fig7",
    "fig8",
    "fig9",
    "gamma_lambda",
    "lemma_region",
    "responses",
]
