"""Figures 1 to 12 redrawn: z_inf, z2 and u of both gains, without and with Delta K. The paper's axes are not known."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

Curves = dict[str, tuple[np.ndarray, np.ndarray]]

SIGNALS = {
    "z_inf": ("z_inf", slice(0, 3), r"output $z_\infty$", "N m"),
    "z2": ("x", slice(0, 3), "angle $z_2$", "rad"),
    "u": ("u", slice(0, 3), "control torque $u$", "N m"),
}
"""Figure -> array of the run, its columns, quantity and unit."""

AXES = ("x (roll)", "y (pitch)", "z (yaw)")


def _figure(simulation: Any, run: str, signal: str, inset: float | None = None) -> tuple[Any, Curves]:
    array, columns, quantity, unit = SIGNALS[signal]
    series = simulation["linear"]["series"]
    t, values = series[f"{run}.t"], series[f"{run}.{array}"][:, columns]
    fig, ax = plotting.subplots(height=62)
    curves: Curves = {}
    for k, name in enumerate(AXES):
        ax.plot(t, values[:, k], label=name, **plotting.SERIES[k].line)
        curves[name] = (t, values[:, k])
    plotting.label_axes(ax, ("time", "s"), (quantity, unit))
    ax.set_xlim(t[0], t[-1])
    if inset is not None:
        _growth(ax, t, values, inset)
    plotting.legend_below(fig, ax)
    return fig, curves


def _growth(ax: Any, t: np.ndarray, values: np.ndarray, bottom: float) -> None:
    """Inset from ``bottom`` (fraction of the axes) up: the largest of the three magnitudes on a logarithmic scale."""
    inner = ax.inset_axes((0.16, bottom, 0.4, 0.34))
    inner.semilogy(t, np.abs(values).max(axis=1), color=plotting.GREY, linewidth=0.8)
    inner.set_title("largest magnitude, log", fontsize=5.5)
    inner.tick_params(labelsize=5)
    inner.set_xlim(t[0], t[-1])


def fig1(simulation: Any) -> tuple[Any, Curves]:
    """z_inf, K_ext."""
    return _figure(simulation, "ext", "z_inf")


def fig2(simulation: Any) -> tuple[Any, Curves]:
    """z2, K_ext."""
    return _figure(simulation, "ext", "z2")


def fig3(simulation: Any) -> tuple[Any, Curves]:
    """u, K_ext."""
    return _figure(simulation, "ext", "u")


def fig4(simulation: Any) -> tuple[Any, Curves]:
    """z_inf, K_trad."""
    return _figure(simulation, "trad", "z_inf")


def fig5(simulation: Any) -> tuple[Any, Curves]:
    """z2, K_trad."""
    return _figure(simulation, "trad", "z2")


def fig6(simulation: Any) -> tuple[Any, Curves]:
    """u, K_trad."""
    return _figure(simulation, "trad", "u")


def fig7(simulation: Any) -> tuple[Any, Curves]:
    """z_inf, K_trad with Delta K."""
    return _figure(simulation, "trad-N-printed", "z_inf", inset=0.58)


def fig8(simulation: Any) -> tuple[Any, Curves]:
    """z2, K_trad with Delta K."""
    return _figure(simulation, "trad-N-printed", "z2", inset=0.14)


def fig9(simulation: Any) -> tuple[Any, Curves]:
    """u, K_trad with Delta K."""
    return _figure(simulation, "trad-N-printed", "u", inset=0.58)


def fig10(simulation: Any) -> tuple[Any, Curves]:
    """z_inf, K_ext with Delta K."""
    return _figure(simulation, "ext-N-printed", "z_inf")


def fig11(simulation: Any) -> tuple[Any, Curves]:
    """z2, K_ext with Delta K."""
    return _figure(simulation, "ext-N-printed", "z2")


def fig12(simulation: Any) -> tuple[Any, Curves]:
    """u, K_ext with Delta K."""
    return _figure(simulation, "ext-N-printed", "u")
