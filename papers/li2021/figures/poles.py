"""Fig. 3: poles of the open and the closed loop."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting
from recontrol.systems.output_feedback import drifted
from recontrol.systems.vertices import sign_vertices

from ..loops import rigid_loops
from ..plant import controller, float_controller, floats, plant


def fig3(data: Any, synthesis: Any) -> tuple[Any, dict[str, Any]]:
    """Rigid poles, disk, vertex cloud, modes outside; inset at the origin."""
    analysis = synthesis["analysis"]
    loop, opened = analysis["loops"]["proposed"], np.asarray(analysis["open"]["rigid"])
    gains = drifted(float_controller(controller(data, "proposed")), data.float("drift_bound") * sign_vertices(12))
    cloud = np.linalg.eigvals(rigid_loops(floats(plant(data)), gains)).ravel()
    cloud = cloud[::7]  # a seventh of the 49152 poles shows the same cloud
    a, b = data.float("disk_a"), data.float("disk_b")
    poles, modes = np.asarray(loop["poles"]), np.asarray(loop["flexible-poles"])
    fig, ax = plotting.subplots(height=76)
    circle = -a + b * np.exp(1j * np.linspace(0, 2 * np.pi, 241))
    ax.plot(circle.real, circle.imag, color=plotting.GREY, linewidth=0.8, label="D(1.01, 1)")
    ax.plot(
        cloud.real, cloud.imag, linestyle="none", marker=".", markersize=1.0, color=plotting.PALE, rasterized=True,
        label="5 % gain drift, vertices",
    )  # fmt: skip
    ax.plot(poles.real, poles.imag, label="closed loop, rigid", **plotting.SERIES[0].points)
    ax.plot(modes.real, modes.imag, label="closed loop with modes", **plotting.SERIES[1].points)
    ax.plot(opened.real, opened.imag, label="open loop", **plotting.SERIES[2].points)
    ax.set_aspect("equal")
    ax.set_xlim(-2.15, 0.75)
    ax.set_ylim(-1.15, 1.15)
    plotting.label_axes(ax, ("real part", "1/s"), ("imaginary part", "1/s"))
    inset = ax.inset_axes([0.8, 0.7, 0.2, 0.3])
    inset.plot(1e5 * opened.real, 1e5 * opened.imag, **plotting.SERIES[2].points)
    inset.axvline(0, color=plotting.GREY, linewidth=0.5)
    inset.set_title(r"$\times 10^{-5}$", fontsize=5.5)
    inset.tick_params(labelsize=5)
    plotting.legend_below(fig, ax, columns=2)
    sort = [v[np.lexsort((v.imag.round(9), v.real.round(9)))] for v in (poles, modes, opened)]
    names = ("closed loop, rigid", "closed loop with modes", "open loop")
    return fig, {name: (v.real, v.imag) for name, v in zip(names, sort, strict=True)}
