"""Solver runs by topic: points for the certificates, margins, optimal values, largest periods, gains, bounds."""

from .gamma import gamma
from .initial import initial
from .inputs import inputs
from .margins import margins
from .periods import periods
from .points import points
from .resynthesis import resynthesis

__all__ = ["gamma", "initial", "inputs", "margins", "periods", "points", "resynthesis"]
