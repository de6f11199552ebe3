"""Plants around the printed one."""


def poles(rng, count, model, synthesis):
    import numpy as np

    factor = rng.uniform(0.9, 1.1, count)
    return {"decay": np.full(count, float(synthesis["gain"]["k"])) - factor * float(model["a"])}


def poles_bounds(model, synthesis):
    from recontrol.campaign.proven import Bound

    return {"decay": Bound(float(synthesis["gain"]["k"]) - 1.1 * float(model["a"]), "the end of the interval", "float")}
