"""Figures 2 to 5 of the paper, which prints no data: redrawn with the printed K and the corrected L."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting
from recontrol.plotting import GREY, PAGE, SERIES

Curves = dict[str, tuple[np.ndarray, np.ndarray]]


def fig2(simulation: Any) -> tuple[Any, Curves]:
    """Velocity components of the observer error over 30 s: start from the position, and from zero."""
    series = simulation["main"]["series"]
    figure, axes = plotting.subplots(1, 2, width=PAGE, height=58)
    curves: Curves = {}
    early = series["time"] <= 30
    for ax, case in zip(axes, ("xhat0_r0", "xhat0_zero"), strict=True):
        for i, name in enumerate("xyz"):
            t, y = series["time"][early], series[f"{case}_velocity_error"][i, early]
            ax.plot(t, y, label=f"error of $v_{name}$", **SERIES[i].line)
            curves[f"{case}, v_{name}"] = (t, y)
        plotting.label_axes(ax, ("time", "s"), ("velocity error", "m/s"))
    plotting.letter_panels(axes, ["observer starts at the position", "observer starts at zero (own scale)"])
    plotting.legend_below(figure, axes)
    return figure, curves


def fig3(simulation: Any) -> tuple[Any, Curves]:
    """Relative velocities, 6000 s and 60 s."""
    series = simulation["main"]["series"]
    figure, axes = plotting.subplots(1, 2, width=PAGE, height=58)
    curves: Curves = {}
    for ax, end in zip(axes, (6000.0, 60.0), strict=True):
        shown = series["time"] <= end
        for i, name in enumerate("xyz"):
            t, y = series["time"][shown], series["xhat0_r0_state"][3 + i, shown]
            ax.plot(t, y, label=f"$v_{name}$", **SERIES[i].line)
            curves[f"v_{name} to {end:.0f} s"] = (t, y)
        plotting.label_axes(ax, ("time", "s"), ("relative velocity", "m/s"))
    plotting.letter_panels(axes, ["whole rendezvous", "first minute"])
    plotting.legend_below(figure, axes)
    return figure, curves


def fig4(data: Any, simulation: Any) -> tuple[Any, Curves]:
    """Thrusts with their bounds: 6000 s and 60 s, observer started from the position and from the state."""
    series = simulation["main"]["series"]
    figure, axes = plotting.subplots(2, 2, width=PAGE, height=104)
    curves: Curves = {}
    titles = []
    _, in_plane, out_of_plane = data.float("u_max")[0]
    for row, (case, words) in zip(
        axes, (("xhat0_r0", "start at the position"), ("xhat0_x0", "start at the state")), strict=True
    ):
        for ax, end in zip(row, (6000.0, 60.0), strict=True):
            shown = series["time"] <= end
            for i, name in enumerate("xyz"):
                t, y = series["time"][shown], series[f"{case}_command"][i, shown]
                ax.plot(t, y, label=f"thrust {name}", **SERIES[i].line)
                curves[f"{case}, {name} to {end:.0f} s"] = (t, y)
            for level, axes_words, style in ((in_plane, "x, y", "-"), (out_of_plane, "z", ":")):
                for sign in (1, -1):
                    label = f"bound {level:g} N ({axes_words})" if sign > 0 else None
                    ax.axhline(sign * level, color=GREY, linewidth=0.8, linestyle=style, label=label)
            plotting.label_axes(ax, ("time", "s"), ("thrust", "N"))
            titles.append(f"{words}, {end:.0f} s")
    plotting.letter_panels(axes.ravel(), titles)
    plotting.legend_below(figure, axes, columns=5)
    return figure, curves


def fig5(simulation: Any) -> tuple[Any, Curves]:
    """Trajectory of the first 3000 s: y over x in km with a mark every 500 s, and z over time."""
    series = simulation["main"]["series"]
    time = series["time"]
    shown = time <= 3000
    x, y, z = series["xhat0_r0_state"][:3, shown]
    figure, axes = plotting.subplots(1, 2, width=PAGE, height=62)
    axes[0].plot(x / 1000, y / 1000, **SERIES[0].line)
    marks = np.searchsorted(time, np.arange(0, 3001, 500))
    axes[0].plot(x[marks] / 1000, y[marks] / 1000, **SERIES[1].points)
    for k, second in zip(marks[:4], range(0, 2000, 500), strict=True):
        axes[0].annotate(
            f"{second} s", (x[k] / 1000, y[k] / 1000), xytext=(4, -7), textcoords="offset points", fontsize=6
        )
    plotting.label_axes(axes[0], ("x, radial", "km"), ("y, along track", "km"))
    axes[1].plot(time[shown], z, **SERIES[0].line)
    plotting.label_axes(axes[1], ("time", "s"), ("z, out of plane", "m"))
    plotting.letter_panels(axes, ["orbital plane, marks every 500 s", "out of plane"])
    return figure, {"y over x": (x / 1000, y / 1000), "z over time": (time[shown], z)}
