"""References and names that the text gives to equations, blocks and sources.

What a citation means is a reading of the text: paper.yaml holds both sides with their places.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import fmpq

from recontrol.claims.identity import equal
from recontrol.claims.values import Identity, Result

from .formulas import eq16
from .support import UNUSED, used

BLOCKS = ("A11", "A12", "A21", "A22", "B1", "B2", "K1", "K2")
"""The data that (46) to (49) take."""


def eq16_ref(data: Any) -> Result:
    """Number of the equation into which (15) is said to be put, against that of the one which gives (16) with it."""
    derived = eq16()
    evidence = {"(15) in (4) gives (16)": equal(derived.left, derived.right), **used(UNUSED, "the system of (4)")}
    return Result(Identity(data["plant_cited"], data["plant_meant"]), evidence=evidence)


def s3_subst(data: Any) -> Result:
    """First and last number of the equations said to be put into (46) to (49), against the places of their data."""
    places = [int(data.entry(name).where.strip("()")) for name in BLOCKS]
    found = np.array([[fmpq(min(places)), fmpq(max(places))]], dtype=object)
    evidence = used("the right version", "(58) to (65) into (46) to (49)")
    return Result(Identity(data["blocks_cited"], found), evidence=evidence)


def s1_cite14(data: Any) -> Result:
    """The source cited for a full-order estimator in a space satellite, against the one whose title says so."""
    cited, meant = data["source_cited"], data["source_meant"]
    evidence = {f"title of [{data[name]}]": data.entry(name).what for name in ("source_cited", "source_meant")}
    return Result(Identity(cited, meant), evidence={**evidence, **used(UNUSED, f"[{meant}]")})
