"""What is proven for every plant of the ensemble."""


def poles(model, synthesis):
    from recontrol.campaign.proven import Bound

    return {"decay": Bound(float(synthesis["gain"]["k"]) - 1.1 * float(model["a"]), "the end of the interval", "float")}
