"""Statements about simulated responses: sections 2.2, 3, 4 and the abstract.

The values come from exact stepping with settling times refined to 1e-9 s; the error bounds below also cover what two
independent integrators differ by.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from recontrol.claims.values import Approx, Result, Statement

from ..simulation.designs import AXES, LIKE_FOR_LIKE, PATTERN, TIE

TIME_ERROR = 1e-5
OVERSHOOT_ERROR = 1e-4
MEDIAN_ERROR = 0.04
NEVER = 1e6


def seconds(value: Any) -> float:
    """A settling time; one that never comes is a million."""
    return NEVER if value == "infinite" else float(value)


def s22_best(simulation: Any, case: str) -> Result:
    """What q = 1 loses against the best of 41 weights in 0.1..10: zero for the best, in settling time and overshoot."""
    best = simulation["sweep"]["values"]["axes"][case]["best"]
    margins = {
        "settling time of the best less that of q = 1": Approx(-best["settling"]["gain"], TIME_ERROR),
        "overshoot of the best less that of q = 1": Approx(-best["overshoot"]["gain"], OVERSHOOT_ERROR),
    }
    return Result(Statement(margins, strict=False), evidence={"best": best})


def _pattern_margin(table: Any, full: str, reduced: str) -> Approx:
    """Smallest of the three differences that the pattern wants positive, less the tie."""
    differences = [
        (1 if word == "faster" else -1)
        * (seconds(table[axis][full]["settling"]["2"]) - seconds(table[axis][reduced]["settling"]["2"]))
        for axis, word in PATTERN.items()
    ]
    return Approx(min(differences) - TIE, TIE / 2)


def s3_pattern(simulation: Any) -> Result:
    """Like-for-like pairs of experiment 1 at the 2 % band; the counts over all 45 pairs are the evidence."""
    values = simulation["steps"]["values"]
    margins = {
        f"{name}: worst axis [s]": _pattern_margin(values["metrics"], full, reduced)
        for name, (full, reduced) in LIKE_FOR_LIKE.items()
    }
    evidence = {
        f"{band} % band": {"pairs with the pattern": found["pattern_count"], "outcomes": found["counts"]}
        for band, found in values["pairs"].items()
    }
    outcomes = {
        name: {axis: values["pairs"]["2"]["pairs"][f"{full} | {reduced}"][axis] for axis in AXES}
        for name, (full, reduced) in LIKE_FOR_LIKE.items()
    }
    return Result(Statement.any_of(margins), evidence={**evidence, "like for like, 2 %": outcomes})


def abs_track(simulation: Any, case: str) -> Result:
    """Final values of y for a unit step in the readings S, B, C of full order, corrected and x1 design."""
    metrics = simulation["steps"]["values"]["metrics"][case]
    names = ("full-S", "full-B", "full-C", "corrected-S", "corrected-B", "corrected-C", "x1-B", "x1-C")
    finals = np.array([[metrics[name]["final"] for name in names]], dtype=float)
    return Result(Approx(finals, 1e-9), evidence={"readings": list(names)})


def abs_zero(simulation: Any, case: str) -> Result:
    """Median settling time of full order less that of the corrected design, and the fraction of states won."""
    found = simulation["regulator"]["values"]["axes"][case]
    margins = {
        "median settling time saved": Approx(
            seconds(found["full"]["median_settling"]) - seconds(found["corrected"]["median_settling"]), MEDIAN_ERROR
        ),
        "fraction of states less a half": Approx(found["corrected"]["fraction_settles_first"] - 0.5, 1 / 400),
    }
    shown = {name: found[name] for name in ("full", "corrected", "x1", "state-feedback")}
    return Result(Statement(margins), evidence=shown)
