"""One finding per figure, readable without its caption."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting
from recontrol.exact import rational
from recontrol.lmi import verify
from recontrol.plotting import BLACK, BLUE, FAINT, GOLD, GREY, PAGE, PALE, ROSE, SERIES

from ..synthesis.gains import COST_UNIT

Curves = dict[str, tuple[np.ndarray, np.ndarray]]


def poles(data: Any, model: Any) -> tuple[Any, Curves]:
    """Poles of A - LC for both gains against the poles set: three crosses missed, three hit."""
    figure, ax = plotting.subplots(height=64)
    wanted = np.ravel(data.float("poles"))
    curves: Curves = {"poles set": (wanted.real, np.abs(wanted.imag))}
    ax.plot(
        wanted.real, np.abs(wanted.imag), "x", color=BLACK, markersize=10, markeredgewidth=1.4, label="poles set (40)"
    )
    for case, words, style in (
        ("L_printed", "L as printed: all three missed", SERIES[1]),
        ("L_corrected", "L21 = -0.0025: hit", SERIES[0]),
    ):
        found = np.array([s for s in model["poles"][case] if s.imag > 0])
        ax.plot(found.real, found.imag, label=words, **style.points)
        curves[case] = (found.real, found.imag)
    plotting.label_axes(ax, ("real part", "1/s"), ("imaginary part, upper half", "1/s"))
    ax.set_ylim(0.06, 0.135)
    ax.margins(x=0.12)
    plotting.legend_below(figure, ax, columns=1)
    return figure, curves


def digits_n(synthesis: Any, model: Any) -> tuple[Any, Curves]:
    """Margin of the joint box of X, Y, K over the mean motion: positive where the digits fit."""
    found = synthesis["intervals"]
    figure, ax = plotting.subplots(height=64)
    curves: Curves = {}
    words = {"SF": "without the observer block", "CO": "with the canonical observer"}
    for k, name in enumerate(("SF", "CO")):
        ends = [found[f"{name}_{side}"]["outside"] for side in ("low", "high")]
        n = np.concatenate([found[name]["n"], [e["n"] for e in ends]])
        margin = np.concatenate([found[name]["margin"], [e["margin"] for e in ends]])
        order = np.argsort(n)
        ax.plot(n[order] * 1e3, margin[order] * 1e6, label=words[name], **SERIES[k].line)
        ax.plot(n[order] * 1e3, margin[order] * 1e6, **SERIES[k].points)
        curves[name] = (n[order], margin[order])
        ax.axvspan(
            ends[0]["n"] * 1e3, ends[1]["n"] * 1e3, facecolor=(FAINT, PALE)[k], edgecolor="none", zorder=0.5 + k / 10
        )
    ax.axhline(0, color=BLACK, linewidth=0.8)
    for name, text, side in (("n_printed", "n printed", 4), ("n_orbit", "n of the orbit", -4)):
        value = float(rational.to_float(model["n"][name])) * 1e3
        ax.axvline(value, color=GREY, linestyle="--", linewidth=0.9)
        ax.annotate(
            text,
            (value, -8.2),
            xytext=(side, 0),
            textcoords="offset points",
            fontsize=6.2,
            ha="left" if side > 0 else "right",
        )
    ax.set_xlim(1.122, 1.1325)
    ax.set_ylim(-9, 2.6)
    ax.annotate("digits fit", (1.1222, 0.25), fontsize=6.2)
    ax.annotate("refuted", (1.1222, -0.75), fontsize=6.2)
    plotting.label_axes(ax, ("mean motion", "1e-3 rad/s"), ("margin of the joint box", "1e-6 1/s"))
    plotting.legend_below(figure, ax, columns=2)
    return figure, curves


def observer_blocks(synthesis: Any) -> tuple[Any, Curves]:
    """Margin of each arrangement of the observer blocks: the printed one and the real parts survive."""
    table = synthesis["arrangements"]["table"]
    names = list(table)
    margins = np.array([np.nan if table[n]["margin"] is None else table[n]["margin"] for n in names])
    known = np.isfinite(margins)
    order = np.argsort(np.where(known, margins, -1e9))[::-1]
    order = order[known[order]]
    figure, ax = plotting.subplots(width=PAGE, height=66)
    rank = np.arange(1, len(order) + 1)
    values = margins[order]
    good = values > 0
    ax.plot(rank[good], values[good], label="compatible with the digits", **SERIES[0].points)
    ax.plot(rank[~good], values[~good], label="refuted", **SERIES[1].points)
    ax.set_yscale("symlog", linthresh=1e-8)
    ax.axhline(0, color=BLACK, linewidth=0.8)
    shown = [k for k, n in enumerate(order) if good[k] or names[n] in ("minus half", "order 021 signs +++")]
    for step, k in enumerate(shown):
        text = names[order[k]].replace("order 012 signs +++", "printed order and signs").replace("minus half", "-0.5 I")
        ax.annotate(text, (rank[k], values[k]), xytext=(8, 9 - 12 * step), textcoords="offset points", fontsize=6.2)
    plotting.label_axes(ax, ("arrangement of the observer matrix, by rank", "1"), ("margin of the joint box", "1/s"))
    plotting.legend_below(figure, ax)
    return figure, {"margin": (rank.astype(float), values)}


def fig4_zero(data: Any, simulation: Any) -> tuple[Any, Curves]:
    """Thrust commanded if the observer starts from zero, against the limits, log scale."""
    series = simulation["main"]["series"]
    figure, ax = plotting.subplots(height=66)
    shown = series["time"] <= 30
    t = series["time"][shown]
    curves: Curves = {}
    for i, name in enumerate("xyz"):
        y = np.abs(series["xhat0_zero_command"][i, shown])
        ax.plot(t, np.maximum(y, 1e-2), label=f"|thrust {name}|", **SERIES[i].line)
        curves[f"command {name}"] = (t, y)
    _, in_plane, out_of_plane = data.float("u_max")[0]
    ax.axhline(in_plane, color=GREY, linewidth=0.9, label=f"limit {in_plane:g} N (x, y)")
    ax.axhline(out_of_plane, color=GREY, linewidth=0.9, linestyle=":", label=f"limit {out_of_plane:g} N (z)")
    ax.set_yscale("log")
    ax.set_ylim(0.05, 3000)
    plotting.label_axes(ax, ("time", "s"), ("thrust commanded", "N"))
    plotting.legend_below(figure, ax)
    return figure, curves


def bounds(synthesis: Any, simulation: Any) -> tuple[Any, Curves]:
    """Certified bounds of the cost against the simulated cost of the linear model, per e(0)."""
    cost, linear = synthesis["repaired"]["cost"], simulation["linear_cost"]["values"]
    cases = ("e0_zero", "e0_velocity", "e0_full")
    words = ("e(0) = 0", "velocity\nunknown", "observer\nfrom zero")
    place = np.arange(3.0)
    rows = {
        "simulated, worst phase": [linear[c]["worst"] for c in cases],
        "bound, separate P": [cost[f"{c}_block_diagonal"]["bound"] for c in cases],
        "bound, full P": [cost[f"{c}_full_diagonal"]["bound"] for c in cases],
    }
    figure, axes = plotting.subplots(1, 2, width=PAGE, height=62, width_ratios=[1, 1])
    curves: Curves = {}
    for k, (label, values) in enumerate(rows.items()):
        y = np.array(values, dtype=float)
        for ax in axes:
            ax.plot(place + 0.16 * (k - 1), y / 1e9, label=label, **SERIES[k].points)
        curves[label] = (place, y)
    axes[0].set_yscale("log")
    axes[1].set_ylim(3.55, 4.02)
    for ax in axes:
        ax.set_xticks(place, words)
        ax.set_xlim(-0.5, 2.5)
        ax.set_ylabel("cost J (1e9, SI units of the paper)")
    plotting.letter_panels(axes, ["whole range", "enlarged: every bound above its cost"])
    plotting.legend_below(figure, axes)
    return figure, curves


def z_freedom(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Range of X33 and of the gain K33 at 1.002 rho*: nearly free in SF, determined in CO, print marked."""
    figure, axes = plotting.subplots(1, 2, width=PAGE, height=46)
    curves: Curves = {}
    printed = {"X33": data.float("X")[2, 2], "K33": data.float("K")[2, 2]}
    for y, name in enumerate(("SF", "CO")):
        ends = synthesis[name]["X33"]
        spans = {
            "X33": [ends[side]["X33"] for side in ("low", "high")],
            "K33": [ends[side]["K"][2, 2] for side in ("low", "high")],
        }
        for ax, (entry, span) in zip(axes, spans.items(), strict=True):
            low, high = sorted(float(v) for v in span)
            ax.plot([low, high], [y, y], color=(BLUE, ROSE)[y], linewidth=4, solid_capstyle="butt")
            curves[f"{name}, {entry}"] = (np.array([low, high]), np.array([y, y], dtype=float))
    for ax, entry in zip(axes, ("X33", "K33"), strict=True):
        ax.axvline(printed[entry], color=GOLD, linewidth=1.4, label="print")
        ax.set_xscale("log")
        ax.set_yticks([0, 1], ["no observer\nblock (SF)", "canonical\nobserver (CO)"])
        ax.set_ylim(-0.6, 1.6)
    axes[0].set_xlabel("X33 (m² per unit of cost)")
    axes[1].set_xlabel("K33 (N/m)")
    plotting.letter_panels(axes, ["range of X33 at 1.002 rho*", "K33 at these two ends"])
    plotting.legend_below(figure, axes)
    return figure, curves


def si_answers(synthesis: Any, certificates: Any) -> tuple[Any, Curves]:
    """What each solver called its answer for SF, in SI and in scaled units, against the enclosure of rho*."""
    plain, scaled = synthesis["units_matter"], synthesis["SF"]["R2"]["solvers"]["rho"]
    solvers = ("CLARABEL", "CVXOPT", "SDPA", "SCS")
    figure, ax = plotting.subplots(height=62)
    curves: Curves = {}
    stated = verify.number(certificates["rho_SF_R2_low"]["bound"]["value"])
    truth = COST_UNIT / float(rational.to_float(stated))
    ax.axvline(truth, color=BLACK, linewidth=0.9, label="enclosure of rho* (line width is wider)")
    groups = {
        "scaled units": [(k, scaled.get(s)) for k, s in enumerate(solvers)],
        "SI units": [(k, plain[f"SF, max r, {s}"]["rho"]) for k, s in enumerate(solvers)],
    }
    for j, (label, points) in enumerate(groups.items()):
        known = [(k, v) for k, v in points if v is not None]
        y, x = np.array([k for k, _ in known], dtype=float), np.array([v for _, v in known], dtype=float)
        ax.plot(x, y + 0.18 * (2 * j - 1), label=label, **SERIES[j].points)
        # Every solver keeps its place in the data; 0 stands for no answer.
        curves[label] = (np.arange(4.0), np.array([v or 0.0 for _, v in points], dtype=float))
    for k, s in enumerate(solvers):
        entry = plain[f"SF, max r, {s}"]
        words = "failed" if entry["words"].startswith("error") else entry["words"]
        ax.annotate(f"SI: {words}", (1.2e10, k + 0.12), fontsize=6.2)
    ax.set_xscale("log")
    ax.set_xlim(5e6, 4e11)
    ax.set_yticks(range(4), solvers)
    ax.set_ylim(-0.5, 3.5)
    ax.set_xlabel("guaranteed cost rho of SF (SI units of the paper)")
    plotting.legend_below(figure, ax, columns=2)
    return figure, curves
