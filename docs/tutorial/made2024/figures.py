"""Fig. 1 redrawn."""


def impulse(simulation):
    """Position and control over time."""
    from recontrol import plotting

    series = simulation["impulse"]["series"]
    figure, axes = plotting.subplots()
    curves = {"position": (series["t"], series["y"]), "control": (series["t"], series["u"])}
    for style, (label, (t, x)) in zip(plotting.SERIES, curves.items(), strict=False):
        axes.plot(t, x, label=label, **style.line)
    axes.legend()
    plotting.label_axes(axes, ("time", "s"), ("response", "1"))
    return figure, curves
