"""The plant, exactly as printed."""

NAMES = ("A", "B1", "B2", "C1", "D12", "C2", "D21")


def model(data):
    """Matrices of (1) to (3)."""
    return {name: data[name] for name in NAMES}
