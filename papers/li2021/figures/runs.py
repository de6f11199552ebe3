"""Figs 4 to 9: histories of the runs."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

Array = np.ndarray
AXES = ("roll", "pitch", "yaw")
LOST = 0.3  # rad; a run that got there has diverged and is drawn no further
THIN = 10  # every tenth sample (0.1 s) is drawn


def _base(simulation: Any, what: str, case: str = "base") -> tuple[Array, Array]:
    series = simulation["attitude"]["series"]
    return np.asarray(series["time"])[::THIN], np.asarray(series[f"{case}/{what}"])[::THIN]


def _lines(ax: Any, t: Array, values: Array, names: tuple[str, ...]) -> None:
    for k, name in enumerate(names):
        ax.plot(t, values[:, k], label=name, **plotting.SERIES[k].line)


def _curves(t: Array, values: Array, names: tuple[str, ...]) -> dict[str, Any]:
    return {name: (t, values[:, k]) for k, name in enumerate(names)}


def fig4(simulation: Any) -> tuple[Any, dict[str, Any]]:
    """Angles, and the offset in the last hundred seconds."""
    t, angles = _base(simulation, "angles")
    offset = np.asarray(simulation["attitude"]["values"]["offset"]["proposed"])
    fig, (ax, late) = plotting.subplots(2, 1, height=86, height_ratios=[3, 2])
    _lines(ax, t, angles, AXES)
    plotting.label_axes(ax, ("time", "s"), ("angle", "rad"))
    tail = t >= 100
    _lines(late, t[tail], 1e3 * angles[tail], AXES)
    for k, value in enumerate(offset):
        late.axhline(1e3 * value, color=plotting.SERIES[k].color, linewidth=0.5, linestyle=":")
    plotting.label_axes(late, ("time", "s"), ("angle", "mrad"))
    plotting.letter_panels([ax, late], ["whole run", "last 100 s; dotted: predicted offset"])
    plotting.legend_below(fig, ax)
    return fig, _curves(t, angles, AXES)


def fig5(simulation: Any) -> tuple[Any, dict[str, Any]]:
    """Angle rates."""
    t, rates = _base(simulation, "rates")
    fig, ax = plotting.subplots(height=58)
    _lines(ax, t, 1e3 * rates, AXES)
    plotting.label_axes(ax, ("time", "s"), ("angle rate", "mrad/s"))
    plotting.legend_below(fig, ax)
    return fig, _curves(t, rates, AXES)


def fig6(simulation: Any, data: Any) -> tuple[Any, dict[str, Any]]:
    """Torque, its bound, and the first five seconds."""
    series = simulation["attitude"]["series"]
    t, torque = np.asarray(series["time"]), np.asarray(series["base/torque"])
    norm = np.linalg.norm(torque, axis=1)
    names = (*AXES, "norm")
    values = np.column_stack([torque, norm])
    fig, (ax, start) = plotting.subplots(1, 2, width=plotting.PAGE, height=62, width_ratios=[3, 2])
    for panel, part, thin in ((ax, t <= 200, THIN), (start, t <= 5, 1)):
        for k, name in enumerate(names):
            panel.plot(t[part][::thin], values[part, k][::thin], label=name, **plotting.SERIES[k].line)
    ax.axhline(data.float("u_max"), color=plotting.GREY, linewidth=0.8)
    ax.text(200, data.float("u_max"), "bound of 2 N m", ha="right", va="bottom", fontsize=6, color=plotting.GREY)
    for panel in (ax, start):
        plotting.label_axes(panel, ("time", "s"), ("torque", "N m"))
    plotting.letter_panels([ax, start], ["whole run", "first 5 s"])
    plotting.legend_below(fig, ax, columns=4)
    return fig, {name: (t[::THIN], values[::THIN, k]) for k, name in enumerate(names)}


def _envelope(values: Array, half: int = 45) -> Array:
    """Largest modulus within 4.5 s on either side, a little over one period of a mode."""
    padded = np.pad(np.abs(values), half, mode="edge")
    return np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1).max(axis=1)


def fig7(simulation: Any, synthesis: Any) -> tuple[Any, dict[str, Any]]:
    """Modes with and without control, and the decay of the slowest."""
    t, modes = _base(simulation, "modes")
    _, free = _base(simulation, "modes", "control-off")
    names = tuple(f"mode {k}" for k in range(1, 5))
    fig, axes = plotting.subplots(2, 1, height=104, sharex=True)
    rates = {
        "closed-loop decay": -complex(synthesis["analysis"]["loops"]["proposed"]["mode"]).real,
        "open-loop decay": -complex(synthesis["analysis"]["open"]["mode"]).real,
    }
    for ax, values in zip(axes, (modes, free), strict=True):
        for k, name in enumerate(names):
            ax.plot(t, _envelope(values[:, k]), label=name, **plotting.SERIES[k].line)
        ax.set_yscale("log")
        ax.set_ylim(2e-5, 0.1)
    peak = np.abs(modes).max()
    for (name, rate), style in zip(rates.items(), ("-", "--"), strict=True):
        axes[0].plot(t, peak * np.exp(-rate * t), color=plotting.GREY, linewidth=1.0, linestyle=style, label=name)
    for ax in axes:
        ax.set_ylabel(plotting.axis_label("modal amplitude", r"kg$^{1/2}$ m"))
    plotting.label_axes(axes[1], ("time", "s"))
    plotting.letter_panels(axes, ["with the printed controller", "without control"])
    plotting.legend_below(fig, axes, columns=3)
    return fig, _curves(t, modes, names) | {f"{n}, no control": (t, free[:, k]) for k, n in enumerate(names)}


def _random(simulation: Any, hold: str) -> tuple[Any, dict[str, Any]]:
    series = simulation["draws"]["series"]
    t = np.asarray(series["time"])
    fig, axes = plotting.subplots(1, 2, width=plotting.PAGE, height=62, sharey=True)
    curves = {}
    for ax, name in zip(axes, ("proposed", "ref39"), strict=True):
        angles = np.asarray(series[f"{name}/{hold}"])
        gone = np.flatnonzero(np.abs(angles).max(axis=1) > LOST)
        kept = slice(0, gone[0] + 1 if gone.size else len(t))
        _lines(ax, t[kept], angles[kept], AXES)
        if gone.size:
            ax.text(t[gone[0]] + 3, 0.1, f"diverged at {t[gone[0]]:.0f} s", fontsize=6, va="center")
        ax.set_xlim(0, t[-1])
        curves |= {f"{name}, {axis}": (t[kept], angles[kept, k]) for k, axis in enumerate(AXES)}
        plotting.label_axes(ax, ("time", "s"), ("angle", "rad") if name == "proposed" else None)
        ax.set_ylim(-0.12, 0.12)
    plotting.letter_panels(axes, ["proposed gains", "gains of [39]"])
    plotting.legend_below(fig, axes)
    return fig, curves


def fig8(simulation: Any) -> tuple[Any, dict[str, Any]]:
    """Random gains held for 0.1 s."""
    return _random(simulation, "0.1")


def fig9(simulation: Any) -> tuple[Any, dict[str, Any]]:
    """Random gains held for 10 s."""
    return _random(simulation, "10")
