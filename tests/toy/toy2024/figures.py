"""One curve."""


def decay(simulation):
    from recontrol import plotting

    series = simulation["decay"]["series"]
    figure, axes = plotting.subplots()
    axes.plot(series["t"], series["x"])
    plotting.label_axes(axes, ("time", "s"), ("state", "1"))
    return figure, {"x": (series["t"], series["x"])}
