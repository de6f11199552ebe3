"""Numbers beyond the claims."""

from .readings import enclosed_norm


def quantities(data):
    """The enclosed norm."""
    return {"norm": enclosed_norm(data).upper}
