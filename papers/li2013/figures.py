"""Figures of li2013: each function returns the drawing and the curves in it."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

Curves = dict[str, tuple[np.ndarray, np.ndarray]]
AXES = "xyz"
GAIN_WORDS = {"K_bar": "published gain", "zero": "no control", "minus": "gain with wrong sign"}


def fig1(data: Any, simulation: Any) -> tuple[Any, Curves]:
    """Positions and velocities from x(0), held reference, no disturbance."""
    series = simulation["loops"]["series"]
    time, state = series["time"], series["w-print_hold_none_state"]
    keep = time <= 120.0
    fig, panels = plotting.subplots(2, 1, height=96, sharex=True)
    curves: Curves = {}
    for k, axis in enumerate(AXES):
        style = plotting.SERIES[k].line
        for row, (ax, word) in enumerate(zip(panels, ("position", "velocity"), strict=True)):
            ax.plot(time[keep], state[keep, 3 * row + k], label=axis, **style)
            curves[f"{word} {axis}"] = (time[keep], state[keep, 3 * row + k])
    panels[0].axhline(data.float("y_r")[0, 1], color=plotting.GREY, linewidth=0.7, label="reference in y")
    plotting.label_axes(panels[0], y=("relative position", "m"))
    plotting.label_axes(panels[1], x=("time", "s"), y=("relative velocity", "m/s"))
    plotting.letter_panels(panels)
    plotting.legend_below(fig, panels, columns=4)
    return fig, curves


def fig2(data: Any, simulation: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Held thrust of each axis, its limit, and the bound that the derived condition can guarantee."""
    series = simulation["loops"]["series"]
    instants, control = series["instants"], series["w-print_hold_none_control"]
    bound = synthesis["initial"]["thrust_bound"]["w-print"]
    fig, ax = plotting.subplots(height=66)
    curves: Curves = {}
    keep = instants <= 60.0
    for k, axis in enumerate(AXES):
        ax.step(instants[keep], control[keep, k], where="post", label=f"thrust {axis}", **plotting.SERIES[k].line)
        curves[f"thrust {axis}"] = (instants[keep], control[keep, k])
    limit = data.float("thrust_max")
    for sign in (1, -1):
        ax.axhline(sign * limit, color=plotting.BLACK, linewidth=0.8, label="limit of sec. 4")
        ax.axhline(
            sign * bound, color=plotting.GREY, linewidth=0.8, linestyle=(0, (1.2, 1.4)), label="least guaranteed bound"
        )
    curves["least guaranteed bound"] = (np.array([0.0, 60.0]), np.array([bound, bound]))
    ax.set_ylim(-1.15 * limit, 1.15 * limit)
    plotting.label_axes(ax, x=("time", "s"), y=("thrust", "N"))
    plotting.legend_below(fig, ax, columns=3)
    return fig, curves


def fig3(data: Any, simulation: Any) -> tuple[Any, Curves]:
    """V(t): envelope on both scales, jumps under random sampling, held reference raw and shifted."""
    series = simulation["functional"]["series"]
    fig, panels = plotting.subplots(2, 2, width=plotting.PAGE, height=104)
    curves: Curves = {}
    time, V = series["periodic_time"].ravel(), series["periodic_V"].ravel()
    envelope = V[0] * np.exp(-2 * data.float("alpha") * time)
    for ax, last in ((panels[0, 0], 60.0), (panels[0, 1], 200.0)):
        keep = time <= last
        ax.plot(time[keep], V[keep], label="V(t)", **plotting.SERIES[0].line)
        ax.plot(time[keep], envelope[keep], label="envelope of rate 0.02 1/s", **plotting.SERIES[1].line)
        plotting.label_axes(ax, x=("time", "s"), y=("V", "1"))
    panels[0, 1].set_yscale("log")
    curves |= {"V periodic": (time[::4], V[::4]), "envelope": (time[::4], envelope[::4])}
    _jumps(panels[1, 0], series, curves)
    for k, (name, words) in enumerate((("hold-raw", "unshifted"), ("hold-shifted", "shifted by the equilibrium"))):
        t, values = series[f"{name}_time"].ravel(), series[f"{name}_V"].ravel()
        panels[1, 1].plot(t, values, label=words, **plotting.SERIES[k + 2].line)
        curves[f"V held reference, {words}"] = (t[::4], values[::4])
    panels[1, 1].set_yscale("log")
    plotting.label_axes(panels[1, 1], x=("time", "s"), y=("V", "1"))
    panels[1, 1].legend()
    panels[0, 0].legend()
    titles = ["linear scale", "logarithmic scale", "random intervals", "held reference"]
    plotting.letter_panels(panels, titles)
    return fig, curves


def _jumps(ax: Any, series: Any, curves: Curves) -> None:
    """V around some instants of the random sequence: it falls at each, never rises."""
    t, V = series["random_time"], series["random_V"]
    rows = [k for k in range(len(t)) if 4.0 <= t[k, 0] <= 6.0][:5]
    for number, k in enumerate(rows):
        ax.plot(t[k], V[k], color=plotting.BLUE, label="V(t)" if number == 0 else None)
        if number:
            before = rows[number - 1]
            ax.plot([t[k, 0]] * 2, [V[before, -1], V[k, 0]], color=plotting.ROSE, linestyle=":",
                    label="jump at an instant" if number == 1 else None)  # fmt: skip
    curves["V random"] = (t[rows].ravel(), V[rows].ravel())
    plotting.label_axes(ax, x=("time", "s"), y=("V", "1"))
    ax.legend()


def void(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Margins of printed, derived and singly faulty (21) for three gains, with the loops' spectral radius."""
    from recontrol.systems.sampled import monodromy, spectral_radius

    from .conditions import FAULTS
    from .sweeps import floats

    margins = synthesis["margins"]
    rows = [
        ("derived", margins["table"]["derived"]["w-print"]["0.02"]),
        ("printed", margins["table"]["printed"]["w-print"]["0.02"]),
        *((f"derived with {fault}", margins["faults"][fault]) for fault in FAULTS),
    ]
    fig, ax = plotting.subplots(width=plotting.PAGE, height=84)
    heights = np.arange(len(rows), 0, -1.0)
    curves: Curves = {}
    for k, (gain, words) in enumerate(GAIN_WORDS.items()):
        v = floats(data, f"gain={gain}")
        radius = spectral_radius(monodromy(v["A_print"], v["B"] @ v["K"], v["h"]))
        values = np.array([found[gain] for _, found in rows])
        # Solvers leave about 1e-8 of an infimum of zero.
        values = np.where(np.abs(values) < 1e-6, 0.0, values)
        label = f"{words}, spectral radius {radius:.4f}"
        ax.plot(values, heights + 0.18 * (1 - k), label=label, **plotting.SERIES[k].points)
        curves[words] = (values, heights)
    ax.axvline(0.0, color=plotting.GREY, linewidth=0.7)
    ax.set_xscale("symlog", linthresh=1e-4, linscale=0.6)
    ax.set_xticks([-1e-2, -1e-4, 0, 1e-4, 1e-2, 1])
    ax.set_xlim(-3e-2, 2)
    ax.set_yticks(heights, [words for words, _ in rows])
    ax.grid(False, axis="y")
    plotting.label_axes(ax, x=("largest margin; positive: the inequality has a solution", "1"))
    plotting.legend_below(fig, ax, columns=1)
    return fig, curves


def gamma(data: Any, synthesis: Any, simulation: Any) -> tuple[Any, Curves]:
    """Gains per channel against the printed level, and the infimum of the printed blocks against h."""
    found, values = synthesis["gamma"], simulation["gains"]["values"]
    channels = {"both": "d and y_r", "yr-only": "y_r", "d-only": "d"}
    kinds = {
        "static gain": [values["continuous"]["w-print"][ch]["static"] for ch in channels],
        "continuous control": [values["continuous"]["w-print"][ch]["norm"] for ch in channels],
        "sampled control": [values["sampled"]["w-print"][ch]["32"]["gain"] for ch in channels],
        "derived inequality": [found["derived"]["w-print"][ch]["a02"]["gamma"] for ch in channels],
    }
    fig, (left, right) = plotting.subplots(1, 2, width=plotting.PAGE, height=72)
    places, curves = np.arange(3.0), {}
    for k, (words, row) in enumerate(kinds.items()):
        left.plot(places + 0.16 * (k - 1.5), row, label=words, **plotting.SERIES[k].points)
        curves[words] = (places, np.array(row))
    level = data.float("gamma")
    left.axhline(level, color=plotting.GREY, linewidth=0.9, label=f"printed level {level:g}")
    left.set(yscale="log", xlim=(-0.6, 2.6))
    left.set_yticks([0.1, 0.4, 1, 4, 10], ["0.1", "0.4", "1", "4", "10"])
    left.minorticks_off()
    left.set_xticks(places, list(channels.values()))
    plotting.label_axes(left, x=("input of the gain to z", "channel"), y=("gain", "SI"))
    h = np.array([float(key) for key in found["law"]])
    least = np.array([found["law"][key]["gamma"] for key in found["law"]])
    line = np.array([0.0, 1.6])
    right.plot(line, 0.8 * line, label="4 h / 5", **plotting.SERIES[1].line)
    right.plot(h, least, label="infimum found", **plotting.SERIES[0].points)
    right.plot(
        [data.float("h")], [level], label="printed pair (h, gamma)", color=plotting.BLACK, marker="x", linestyle="none"
    )
    curves |= {"infimum of the printed blocks": (h, least), "law": (line, 0.8 * line)}
    plotting.label_axes(right, x=("period h", "s"), y=("infimum of gamma, y_r", "s"))
    left.legend(loc="lower left")
    right.legend(loc="upper left")
    plotting.letter_panels([left, right], ["derived", "printed blocks"])
    return fig, curves


def periods(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Largest period per condition and block, beside the exact limit of periodic sampling."""
    found, exact = synthesis["periods"]["h_max"], synthesis["periods"]["exact"]["w-print"]
    rows = {
        "time-independent": "time-independent",
        "derived without $P_3$": "no-P3",
        "derived": "derived-a0",
        "exact limit": "a0",
        "derived, rate 0.02 1/s": "derived-a02",
        "exact limit, rate 0.02 1/s": "a02",
    }
    fig, ax = plotting.subplots(height=70)
    heights, curves = np.arange(len(rows), 0, -1.0), {}
    for k, (block, words) in enumerate((("xy", "plane"), ("z", "z axis"))):
        values = [found[key][block]["low"] if key in found else exact[block][key]["low"] for key in rows.values()]
        ax.plot(values, heights, label=words, **plotting.SERIES[k].points)
        curves[words] = (np.array(values), heights)
    ax.axvline(data.float("h"), color=plotting.GREY, linewidth=0.9, label="printed h")
    ax.set_yticks(heights, list(rows))
    ax.set_xlim(0, 4.5)
    ax.grid(False, axis="y")
    plotting.label_axes(ax, x=("largest period", "s"))
    plotting.legend_below(fig, ax, columns=3)
    return fig, curves


def initial(data: Any, synthesis: Any, simulation: Any) -> tuple[Any, Curves]:
    """The intervals of V(0) that each set of conditions admits, the printed value, rho, and the integral bound."""
    found = synthesis["initial"]
    top = 1e7
    rows = {
        "printed (21), (22)": (found["infimum"]["printed"]["w-print"]["a02"], top),
        "derived (21), (22)": (found["infimum"]["derived"]["w-print"]["a02"], top),
        "derived with (55), d alone, rate 0.02": (found["range"]["a02"]["min"], found["range"]["a02"]["max"]),
        "derived with (55), d alone, rate 0": (found["range"]["a0"]["min"], found["range"]["a0"]["max"]),
    }
    fig, ax = plotting.subplots(width=plotting.PAGE, height=62)
    curves: Curves = {}
    heights = np.arange(len(rows), 0, -1.0)
    for height, (words, (low, high)) in zip(heights, rows.items(), strict=True):
        ax.plot([low, high], [height] * 2, color=plotting.BLUE, linewidth=5, solid_capstyle="butt")
        if high == top:
            ax.annotate(
                "no upper end", (high, height), xytext=(-3, 5), textcoords="offset points", ha="right", va="bottom"
            )
        curves[words] = (np.array([low, high]), np.array([height, height]))
    integral = simulation["functional"]["values"]["integral"]["w-print"]["stein"]
    marks = (
        (data.float("V0"), "printed V(0)", plotting.SERIES[1]),
        (data.float("rho"), "rho", plotting.SERIES[3]),
        (integral, "integral of e'e: least V(0) under (55)", plotting.SERIES[2]),
    )
    for value, words, style in marks:
        ax.axvline(value, label=words, **style.line)
    ax.set(xscale="log", xlim=(300, top), ylim=(0.4, len(rows) + 0.7))
    ax.set_yticks(heights, list(rows))
    ax.grid(False, axis="y")
    plotting.label_axes(ax, x=("V(0)", "m² s³ under (55)"))
    plotting.legend_below(fig, ax, columns=3)
    return fig, curves


def resynthesis(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Guaranteed and simulated thrust against the exact decay, with the published gain."""
    found = synthesis["resynthesis"]
    designs = found["designs"]
    decay = np.array([d["decay"] for d in designs.values()])
    guaranteed = np.array([d["u"] for d in designs.values()])
    peak = np.array([float(np.max(d["u_peak"])) for d in designs.values()])
    fig, ax = plotting.subplots(height=66)
    ax.plot(decay, guaranteed, label="designed: guaranteed", **{**plotting.SERIES[0].line, "marker": "o"})
    ax.plot(decay, peak, label="designed: simulated peak", **{**plotting.SERIES[1].line, "marker": "s"})
    published = found["published"]
    bound = synthesis["initial"]["thrust_bound"]["w-print"]
    own = published["decay"], float(np.max(published["u_peak"]))
    ax.plot([own[0]], [bound], label="published: guaranteed", **plotting.SERIES[2].points)
    ax.plot([own[0]], [own[1]], label="published: simulated peak", **plotting.SERIES[3].points)
    ax.axhline(data.float("thrust_max"), color=plotting.GREY, linewidth=0.9, label="limit of sec. 4")
    ax.set(xlim=(0.04, 0.24), ylim=(0, 1450))
    plotting.label_axes(ax, x=("exact decay rate at h = 0.5 s", "1/s"), y=("thrust", "N"))
    plotting.legend_below(fig, ax, columns=2)
    curves = {
        "designed: guaranteed": (decay, guaranteed),
        "designed: simulated peak": (decay, peak),
        "published": (np.array([own[0], own[0]]), np.array([bound, own[1]])),
    }
    return fig, curves
