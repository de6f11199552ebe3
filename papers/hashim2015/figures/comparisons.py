"""Figures that compare: settling under each reading, over the weight, and from random initial states."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

from .style import AXES, AXIS_SERIES, CORRECTED, FULL, X1, Curves, as_curve, finite

ROWS = (
    ("S", "full-S", "corrected-S"),
    ("B, $y$ measured", "full-B", "corrected-B"),
    ("B, $x_1$ measured", "full-B", "x1-B"),
    ("B, $x_1$ design, fed $y$", "full-B", "x1-fed-y-B"),
    ("C, $y$ measured", "full-C", "corrected-C"),
    ("C, $x_1$ measured", "full-C", "x1-C"),
    ("C, $x_1$ design, fed $y$", "full-C", "x1-fed-y-C"),
    ("D, $y$ measured", "full-D", "corrected-D"),
    ("D, $x_1$ measured", "full-D", "x1-D"),
)
# Time axis of each panel [s] and the place on it where the mark of a loop that never settles stands.
SCALES = {"yaw": ((12, 20, 40), 90.0), "pitch-tf": ((2, 5, 10), 30.0), "roll": ((5, 20, 80), 300.0)}


def readings(simulation: Any) -> tuple[Any, Curves]:
    """2 % settling times, one row per reading, one panel per axis."""
    metrics = simulation["steps"]["values"]["metrics"]
    fig, panels = plotting.subplots(1, 3, height=86, sharey=True)
    curves: Curves = {}
    heights = np.arange(len(ROWS), 0, -1)
    for ax, (axis, words) in zip(panels, AXES.items(), strict=True):
        ticks, never = SCALES[axis]
        times = np.array([[finite(metrics[axis][n]["settling"]["2"]) or never for n in names] for _, *names in ROWS])
        _rows(ax, heights, times)
        for k, name in enumerate(("full order", "reduced order")):
            curves[f"{words}: {name}"] = as_curve(times[:, k], heights)
        ax.set(xscale="log", xlim=(0.8 * ticks[0], 1.25 * never), ylim=(0.45, len(ROWS) + 0.55))
        ax.set_xticks([*ticks, never], [*map(str, ticks), "never"])
        ax.minorticks_off()
        ax.grid(False, axis="y")
        ax.tick_params(axis="y", length=0)
    panels[0].set_yticks(heights, [words for words, *_ in ROWS])
    plotting.letter_panels(panels, list(AXES.values()))
    plotting.label_axes(panels[1], x=("settling time, 2 % band", "s"))
    plotting.legend_below(fig, panels, columns=2)
    return fig, curves


def _rows(ax: Any, heights: np.ndarray, times: np.ndarray) -> None:
    """Full and reduced order of each row, joined; a shaded row says that the reduced order is faster."""
    faster = times[:, 1] < times[:, 0] - 1e-6
    label: str | None = "reduced order faster"
    for height, pair, shaded in zip(heights, times, faster, strict=True):
        if shaded:
            ax.axhspan(
                height - 0.42, height + 0.42, facecolor=plotting.FAINT, edgecolor="none", zorder=0.5, label=label
            )
            label = None
        ax.plot(pair, [height, height], color=plotting.GREY, linewidth=0.9, zorder=2)
    hollow = {"marker": FULL.marker, "markerfacecolor": "none", "markeredgecolor": FULL.color, "markeredgewidth": 1.1}
    ax.plot(times[:, 0], heights, label="full order", linestyle="none", markersize=6.2, zorder=4, **hollow)
    ax.plot(times[:, 1], heights, label="reduced order", zorder=3, **(CORRECTED.points | {"markersize": 4.2}))


def sweep(simulation: Any) -> tuple[Any, Curves]:
    """Settling time and overshoot of state feedback over q."""
    series = simulation["sweep"]["series"]
    q = series["q"]
    fig, panels = plotting.subplots(2, 1, height=92, sharex=True)
    curves: Curves = {}
    for ax, name, scale in ((panels[0], "settling", 1.0), (panels[1], "overshoot", 100.0)):
        for axis, words in AXES.items():
            y = series[f"{axis}/{name}"] * scale
            ax.plot(q, y, label=words, **AXIS_SERIES[axis].line)
            curves[f"{words}: {name}"] = as_curve(q, y)
            marked = [int(np.argmin(np.abs(np.log(q / at)))) for at in (1.0, 10.0)]
            ax.plot(q[marked], y[marked], clip_on=False, **AXIS_SERIES[axis].points)
        ax.set_xscale("log")
        ax.set_ylim(bottom=0)
        ax.axvline(1.0, color=plotting.GREY, linewidth=0.7, zorder=1)
    for at, words, side, shift in ((1.0, "gives the printed $K$", "left", 3), (10.0, "gives $L$", "right", -1)):
        panels[0].annotate(words, (at, 1.0), (shift, -1), xycoords=("data", "axes fraction"), ha=side, va="top",
                           textcoords="offset points", fontsize=6, color=plotting.GREY)  # fmt: skip
    fig.align_ylabels(panels)
    panels[1].set(
        xlim=(0.1, 10), xticks=[0.1, 0.2, 0.5, 1, 2, 5, 10], xticklabels=["0.1", "0.2", "0.5", "1", "2", "5", "10"]
    )
    panels[1].minorticks_off()
    plotting.label_axes(panels[0], y=("settling time, 2 % band", "s"))
    plotting.label_axes(panels[1], ("state weight $q$", "1"), ("overshoot", "%"))
    plotting.letter_panels(panels)
    plotting.legend_below(fig, panels[0], columns=3)
    return fig, curves


def regulator(simulation: Any) -> tuple[Any, Curves]:
    """Settling of every initial state: full order across, the two reduced designs up."""
    from matplotlib.ticker import MaxNLocator

    series = simulation["regulator"]["series"]
    fig, grid = plotting.subplots(2, 3, height=66)
    curves: Curves = {}
    for k, (axis, words) in enumerate(AXES.items()):
        full = series[f"{axis}/full"]
        highest = 1.08 * max(float(series[f"{axis}/{n}"].max()) for n in ("full", "corrected", "x1"))
        for ax, name, style in ((grid[0, k], "corrected", CORRECTED), (grid[1, k], "x1", X1)):
            ax.plot([0, highest], [0, highest], color=plotting.BLACK, linewidth=0.7, zorder=1)
            ax.plot(full, series[f"{axis}/{name}"],
                    **(style.points | {"markersize": 2.0, "markeredgewidth": 0.0, "alpha": 0.6}))  # fmt: skip
            ax.set(xlim=(0, highest), ylim=(0, highest))
            ax.set_box_aspect(1)
            for side in (ax.xaxis, ax.yaxis):
                side.set_major_locator(MaxNLocator(4, integer=True))
            curves[f"{words}: {name}"] = as_curve(full, series[f"{axis}/{name}"])
    plotting.letter_panels(grid, [*AXES.values(), *AXES.values()])
    plotting.label_axes(grid[0, 0], y=("reduced order,\n$y$ measured", "s"))
    plotting.label_axes(grid[1, 0], y=("reduced order,\n$x_1$ measured", "s"))
    plotting.label_axes(grid[1, 1], x=("settling time of the full order", "s"))
    return fig, curves
