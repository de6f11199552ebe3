"""Plants around the printed one."""


def poles(rng, count, model, synthesis):
    import numpy as np

    factor = rng.uniform(0.9, 1.1, count)
    return {"decay": np.full(count, float(synthesis["gain"]["k"])) - factor * float(model["a"])}
