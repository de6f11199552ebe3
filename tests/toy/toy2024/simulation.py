"""Free decay."""


def decay(model, synthesis):
    import numpy as np

    pole = float(model["a"] - synthesis["gain"]["k"])
    t = np.linspace(0.0, 5.0, 301)
    return {"pole": pole}, {"t": t, "x": np.exp(pole * t)}
