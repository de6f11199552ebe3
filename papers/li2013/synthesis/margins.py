"""What (21) can tell apart: largest margins of the printed, derived and singly faulty blocks for four gains."""

from __future__ import annotations

from typing import Any

from .. import conditions as c
from ..sweeps import margin

GAINS = ("K_bar", "zero", "minus", "minus10")
BLOCKS = {"derived": c.DERIVED, "printed": c.PRINTED}


def margins(data: Any) -> dict[str, Any]:
    """table: blocks -> orbit -> alpha -> gain -> margin; faults: fault -> gain -> margin (w-print, alpha = 0.02);
    elsewhere: printed blocks for the gain 0 and -K_bar at (h, alpha) = (50, 0.02) and (0.5, 5).
    """
    table = {
        blocks: {
            orbit: {
                alpha: {g: margin(data, f"units=si gain={g} alpha={alpha}", orbit, faults).value for g in GAINS}
                for alpha in (("0.02", "0") if blocks == "derived" else ("0.02",))
            }
            for orbit in ("w-print", "w-geo")
        }
        for blocks, faults in BLOCKS.items()
    }
    single = {
        fault: {g: margin(data, f"units=si gain={g}", "w-print", fault).value for g in GAINS[:3]} for fault in c.FAULTS
    }
    far = {
        name: {g: margin(data, f"units=si gain={g} {where}", "w-print", c.PRINTED).value for g in GAINS[:3]}
        for name, where in (("h=50", "h=50"), ("alpha=5", "alpha=5"))
    }
    return {"table": table, "faults": single, "elsewhere": far}
