"""Figures of hashim2015: each function returns the drawing and the curves in it."""

from .comparisons import readings, regulator, sweep
from .frequency import ltr, pitch
from .published import ace, poles, real_output
from .responses import fig3, fig4, fig5

__all__ = ["ace", "fig3", "fig4", "fig5", "ltr", "pitch", "poles", "readings", "real_output", "regulator", "sweep"]
