"""Figures in the frequency domain: Nyquist curves of pitch, loop transfer recovery."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

from .style import AXES, AXIS_SERIES, CORRECTED, X1, Curves, as_curve

STATE_FEEDBACK_AT = 1.4e7  # where the marks of state feedback stand on the axis of q_e


def pitch(simulation: Any) -> tuple[Any, Curves]:
    """Loop transfer of the x1 design and of the corrected design near -1; both for positive and negative frequency."""
    series = simulation["pitch"]["series"]
    fig, panels = plotting.subplots(1, 2, height=56)
    circle = np.linspace(0, 2 * np.pi, 361)
    curves: Curves = {}
    for ax in panels:
        ax.plot(np.cos(circle), np.sin(circle), color=plotting.PALE, linewidth=0.8, label="unit circle")
        for name, words, style in (
            ("x1", "$x_1$ measured", X1),
            ("corrected", "$y$ measured", CORRECTED),
        ):
            real, imag = series[f"{name}/real"], series[f"{name}/imag"]
            ax.plot(real, imag, label=words, **style.line)
            ax.plot(real, -imag, linewidth=0.6, **style.line)
            curves[words] = as_curve(real, imag)
        ax.plot([-1], [0], marker="+", color=plotting.BLACK, markersize=7, markeredgewidth=1.1, linestyle="none",
                label="the point −1")  # fmt: skip
        ax.set_box_aspect(1)
        plotting.label_axes(ax, x=("real part of $L$", "1"))
    panels[0].set(xlim=(-2.4, 1.2), ylim=(-1.8, 1.8))
    panels[1].set(xlim=(-1.05, -0.95), ylim=(-0.05, 0.05))
    plotting.label_axes(panels[0], y=("imaginary part of $L$", "1"))
    plotting.letter_panels(panels, ["loop transfer", "near −1"])
    plotting.legend_below(fig, panels, columns=2)
    return fig, curves


def ltr(simulation: Any) -> tuple[Any, Curves]:
    """Peak sensitivity and phase margin over the process noise of the estimator."""
    values, series = simulation["recovery"]["values"]["axes"], simulation["recovery"]["series"]
    q = series["q_e"]
    fig, panels = plotting.subplots(2, 1, height=92, sharex=True)
    curves: Curves = {}
    for ax, name in zip(panels, ("peak_sensitivity", "phase_margin"), strict=True):
        for axis, words in AXES.items():
            y, style = series[f"{axis}/{name}"], AXIS_SERIES[axis]
            ax.plot(q, y, label=words, **style.line)
            curves[f"{words}: {name}"] = as_curve(q, y)
            target = float(values[axis]["state_feedback"][name])
            place = STATE_FEEDBACK_AT * {"o": 0.6, "s": 1.0, "^": 1.67}[style.marker]
            ax.plot(place, target, zorder=4, **(style.points | {"markersize": 4.6}))
            curves[f"{words}: {name}, state feedback"] = as_curve(place, target)
        ax.axvline(10.0, color=plotting.GREY, linewidth=0.7, zorder=1)
        ax.set_xscale("log")
        ax.axvspan(2e6, 1e8, facecolor=plotting.FAINT, edgecolor="none", zorder=0.5)
        ax.minorticks_off()
    panels[0].annotate("the paper's estimator", (10.0, 1.0), (3, -1), xycoords=("data", "axes fraction"),
                       textcoords="offset points", fontsize=6, va="top", color=plotting.GREY)  # fmt: skip
    panels[0].set_ylim(0.9, 3.3)
    panels[1].set(xlim=(1, 1e8), ylim=(25, 75))
    exponents = (0, 1, 2, 3, 4, 5, 6)
    panels[1].set_xticks(
        [*(10.0**k for k in exponents), STATE_FEEDBACK_AT], [*(f"$10^{k}$" for k in exponents), "state\nfeedback"]
    )
    fig.align_ylabels(panels)
    plotting.label_axes(panels[0], y=("peak sensitivity", "1"))
    plotting.label_axes(panels[1], ("process noise weight $q_e$", "1"), ("phase margin", "deg"))
    plotting.letter_panels(panels)
    plotting.legend_below(fig, panels[0], columns=3)
    return fig, curves
