"""The pitch axis: is it the small plant pole that makes the reduced order slow?"""

from __future__ import annotations

from typing import Any

from recontrol.claims.values import Result, Statement
from recontrol.exact.ball import precision
from recontrol.exact.polynomial import PRECISION

AXIS = "pitch-tf"


def s3_reason(synthesis: Any) -> Result:
    """If the small plant pole is the reason, the difficulty stays when y is measured, for the pole is the same.

    The difficulty is an unstable compensator with a huge gain; the margins are the pole of the corrected compensator
    and twice the part of the gain that is kept, less one.
    """
    balls = synthesis["gains"][AXIS]["balls"]
    x1, corrected = balls["x1"]["exact"], balls["corrected"]
    with precision(PRECISION):
        kept = abs(corrected["L"][0, 0]) / abs(x1["L"][0, 0])
        margins = {
            "compensator pole, y measured": corrected["A"][0, 0],
            "twice the part of L_r that is kept, less 1": kept * 2 - 1,
        }
    evidence = {
        "compensator pole, x1 measured": x1["A"][0, 0],
        "L_r, x1 measured": x1["L"][0, 0],
        "L_r, y measured": corrected["L"][0, 0],
    }
    return Result(Statement(margins), evidence=evidence)
