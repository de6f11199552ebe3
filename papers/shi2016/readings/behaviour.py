"""What the loops do: stability over the rounding boxes, settling, norms, Delta K."""

from __future__ import annotations

from typing import Any

from recontrol.claims.proofs import proven
from recontrol.claims.values import Approx, Result, Statement

from .. import plant
from ..simulation.linear import HORIZON

RESOLUTION = 0.011
"""Error of a settling time [s]: one sample step of 0.01 s, and what 1e-10 rad of integration error may move it."""


def stable_ext(certificates: Any) -> Result:
    """One Lyapunov matrix for the whole box of K_ext and both Earth radii."""
    return proven(certificates, "hurwitz-ext")


def stable_trad(certificates: Any) -> Result:
    """The same for K_trad."""
    return proven(certificates, "hurwitz-trad")


def _settling(simulation: Any, run: str, case: str) -> Any:
    """Settling time [s] of a run; ``case`` is ``x0-2`` (2 % of the initial 0.1 rad) or ``peak-2`` (of the run's
    peak)."""
    reference, percent = case.split("-")
    found = simulation["linear"]["values"]["runs"][run]["of_x0" if reference == "x0" else "of_peak"]
    value = found[f"{float(percent) / 100:g}"]
    # A run that never settles within its horizon settles, if at all, later than that.
    return Approx(HORIZON if value == "never" else float(value), RESOLUTION)


def settling_ext(simulation: Any, case: str) -> Any:
    """Extended gain, no Delta K."""
    return _settling(simulation, "ext", case)


def settling_trad(data: Any, simulation: Any, case: str) -> Result:
    """Traditional gain, no Delta K; evidence: within 200 s or not."""
    value = _settling(simulation, "trad", case)
    within = value.value + value.error <= float(data["max_time_trad"])
    floor = simulation["linear"]["values"]["disturbance"]["trad"]["d-omega0"]["steady_amplitude"].max()
    return Result(value, {"within 200 s": bool(within), "steady angle under d [rad]": float(floor)})


def settling_perturbed(simulation: Any, case: str) -> Any:
    """Extended gain with Delta K; ``case`` ends in ``i`` for N-interleaved."""
    shape = "N-interleaved" if case.endswith("i") else "N-printed"
    return _settling(simulation, f"ext-{shape}", case.removesuffix("i"))


def settling_both(simulation: Any, case: str) -> Any:
    """The slowest of the three runs of the extended gain: no Delta K, N-printed, N-interleaved."""
    runs = ("ext", "ext-N-printed", "ext-N-interleaved")
    return max((_settling(simulation, run, case) for run in runs), key=lambda found: found.value)


def faster(model: Any, simulation: Any) -> Result:
    """Slowest pole of K_ext against that of K_trad (a fifth must not reach it), and settling at every fraction."""
    poles = model[plant.DEFAULT]["poles"]
    slowest = {gain: max(complex(p).real for p in poles[gain]) for gain in plant.GAINS}
    margins: dict[str, Any] = {
        "decay rate over 5 times the other": Approx(-slowest["ext"] + 5 * slowest["trad"], 1e-12)
    }
    evidence: dict[str, Any] = {f"spectral abscissa, K_{g} [1/s]": value for g, value in slowest.items()}
    for reference in ("x0", "peak"):
        for percent in ("5", "2", "1", "0.1"):
            case = f"{reference}-{percent}"
            ext, trad = _settling(simulation, "ext", case), _settling(simulation, "trad", case)
            margins[f"settling, {case}"] = Approx(trad.value / ext.value - 5, 0.02 * trad.value / ext.value)
            words = "ratio of settling times (a run that never settles counts with its horizon)"
            evidence[f"{words}, {case}"] = trad.value / ext.value
    return Result(Statement(margins), evidence)


def smaller_h2(synthesis: Any, simulation: Any) -> Result:
    """H2 norms over the rounding boxes, both Earth radii; evidence: energies of the runs, extremes over the
    vertices."""
    margins, evidence = {}, {}
    for case, found in synthesis["norms"].items():
        margins[case] = found["trad"]["h2_box"] - found["ext"]["h2_box"]
        for gain in plant.GAINS:
            evidence[f"H2 norm, K_{gain}, {case}"] = found[gain]["h2_box"]
            evidence[f"least and largest over the vertices, K_{gain}, {case}"] = found[gain]["h2_vertices"]
    for gain in plant.GAINS:
        energy = simulation["linear"]["values"]["disturbance"][gain]["d-omega0"]["energy"]
        evidence[f"integral of |z2|^2 over 1200 s, K_{gain} [rad^2 s]"] = energy
    return Result(Statement(margins), evidence)


def diverges(synthesis: Any) -> Result:
    """-det(I + Phi) > 0 over the whole box: a real multiplier below -1, so period doubling; both radii, both N."""
    margins, evidence = {}, {}
    for case, shapes in synthesis["floquet"]["enclosed"]["trad"].items():
        for shape, found in shapes.items():
            margins[f"{case}, {shape}"] = found["doubling_box"]
            evidence[f"largest |mu| at the printed K, {case}, {shape}"] = found["largest"]
            evidence[f"exponent [1/s], {case}, {shape}"] = found["exponent"]
    factors = synthesis["floquet"]["scans"]["trad"]["N-printed"]["factors"]
    evidence |= {f"largest |mu| at {f} times the frequency of F": value for f, value in factors.items()}
    return Result(Statement(margins), evidence)


def stays_stable(synthesis: Any) -> Result:
    """1 - |mu| over the whole box, both radii, both N; the same for every measurable F is `decays`."""
    margins, evidence = {}, {}
    for case, shapes in synthesis["floquet"]["enclosed"]["ext"].items():
        for shape, found in shapes.items():
            margins[f"{case}, {shape}"] = 1 - found["largest_box"]
            evidence[f"largest |mu| at the printed K, {case}, {shape}"] = found["largest"]
            evidence[f"quadratic-stability radius, {case}, {shape}"] = found["radius"]
    return Result(Statement(margins), evidence)


def decays(certificates: Any) -> Result:
    """Decay rate of 0.15 1/s for every measurable abs(F) <= 1, whole box, both radii, both N."""
    return proven(certificates, "decay-ext")


def unsupported(synthesis: Any) -> Result:
    """No inequality of the paper contains M, F or N; instead, the multiple of Delta K that K_ext tolerates."""
    found = synthesis["floquet"]["enclosed"]
    evidence = {
        f"quadratic-stability radius, K_{gain} (1 is the print)": found[gain][plant.DEFAULT]["N-printed"]["radius"]
        for gain in plant.GAINS
    }
    designs = synthesis["nonfragile"]["designs"]
    evidence |= {
        f"guaranteed H2 norm of a non-fragile design, effort {name}": design["certified"]
        for name, design in designs.items()
        if design["certified"] is not None
    }
    return Result(found["ext"][plant.DEFAULT]["N-printed"]["radius"], evidence)
