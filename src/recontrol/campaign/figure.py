"""One picture of a campaign: the distribution of each outcome, its quantiles, the worst found and the proven bound.

In: the content of a distributions artifact. Out: a figure and the curves that it shows.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from recontrol.campaign.sketch import Sketch

MARKED = ("0.05", "0.5", "0.95")
REACH = 2.0
"""How many widths of the distribution a bound may lie away and still be drawn as a line."""


def draw(content: Mapping[str, Any]) -> tuple[Any, dict[str, tuple[Any, Any]]]:
    """Figure with one panel an outcome, and curves label -> (x, y).

    content: as published by the pipeline: `campaign`, and `outcomes` with sketch, quantiles, bound, unit and what.
    """
    from recontrol import plotting

    names = list(content["outcomes"])
    columns = 2 if len(names) > 1 else 1
    rows = math.ceil(len(names) / columns)
    width = plotting.PAGE if columns > 1 else plotting.COLUMN
    fig, axes = plotting.subplots(rows, columns, width=width, height=14 + 44 * rows, squeeze=False)
    curves: dict[str, tuple[Any, Any]] = {}
    for number, ax in enumerate(axes.flat):
        if number >= len(names):
            ax.set_axis_off()
            continue
        curves |= _panel(ax, names[number], content["outcomes"][names[number]])
    _legend(fig)
    return fig, curves


def _panel(ax: Any, name: str, row: Mapping[str, Any]) -> dict[str, tuple[Any, Any]]:
    """Draw one outcome; returns its curves."""
    from recontrol import plotting

    sketch = Sketch.from_json(row)
    below = sketch.diverged / sketch.count if sketch.worst == "min" else 0.0
    ax.set_title(name)
    plotting.label_axes(ax, (row["what"], row["unit"]), ("fraction of trajectories", "1"))
    ax.set_ylim(-0.03, 1.03)
    if sketch.count == sketch.diverged:
        ax.text(0.5, 0.5, "no trajectory ended", transform=ax.transAxes, ha="center")
        return {f"{name}: diverged": ([0.0], [row["diverged"]])}
    x, y = ([start, *rest] for start, rest in zip((sketch.minimum, below), sketch.curve(), strict=True))
    ax.plot(x, y, drawstyle="steps-post", label="found", **plotting.SERIES[0].line)
    curves: dict[str, tuple[Any, Any]] = {f"{name}: distribution": (x, y)}
    middles = [(sum(ends) / 2, float(level)) for level in MARKED if (ends := row["quantiles"][level]) is not None]
    if middles:
        curves[f"{name}: quantiles"] = ([x for x, _ in middles], [y for _, y in middles])
        ax.plot(*curves[f"{name}: quantiles"], label="5, 50, 95 %", **plotting.SERIES[0].points)
    if sketch.diverged:
        share = 100 * sketch.diverged / sketch.count
        ax.text(0.98, 0.08, f"{share:.3g} % not finite", transform=ax.transAxes, ha="right")
    else:
        curves[f"{name}: worst"] = ([sketch.maximum], [1.0]) if sketch.worst == "max" else ([sketch.minimum], [0.0])
        ax.plot(*curves[f"{name}: worst"], label="worst found", **plotting.SERIES[1].points)
    if row["bound"] is not None:
        _mark(ax, row["bound"], sketch.minimum, sketch.maximum)
        curves[f"{name}: bound"] = ([row["bound"]] * 2, [0.0, 1.0])
    plotting.put_factor_into_label(ax)
    return curves


def _mark(ax: Any, bound: float, low: float, high: float) -> None:
    """The proven bound: a line, or its value at the margin where a line would squeeze the distribution low..high."""
    from recontrol import plotting

    if low - REACH * (high - low) <= bound <= high + REACH * (high - low):
        ax.axvline(bound, label="proven bound", **plotting.SERIES[3].line)
    else:
        ax.text(0.98, 0.18, f"proven bound {bound:.3g}", transform=ax.transAxes, ha="right")


def _legend(fig: Any) -> None:
    """One legend for all panels, above them; entries of every panel once."""
    entries: dict[str, Any] = {}
    for ax in fig.axes:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    if entries:
        fig.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=len(entries))
