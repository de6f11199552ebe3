"""Figures of what was found: settling, the printed rho, effort against norm, conservatism, Floquet, H-infinity
excess."""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol import plotting

from .. import plant

NORM_UNIT = r"rad/(N m s$^{1/2}$)"
Curves = dict[str, tuple[np.ndarray, np.ndarray]]
EXT, TRAD, EXT_DK, TRAD_DK = (plotting.SERIES[k] for k in range(4))
RUNS = {
    "ext": ("$K_{ext}$", EXT),
    "trad": ("$K_{trad}$", TRAD),
    "ext-N-printed": (r"$K_{ext}$ with $\Delta K$", EXT_DK),
    "trad-N-printed": (r"$K_{trad}$ with $\Delta K$", TRAD_DK),
}


def settling(data: Any, simulation: Any) -> tuple[Any, Curves]:
    """Largest angle of the four linear runs, the thresholds, and the two times that the paper names."""
    fig, ax = plotting.subplots(height=78)
    series, curves = simulation["linear"]["series"], {}
    for run, (words, style) in RUNS.items():
        t, y = series[f"{run}.t_all"], np.maximum(series[f"{run}.largest"], 1e-9)
        ax.semilogy(t, y, label=words, **style.line)
        curves[words] = (t, y)
    initial = np.abs(data.float("x0")[0, :3]).max()
    for percent in (5, 2, 1, 0.1):
        level = percent / 100 * initial
        ax.axhline(level, color=plotting.PALE, linewidth=0.6, zorder=0.8)
        ax.annotate(
            f"{percent:g} %", (600, level), xytext=(1, 0), textcoords="offset points", va="center", fontsize=5.5
        )
    for time in (float(data[name]) for name in ("max_time_ext", "max_time_trad")):
        ax.axvline(time, color=plotting.GREY, linewidth=0.6, linestyle=(0, (1, 2)))
        ax.annotate(f"{time:g} s", (time, 2e-6), xytext=(2, 0), textcoords="offset points", fontsize=6)
    ax.set_ylim(1e-6, 1e3)
    ax.set_xlim(0, 600)
    plotting.label_axes(ax, ("time", "s"), ("largest angle", "rad"))
    plotting.legend_below(fig, ax, columns=2)
    return fig, curves


def _middle(balls: Any) -> np.ndarray:
    return np.array([float(b) for b in balls])


KINDS = {
    "trad": ("(8), (9), one $X$", plotting.SERIES[0]),
    "std": ("same, $-I$ and $-\\gamma^2 I$", plotting.SERIES[2]),
    "prt": ("Theorem 2 as printed", plotting.SERIES[1]),
}


def rho_gamma(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Least rho at the published gains over gamma_inf against the squared H2 norm: Theorem 2 falls below it."""
    fig, axes = plotting.subplots(1, 2, width=plotting.PAGE, height=72, sharey=True)
    curves: Curves = {}
    for ax, gain in zip(axes, ("ext", "trad"), strict=True):
        found = synthesis["fixed-gain"][gain]
        excess = (found["levels"] - 1) * float(data["z_weight"])
        for kind, (words, style) in KINDS.items():
            rho = _middle(found[kind]["rho"])
            ax.loglog(excess, rho, label=words, marker=style.marker, markersize=3, **style.line)
            curves[f"{gain}: {kind}"] = (excess, rho)
        squared = float(found["h2_squared"])
        ax.axhline(squared, label="squared H2 norm", **plotting.SERIES[3].line)
        curves[f"{gain}: h2^2"] = (excess, np.full_like(excess, squared))
        plotting.label_axes(ax, (r"$\gamma_\infty - 10^{-3}$", "1"))
    plotting.label_axes(axes[0], y=(r"$\rho$", r"rad$^2$/(N m)$^2$/s"))
    plotting.letter_panels(axes, ["$K_{ext}$", "$K_{trad}$"])
    plotting.legend_below(fig, axes, columns=4)
    return fig, curves


def pareto(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """H2 norm over effort: closed-form limit, proven optima, published gains, non-fragile designs."""
    fig, ax = plotting.subplots(height=72)
    effort = np.geomspace(0.2, 1.6, 80)
    limit = float(plant.pareto_constant(data)) / effort**3
    ax.loglog(effort, limit, label="least, decoupled axes", color=plotting.BLACK, linestyle="-", linewidth=0.8)
    curves: Curves = {"least": (effort, limit)}
    norms = synthesis["norms"][plant.DEFAULT]
    designs = {n: d for n, d in synthesis["nonfragile"]["designs"].items() if d["certified"] is not None}
    groups = {
        "published": [(norms[g]["effort"], norms[g]["h2"]) for g in plant.GAINS],
        "proven optimum": [(synthesis["h2-effort"][g]["effort"], synthesis["h2-effort"][g]["h2"]) for g in plant.GAINS],
        "non-fragile": [(d["effort"], d["h2"]) for d in designs.values()],
    }
    for k, (name, points) in enumerate(groups.items()):
        x, y = (np.array([float(p[i]) for p in points]) for i in (0, 1))
        style = plotting.SERIES[k].points | ({"markersize": 6.0} if k == 0 else {})
        ax.plot(x, y, label=name, **style)
        curves[name] = (x, y)
    for gain, (dx, dy) in {"ext": (5, 4), "trad": (6, 3)}.items():
        place = (float(norms[gain]["effort"]), float(norms[gain]["h2"]))
        ax.annotate(f"$K_{{{gain}}}$", place, xytext=(dx, dy), textcoords="offset points", fontsize=6.5)
    ax.set_xticks([0.2, 0.3, 0.5, 0.7, 1, 1.5], ["0.2", "0.3", "0.5", "0.7", "1", "1.5"])
    ax.minorticks_off()
    plotting.label_axes(ax, ("effort, H2 norm to $u$", r"s$^{-1/2}$"), ("H2 norm to $z_2$", NORM_UNIT))
    plotting.legend_below(fig, ax, columns=2)
    return fig, curves


def conservatism(data: Any, synthesis: Any) -> tuple[Any, Curves]:
    """Certified and true gamma2 at the effort of K_ext over the level gamma_inf."""
    fig, ax = plotting.subplots(height=72)
    curves: Curves = {}
    tables = {
        "one $X$": synthesis["single"]["std"],
        "two $X$ and a slack": synthesis["dilated"]["levels"],
    }
    for k, (name, table) in enumerate(tables.items()):
        excess = np.array([float(g) - 1 for g in table]) * float(data["z_weight"])
        style = plotting.SERIES[k]
        for what, key, line in (("certified", "certified", style.linestyle), ("true", "h2", "none")):
            values = np.array([float(found[key]) for found in table.values()])
            look = {"color": style.color, "marker": style.marker, "markersize": 4, "linestyle": line}
            look |= {"markerfacecolor": "white"} if what == "true" else {}
            ax.semilogx(excess, values, label=f"{name}, {what}", **look)
            curves[f"{name}, {what}"] = (excess, values)
    floor = float(synthesis["h2-effort"]["ext"]["h2_lower"])
    ax.axhline(floor, color=plotting.BLACK, linewidth=0.8, label="least possible")
    curves["least possible"] = (excess, np.full_like(excess, floor))
    plotting.label_axes(ax, (r"$\gamma_\infty - 10^{-3}$", "1"), ("H2 norm to $z_2$", NORM_UNIT))
    plotting.legend_below(fig, ax, columns=2)
    return fig, curves


def floquet(synthesis: Any) -> tuple[Any, Curves]:
    """Multipliers in the plane, and the largest over the amplitude of Delta K (1 is the print)."""
    fig, axes = plotting.subplots(1, 2, width=plotting.PAGE, height=76)
    curves: Curves = {}
    plane, amplitude = axes
    angle = np.linspace(0, 2 * np.pi, 181)
    plane.plot(np.cos(angle), np.sin(angle), color=plotting.BLACK, linewidth=0.7)
    for gain, style in (("ext", EXT), ("trad", TRAD)):
        words = f"$K_{{{gain}}}$"
        found = synthesis["floquet"]["enclosed"][gain][plant.DEFAULT]["N-printed"]
        mu = np.array([complex(m) for m in found["multipliers"]])
        mu = mu[np.lexsort((mu.imag, mu.real))]
        plane.plot(mu.real, mu.imag, label=words, **(style.points | {"markersize": 7.0 if gain == "ext" else 4.0}))
        curves[f"multipliers {gain}"] = (mu.real, mu.imag)
        scan = synthesis["floquet"]["scans"][gain]["N-printed"]
        a, radius = np.asarray(scan["amplitude"]), np.asarray(scan["radius"])
        amplitude.loglog(a[1:], radius[1:], label=words, **style.line)
        curves[f"amplitude {gain}"] = (a, radius)
        if scan["threshold"] is not None:
            amplitude.plot([scan["threshold"]], [1.0], zorder=4, **(style.points | {"markersize": 5}))
    plane.set_aspect("equal", adjustable="datalim")
    plotting.label_axes(plane, (r"Re $\mu$", "1"), (r"Im $\mu$", "1"))
    amplitude.axhline(1.0, color=plotting.BLACK, linewidth=0.7)
    amplitude.axvline(1.0, color=plotting.GREY, linewidth=0.6, linestyle=(0, (1, 2)))
    amplitude.annotate("print", (1.0, 1e-3), xytext=(2, 0), textcoords="offset points", fontsize=6)
    plotting.label_axes(amplitude, (r"amplitude of $\Delta K$ over the print", "1"), (r"largest $|\mu|$", "1"))
    plotting.letter_panels(axes, ["multipliers, printed $\\Delta K$", "largest multiplier"])
    plotting.legend_below(fig, axes, columns=2)
    return fig, curves


def resonance(synthesis: Any) -> tuple[Any, Curves]:
    """Where K_trad is unstable over frequency and amplitude of Delta K; curves: exponent along amplitude 1 and along
    frequency 1."""
    fig, ax = plotting.subplots(height=76)
    chart = synthesis["floquet"]["chart"]
    factor, amplitude, exponent = (np.asarray(chart[name]) for name in ("factor", "amplitude", "exponent"))
    filled = ax.contourf(
        factor, amplitude, exponent.T, levels=[0, 0.01, 0.02, 0.03], cmap="Greys", vmin=-0.01, vmax=0.06, extend="max"
    )
    ax.contour(factor, amplitude, exponent.T, levels=[0], colors=plotting.BLUE, linewidths=1.1)
    ax.contour(factor, amplitude, exponent.T, levels=[0.01, 0.02, 0.03], colors="#333333", linewidths=0.3)
    ax.plot([1.0], [1.0], **(TRAD.points | {"markersize": 5}))
    ax.annotate("print", (1, 1), xytext=(4, 3), textcoords="offset points", fontsize=6.5)
    fig.colorbar(filled, ax=ax, label="growth rate (1/s)", pad=0.01)
    ax.set_xscale("log")
    ax.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2, 5], ["0.05", "0.1", "0.2", "0.5", "1", "2", "5"])
    ax.minorticks_off()
    plotting.label_axes(ax, ("frequency of $F$ over the print", "1"), (r"amplitude of $\Delta K$ over the print", "1"))
    at_amplitude = exponent[:, int(np.argmin(np.abs(amplitude - 1.0)))]
    at_frequency = exponent[int(np.argmin(np.abs(factor - 1.0)))]
    return fig, {"amplitude 1": (factor, at_amplitude), "frequency 1": (amplitude, at_frequency)}


def hinf(data: Any) -> tuple[Any, Curves]:
    """Largest singular value of the response from d to z_inf, less 1e-3: the peak sits far above the bandwidth."""
    fig, ax = plotting.subplots(height=70)
    frequency = np.geomspace(1e-3, 1e5, 481)
    curves: Curves = {}
    for gain, style in (("ext", EXT), ("trad", TRAD)):
        excess = _excess(data, gain, frequency)
        ax.plot(frequency, excess, label=f"$K_{{{gain}}}$", **style.line)
        curves[gain] = (frequency, excess)
    ax.set_xscale("log")
    ax.set_yscale("symlog", linthresh=1e-13, linscale=0.6)
    ax.set_yticks([-1e-3, -1e-6, -1e-9, -1e-12, 0, 1e-12, 1e-9, 1e-6])
    ax.axhline(0, color=plotting.BLACK, linewidth=0.6)
    plotting.label_axes(ax, ("frequency", "rad/s"), (r"$\sigma_{max}(G_{z_\infty d}) - 10^{-3}$", "1"))
    plotting.legend_below(fig, ax, columns=2)
    return fig, curves


def _excess(data: Any, gain: str, frequency: np.ndarray) -> np.ndarray:
    """sigma_max - 1e-3 without cancellation: largest eigenvalue of G*G - I for G = I + R, that is of R + R* + R*R."""
    si = plant.float_plant(data)
    K = si[plant.GAINS[gain]]
    loop, V = si["A"] + si["B1"] @ K, K + si["low"]
    out = np.empty_like(frequency)
    for k, w in enumerate(frequency):
        R = V @ np.linalg.solve(1j * w * np.eye(6) - loop, si["B2"])
        top = np.linalg.eigvalsh(R + R.conj().T + R.conj().T @ R)[-1]
        out[k] = float(data["z_weight"]) * top / (1 + np.sqrt(1 + top))
    return out
