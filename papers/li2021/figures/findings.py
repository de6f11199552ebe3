"""Figures A to E: what was found about the inequalities, the drift, the random gains and the designs."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting
from recontrol.systems.output_feedback import frequency_response

from ..certificates.theorem import DRIFT_LIMITS
from ..quantities import design_controllers

SHAPES = {
    "free": "printed gains, P free",
    "structured": "printed gains, P structured",
    "ref39": "gains of [39], P free",
}


def lemma_region(synthesis: Any, data: Any) -> tuple[Any, dict[str, Any]]:
    """A: (12) in the plane of lambda^2 and gamma."""
    fig, ax = plotting.subplots(height=68)
    curves = {}
    for k, (name, label) in enumerate(SHAPES.items()):
        found = synthesis["printed"]["lemma"][name]
        tau, gamma = (np.asarray(found["curve"][axis], dtype=float) for axis in ("tau", "gamma"))
        # The left wall: the least lambda^2 at gamma = 1000.
        wall = float(found["tau-low-1000"])
        x, y = np.concatenate([[wall], tau]), np.concatenate([[1000.0], gamma])
        ax.plot(x, y, label=label, **plotting.SERIES[k].line)
        curves[label] = (x, y)
    ax.fill_between(*curves[SHAPES["structured"]], 1000.0, color=plotting.FAINT)
    ax.plot(1.0, data.float("gamma"), label="Table 1", **plotting.SERIES[3].points)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(0.3, 2000)
    ax.set_ylim(0.8, 100)
    plotting.label_axes(ax, (r"$\lambda^2$", "1"), (r"least $\gamma$", "rad/(N m)"))
    plotting.legend_below(fig, ax, columns=2)
    return fig, curves


def certified_drift(synthesis: Any, data: Any) -> tuple[Any, dict[str, Any]]:
    """B: drift up to which something is certified, as bars."""
    scaled = float(synthesis["scaled"]["disk-with-inertia"]["reached"])
    limits = synthesis["vertices"]["proposed"]["limits"]
    bars = {
        "(13), two scalars": float(DRIFT_LIMITS["one"][0]),
        "(13), four scalars": float(DRIFT_LIMITS["three"][0]),
        "(13), diagonal": float(DRIFT_LIMITS["diag"][0]),
        "scaled disk, with Delta J": scaled,
        "scaled disk, Delta H only: at least": data.float("drift_bound"),
        "vertices: disk left": float(limits["disk"][0]),
        "vertices: stability lost": float(limits["stability"][0]),
    }
    fig, ax = plotting.subplots(height=62)
    places = np.arange(len(bars))[::-1]
    colours = [plotting.BLUE] * 5 + [plotting.PALE] * 2
    ax.barh(places, [100 * v for v in bars.values()], color=colours, height=0.62)
    for place, value in zip(places, bars.values(), strict=True):
        ax.text(
            100 * value + 0.3, place, f"{100 * value:.2f}", va="center", fontsize=6, zorder=5,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
        )  # fmt: skip
    ax.axvline(100 * data.float("drift_bound"), color=plotting.ROSE, linewidth=1)
    ax.set_yticks(places, list(bars))
    ax.set_xlim(0, 26)
    ax.grid(axis="y", visible=False)
    plotting.label_axes(ax, ("gain drift", "%"))
    return fig, {name: (np.array([0.0, 1.0]), np.array([0.0, value])) for name, value in bars.items()}


def draws(simulation: Any) -> tuple[Any, dict[str, Any]]:
    """C: residual angle against hold time, divergence marked."""
    table = simulation["draws"]["values"]
    holds = ("0.02", "0.1", "0.5", "1", "10", "constant")
    fig, axes = plotting.subplots(1, 2, width=plotting.PAGE, height=66, sharey=True)
    curves = {}
    for ax, amplitude, title in zip(axes, ("1", "0.05"), ("draws of full size", "draws within 5 %"), strict=True):
        for k, (name, label) in enumerate((("proposed", "proposed gains"), ("ref39", "gains of [39]"))):
            cells = [table[f"{amplitude}/{hold}"][name] for hold in holds]
            x = np.arange(len(holds))
            y = np.array([np.nan if c["median"] is None else 1e3 * c["median"] for c in cells])
            ax.plot(x, y, label=label, marker=plotting.SERIES[k].marker, **plotting.SERIES[k].line)
            for place, cell in zip(x, cells, strict=True):
                if cell["diverged"]:
                    ax.text(
                        place, 60 if k else 26, f"{cell['diverged']} of 10\ndiverged", ha="center", va="center",
                        fontsize=5.5, color=plotting.SERIES[k].color,
                    )  # fmt: skip
            kept = np.isfinite(y)
            curves[f"{label}, {title}"] = (x[kept], y[kept])
        ax.set_yscale("log")
        ax.set_ylim(0.4, 90)
        ax.set_xticks(range(len(holds)), holds)
        plotting.label_axes(
            ax, ("hold time of a draw", "s"), ("median residual angle", "mrad") if amplitude == "1" else None
        )
    plotting.letter_panels(axes, ["draws of full size", "draws within 5 %"])
    plotting.legend_below(fig, axes, columns=2)
    return fig, curves


def responses(data: Any, synthesis: Any) -> tuple[Any, dict[str, Any]]:
    """D: singular values of K(j omega)."""
    omega = np.logspace(-2, 2, 121)
    found = design_controllers(data, synthesis)
    shown = {"proposed": "print", "ref39": "[39]", "P7 early stop": "early stop (P7)", "P5 torque": "design P5"}
    fig, ax = plotting.subplots(height=72)
    curves = {}
    for k, (name, label) in enumerate(shown.items()):
        values = np.linalg.svd(frequency_response(found[name], omega), compute_uv=False)
        for which, column in (("largest", 0), ("smallest", 2)):
            ax.plot(omega, values[:, column], label=label if column == 0 else None, **plotting.SERIES[k].line)
            curves[f"{label}, {which}"] = (omega, values[:, column])
    ax.set_xscale("log")
    ax.set_yscale("log")
    plotting.label_axes(ax, ("frequency", "rad/s"), ("singular values", "N m/rad"))
    plotting.legend_below(fig, ax, columns=4)
    return fig, curves


def gamma_lambda(synthesis: Any) -> tuple[Any, dict[str, Any]]:
    """E: least gamma of P1 over lambda."""
    gammas = dict(synthesis["nominal"]["gamma"])
    rigid = float(gammas.pop("rigid"))
    lam = np.array(sorted(float(name) for name in gammas))
    values = np.array([float(gammas[f"{x:g}"]) for x in lam])
    fig, ax = plotting.subplots(height=58)
    ax.plot(lam, values, marker="o", label="all controllers, (12)", **plotting.SERIES[0].line)
    ax.axhline(rigid, label="without the inertia channel", **plotting.SERIES[1].line)
    ax.set_xscale("log")
    ax.set_xticks([0.7, 1, 2, 5, 10], ["0.7", "1", "2", "5", "10"])
    ax.minorticks_off()
    plotting.label_axes(ax, (r"$\lambda$", "1"), (r"least $\gamma$", "rad/(N m)"))
    plotting.legend_below(fig, ax, columns=2)
    return fig, {"all controllers": (lam, values), "without the inertia channel": (lam, np.full(len(lam), rigid))}
