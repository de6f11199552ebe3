"""What the synthesis needs and no earlier stage does."""

FACTOR = 5
