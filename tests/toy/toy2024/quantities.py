"""One number."""


def quantities(model, synthesis):
    return {"time_constant": 1 / (synthesis["gain"]["k"] - model["a"])}
