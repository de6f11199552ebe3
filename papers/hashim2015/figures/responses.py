"""Figures 3 to 5 redrawn: the step response of one axis under three readings of where the reference enters."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

from .style import DESIGNS, Curves, as_curve, finite

PANELS = {"S": ("full", "corrected"), "B": ("full", "corrected", "x1"), "C": ("full", "corrected", "x1")}
TITLES = {
    "S": "S: reference added to $u$, known to the estimator",
    "B": "B: reference added to $u$ only",
    "C": "C: reference subtracted from the measurement",
}
BAND = 0.02


def fig3(simulation: Any) -> tuple[Any, Curves]:
    """Yaw."""
    return responses(simulation["steps"], "yaw")


def fig4(simulation: Any) -> tuple[Any, Curves]:
    """Pitch; beyond 3 the scale of B and C is logarithmic, where the x1 design runs far out."""
    return responses(simulation["steps"], "pitch-tf", logarithmic_beyond=3.0)


def fig5(simulation: Any) -> tuple[Any, Curves]:
    """Roll."""
    return responses(simulation["steps"], "roll")


def responses(steps: Any, axis: str, logarithmic_beyond: float | None = None) -> tuple[Any, Curves]:
    """Three stacked panels S, B, C of one axis, with the curves drawn."""
    fig, axes = plotting.subplots(3, 1, height=128, sharex=True)
    curves: Curves = {}
    for ax, (entry, names) in zip(axes, PANELS.items(), strict=True):
        for name in names:
            words, series = DESIGNS[name]
            t, y = as_curve(steps["series"][f"{axis}/t"], steps["series"][f"{axis}/{name}-{entry}"])
            found = steps["values"]["metrics"][axis][f"{name}-{entry}"]
            ax.plot(t, y, label=words, **series.line)
            curves[f"{entry}: {name}"] = (t, y)
            settled = _settling(ax, t, y, found, series)
            if settled is not None:
                curves[f"{entry}: {name}, settling"] = settled
        if logarithmic_beyond is not None and entry != "S":
            _far_scale(ax, logarithmic_beyond)
        plotting.label_axes(ax, y=("output $y$", "1"))
    plotting.letter_panels(axes, [TITLES[entry] for entry in PANELS])
    plotting.label_axes(axes[-1], x=("time", "s"))
    axes[-1].set_xlim(float(t[0]), float(t[-1]))
    axes[-1].locator_params(axis="x", nbins=6, integer=True)
    fig.align_ylabels(axes)
    _legend(fig, axes)
    return fig, curves


def _settling(ax: Any, t: np.ndarray, y: np.ndarray, found: dict[str, Any], series: plotting.Series) -> Any:
    """Draw the 2 % band and the settling mark of one response; the mark as a one-point curve."""
    final, time = finite(found["final"]), finite(found["settling"]["2"])
    if final is None or time is None or time > t[-1]:
        return None
    low, high = sorted((final * (1 - BAND), final * (1 + BAND)))
    ax.axhspan(low, high, facecolor=series.color, alpha=0.2, edgecolor="none", zorder=0.6)
    level = float(np.interp(time, t, y))
    # The mark of the full order is larger: where two responses coincide, both marks are seen.
    ax.plot([time], [level], zorder=4, **(series.points | {"markersize": 6.5 if series.marker == "o" else 4.4}))
    return as_curve(time, level)


def _far_scale(ax: Any, limit: float) -> None:
    """Linear within +-limit, logarithmic beyond; a dotted line where the scale changes."""
    lowest, highest = float(ax.dataLim.y0), float(ax.dataLim.y1)
    ax.set_yscale("symlog", linthresh=limit, linscale=1.8)
    ticks = {-100: "−100", -10: "−10", -limit: "−3", 0: "0", 1: "1", 2: "2", limit: "3", 10: "10", 50: "50"}
    shown = [level for level in ticks if lowest <= level <= max(highest, limit)]
    ax.set_yticks(shown, [ticks[level] for level in shown])
    ax.minorticks_off()
    for level in (-limit, limit) if lowest < -limit else (limit,):
        ax.axhline(level, color=plotting.GREY, linewidth=0.6, linestyle=(0, (1, 2)), zorder=1)
    if lowest > -limit:
        ax.set_ylim(bottom=min(-0.5, lowest))


def _legend(fig: Any, axes: Any) -> None:
    """Designs, then what shade and mark mean."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles, words = axes[1].get_legend_handles_labels()
    handles += [
        Patch(facecolor=plotting.PALE, edgecolor="none", alpha=0.6),
        Line2D([], [], color=plotting.GREY, marker="o", linestyle="none", markersize=4.6, markeredgecolor="white"),
    ]
    words += ["2 % about the final value", "settling in that band"]
    fig.legend(handles, words, loc="outside lower center", ncols=2)
