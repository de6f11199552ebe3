"""Figures about what is printed: the digits of (55), the poles, and the printed reduced compensator at work."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

from .style import CORRECTED, FULL, X1, Curves, as_curve

ORIGINS = {
    "derived": ("white", "#111111", "follows from the derivation"),
    "A_c for A": ("#f0dca6", "#111111", "follows with $A_c$ of (52) in place of $A$"),
    "neither": ("#8c2f42", "white", "neither"),
}


def derived_matrix(entry: Any, K: np.ndarray, L: np.ndarray, closed_twice: bool) -> np.ndarray:
    """[A - BK, BK; 0, A - LC] of (26) with A, or with A_c = A - BK in place of A."""
    A, B, C = (np.asarray(entry[name], dtype=float) for name in "ABC")
    base = A - B @ K if closed_twice else A
    return np.block([[base - B @ K, B @ K], [np.zeros_like(A), base - L @ C]])


def origin_of(printed: np.ndarray, half: np.ndarray, candidates: dict[str, np.ndarray]) -> np.ndarray:
    """Name of the first candidate that rounds to the printed digits, entry by entry; else "neither"."""
    found = np.full(printed.shape, "neither", dtype=object)
    for name, matrix in reversed(candidates.items()):
        found[np.abs(matrix - printed) <= half * (1 + 1e-9)] = name
    return found


def minus(text: str) -> str:
    """A number with a typographic minus sign."""
    return text.replace("-", "−")


def ace(data: Any, model: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Digit map of (55)."""
    from matplotlib.patches import Patch, Rectangle

    gains = synthesis["gains"]["yaw"]
    K, L = np.reshape(gains["K"], (1, 4)), np.reshape(gains["L"]["typed4"], (4, 1))
    candidates = {
        name: derived_matrix(model["yaw"], K, L, closed_twice=twice)
        for name, twice in (("derived", False), ("A_c for A", True))
    }
    half = np.vectorize(float, otypes=[float])(data.half("A_ce"))
    origins = origin_of(data.float("A_ce"), half, candidates)
    texts = [row.split() for row in data.text("A_ce").splitlines()]
    fig, ax = plotting.subplots(height=84)
    for (row, column), origin in np.ndenumerate(origins):
        face, ink, _ = ORIGINS[origin]
        ax.add_patch(Rectangle((column + 0.5, row + 0.5), 1, 1, facecolor=face, edgecolor=plotting.PALE, linewidth=0.5))
        plain = origin == "derived"
        font = {"fontsize": 6.5} if plain else {"fontsize": 6.1, "fontweight": "bold"}
        height = row + (1.0 if plain else 0.84)
        ax.text(column + 1, height, minus(texts[row][column]), ha="center", va="center", color=ink, **font)
        if not plain:
            expected = minus(f"{candidates['derived'][row, column]:.3f}")
            ax.text(column + 1, row + 1.26, expected, ha="center", va="center", color=ink, fontsize=5.2)
    ax.set(xlim=(0.5, 8.5), ylim=(8.5, 0.5), xticks=range(1, 9), yticks=range(1, 9))
    ax.grid(False)
    ax.tick_params(length=0, top=True, labeltop=True, bottom=False, labelbottom=False)
    ax.spines[:].set_visible(False)
    ax.xaxis.set_label_position("top")
    plotting.label_axes(ax, ("column of (55)", "1"), ("row of (55)", "1"))
    for place in (ax.axhline, ax.axvline):
        place(4.5, color=plotting.BLACK, linewidth=1.0)
    patches = [Patch(facecolor=f, edgecolor=plotting.PALE, label=words) for f, _, words in ORIGINS.values()]
    fig.legend(handles=patches, loc="outside lower center", ncols=2)
    return fig, {
        name: as_curve(*(np.flatnonzero((origins == name).ravel(order="C")) // d % 8 + 1 for d in (1, 8)))
        for name in ORIGINS
    }


def real_output(simulation: Any) -> tuple[Any, Curves]:
    """(66)-(69) as printed, fed with x1 and with y."""
    series = simulation["published"]["series"]
    t = series["t"]
    fig, (linear, logarithmic) = plotting.subplots(2, 1, height=94)
    curves: Curves = {}
    for name, words, style in (("x1", "fed with $x_1$", FULL), ("y", "fed with the output $y$", CORRECTED)):
        linear.plot(t, series[name], label=words, **style.line)
        logarithmic.plot(t, np.maximum(np.abs(series[name]), 1e-12), label=words, **style.line)
        curves[name] = as_curve(t, series[name])
    linear.set(xlim=(0, 25), ylim=(-6, 6))
    logarithmic.set_yscale("log")
    logarithmic.set_ylim(1e-5, 1e7)
    logarithmic.set_xlim(0, float(t[-1]))
    plotting.label_axes(linear, ("time", "s"), ("output $y$", "1"))
    plotting.label_axes(logarithmic, ("time", "s"), ("magnitude of $y$", "1"))
    plotting.letter_panels([linear, logarithmic], ["linear scale, the first 25 s", "logarithmic scale, 60 s"])
    fig.align_ylabels([linear, logarithmic])
    plotting.legend_below(fig, linear, columns=2)
    return fig, curves


def poles(model: Any, synthesis: Any, simulation: Any) -> tuple[Any, Curves]:
    """Poles of yaw in the upper half plane; the second panel enlarges the slow pairs."""
    gains, found = synthesis["gains"]["yaw"], simulation["published"]["values"]
    sets = {
        "plant": (np.linalg.eigvals(np.asarray(model["yaw"]["A"], dtype=float)), "x", plotting.BLACK, 4.5),
        "controller": (np.asarray(gains["controller_poles"]), "s", FULL.color, 4.2),
        "full-order estimator": (np.asarray(gains["estimator_poles"]), "^", X1.color, 5.0),
        "reduced loop, recomputed": (np.asarray(found["recomputed"]), "o", plotting.GREY, 8.0),
        "reduced loop, as printed": (np.asarray(found["loops"]["x1"]["eigenvalues"]), "+", CORRECTED.color, 6.5),
    }
    fig, panels = plotting.subplots(1, 2, height=74, width_ratios=(1.6, 1))
    for ax in panels:
        for words, (points, marker, color, size) in sets.items():
            rim = {"markeredgewidth": 0.4, "markeredgecolor": "white"} if marker in "s^" else {"markeredgewidth": 1.2}
            fill = {"markerfacecolor": "none"} if marker == "o" else {}
            ax.plot(points.real, points.imag, linestyle="none", marker=marker, color=color, markersize=size,
                    label=words, zorder=3, **rim, **fill)  # fmt: skip
        ax.axhline(0, color=plotting.PALE, linewidth=0.7, zorder=1)
        ax.axvline(0, color=plotting.PALE, linewidth=0.7, zorder=1)
        plotting.label_axes(ax, x=("real part", "1/s"))
    panels[0].set(xlim=(-1.25, 0.12), ylim=(-0.12, 1.62))
    panels[1].set(xlim=(-0.165, -0.105), ylim=(0.405, 0.435), xticks=[-0.16, -0.14, -0.12], yticks=[0.41, 0.42, 0.43])
    plotting.label_axes(panels[0], y=("imaginary part", "1/s"))
    plotting.letter_panels(panels, ["upper half plane", "the slow pairs"])
    plotting.legend_below(fig, panels, columns=2)
    return fig, {words: as_curve(points.real, points.imag) for words, (points, *_) in sets.items()}
