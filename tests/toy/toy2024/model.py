"""The plant."""


def model(data):
    return {"a": data["a"]}
