"""From the problem statement to gains and bounds; each part stands alone and runs in parallel with the others."""

from .bounds import other_gains, repaired
from .gains import CO, SF, fixed, variants
from .infeasible import P38, multipliers
from .observers import placement
from .readout import arrangements, digits, intervals, joint
from .tools import units_matter

__all__ = [
    "CO",
    "P38",
    "SF",
    "arrangements",
    "digits",
    "fixed",
    "intervals",
    "joint",
    "multipliers",
    "other_gains",
    "placement",
    "repaired",
    "units_matter",
    "variants",
]
