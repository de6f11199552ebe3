"""References and names that the text gives to equations, blocks and sources."""

from __future__ import annotations

from typing import Any

from flint import fmpq

from recontrol.claims.values import Identity, Result

from ..recipe import plant_of
from .support import UNUSED, used

REFERENCES = {
    14: "Active Vibration Control of Satellite Panels using Piezoelectric Actuators and Sensors",
    15: "Design of Attitude Control System of a Space Satellite",
}
CITED = 14
PARTITION_PLACES = {"A11": 58, "A12": 59, "A21": 60, "A22": 61, "B1": 62, "B2": 63, "K1": 64, "K2": 65}
NAMED_RANGE = (28, 45)


def eq16_ref(model: Any) -> Result:
    """Scalar equations in (1) against those in (16): the state equation has n of them and is (4)."""
    plant = plant_of(model, "yaw")
    transfer_functions = fmpq(plant.C.shape[0] * plant.B.shape[1])
    evidence = used(UNUSED, "the system of (4)")
    return Result(Identity(transfer_functions, fmpq(plant.n)), evidence=evidence)


def s3_subst(data: Any) -> Result:
    """First and last place of the numbers that (46)-(49) take, against the range that the text names."""
    places = [place for name, place in PARTITION_PLACES.items() if name in data]
    right = (fmpq(min(places)), fmpq(max(places)))
    left = (fmpq(NAMED_RANGE[0]), fmpq(NAMED_RANGE[1]))
    return Result(Identity(left, right), evidence=used("the right version", "(58) to (65) into (46) to (49)"))


def s1_cite14() -> Result:
    """The source cited for a full-order estimator in a space satellite, against the one whose title says so."""
    subject = "Space Satellite"
    right = [number for number, title in REFERENCES.items() if subject in title]
    evidence = {"title of [14]": REFERENCES[14], "title of [15]": REFERENCES[15], **used(UNUSED, "[15]")}
    return Result(Identity((fmpq(CITED),), tuple(fmpq(k) for k in right)), evidence=evidence)
