"""Impulse response of the loop with the mended controller."""

from .conditions import loop


def impulse(data):
    """Position and control after a unit impulse of the disturbance, by the matrix exponential."""
    import numpy as np

    from recontrol.exact.rational import to_float
    from recontrol.simulate.linear import propagate

    M = to_float(loop(data, data["A_k_mended"]))
    states = propagate(M, np.array([0.0, 1.0, 0.0, 0.0]), 0.05, 301)
    t = 0.05 * np.arange(301)
    y, u = states[:, 0], states[:, 2:] @ np.ravel(data.float("C_k"))
    late = float(np.abs(y[t >= 10.0]).max() / np.abs(y).max())
    return {"late share of the peak": late}, {"t": t, "y": y, "u": u}
