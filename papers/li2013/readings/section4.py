"""Section 4, sections 3.1 and 3.2 in numbers, and the conclusions."""

from __future__ import annotations

from typing import Any

from flint import arb, fmpq

from recontrol.claims.proofs import accepted, proven, provided, refuted, undecided, verified
from recontrol.claims.values import Approx, Result, Statement
from recontrol.exact.ball import precision, to_ball
from recontrol.exact.polynomial import charpoly, routh_column
from recontrol.lmi.certificate import decode
from recontrol.systems import sampled

from .support import integral_bound, loop

SOLUTIONS = "solutions, less one"
"""Margin of \"there is a solution\" where a certificate excludes one."""


def eq22_suff(data: Any, certificates: Any, simulation: Any, case: str) -> Result:
    """Proven (21), (22), (47), and u_max less the peak of the simulated loop with d_bar = 0 [N]."""
    accepted(certificates, "decay-box")
    peaks = simulation["loops"]["values"]["metrics"][f"{case} zero none"]["u_peak"]
    limit = data.float("thrust_max")
    margins = {f"u_max - |u_{axis}|": Approx(limit - peaks[axis], 1e-6) for axis in "xyz"}
    return Result(Statement(margins), certificate="decay-box")


def thm3_sign(data: Any, case: str) -> Statement:
    """(20) for d_bar = 0 from x(0) asks for ||z||^2 <= 0: minus the integral of e'e."""
    return Statement({"minus integral of e'e": -integral_bound(data, case)})


def hurwitz_box(certificates: Any) -> Result:
    """Lyapunov matrices for every gain that rounds to the print, both orbits; -K_bar is refuted beside it."""
    accepted(certificates, "minus-unstable")
    return proven(certificates, "hurwitz-box")


def hurwitz_routh(data: Any, case: str) -> Statement:
    """First column of Routh's array of the printed gain, exact."""
    A, G, _ = loop(data, case)
    return Statement({f"Routh {k + 1}": value for k, value in enumerate(routh_column(charpoly(A + G)))})


def feasible_printed(certificates: Any) -> Result:
    """Printed (21), (22): they hold for K_bar, and as well for 0 and -K_bar."""
    strengths = {f"holds as well for {gain}": accepted(certificates, f"void-{gain}") for gain in ("zero", "minus")}
    return proven(certificates, "print-K", strengths)


def feasible_derived(certificates: Any) -> Result:
    """Derived (21), (22) with the printed V(0), every gain of the box, both orbits."""
    return proven(certificates, "decay-box")


def performance_printed(certificates: Any) -> Result:
    """Printed (55), d_bar = [d; y_r], gamma^2: a pair of rank-one multipliers."""
    return refuted(certificates, "pair-square", margin=SOLUTIONS)


def performance_equilibrium_square(certificates: Any) -> Result:
    """Derived (55), d_bar = [d; y_r], gamma^2: the loop's equilibrium."""
    return refuted(certificates, "equilibrium-square", margin=SOLUTIONS)


def performance_equilibrium_linear(certificates: Any) -> Result:
    """Derived (55), d_bar = [d; y_r], weight gamma."""
    return refuted(certificates, "equilibrium-linear", margin=SOLUTIONS)


def performance_d_only(certificates: Any) -> Result:
    """Derived (21), (22), (55) for d alone, gamma^2."""
    return proven(certificates, "d-only")


def performance_printed_linear(certificates: Any) -> Result:
    """Printed (21), (22), (47), (55), d_bar = [d; y_r], weight gamma; -K_bar passes as well."""
    return proven(certificates, "linear-K", {"holds as well for -K_bar": accepted(certificates, "linear-minus")})


def performance_printed_d_only(data: Any, synthesis: Any) -> Statement:
    """Printed (55) for d alone: gamma less its infimum, which sinks towards zero."""
    found = synthesis["gamma"]["printed"]["w-print"]["d-only"]["gamma"]
    return Statement({"gamma less infimum": Approx(data.float("gamma") - found, 0.01)})


def V0_feasible(certificates: Any) -> Result:
    """A proven point of derived (21), (22), (47) whose V(0) is the print."""
    return proven(certificates, "decay-box")


def V0_bound(data: Any, case: str) -> Result:
    """Derived (55), any gamma and channel: V(0) is at least the integral of e'e; print less that bound."""
    bound = integral_bound(data, case)
    return Result(Statement({"print less integral": data["V0"] - bound}), {"integral of e'e": bound})


def V0_printed_linear(certificates: Any) -> Result:
    """All printed conditions with the weight of (54) admit the printed V(0)."""
    return performance_printed_linear(certificates)


def rho(data: Any, certificates: Any) -> Result:
    """rho less V(0), and the common solution of derived (21), (22), (47)."""
    margin = provided(verified(certificates, "decay-box"), data["rho"] - data["V0"])
    return Result(Statement({"rho - V(0)": margin}), certificate="decay-box")


def rho_bound(data: Any, synthesis: Any, case: str) -> Result:
    """rho less the integral of e'e, which V(0) cannot fall below under derived (55)."""
    evidence = {
        "least rho, d alone, alpha = 0.02": synthesis["initial"]["least_rho"]["a02"],
        "least integral over 30 s for any held thrust": synthesis["inputs"]["w-print"]["bound"],
    }
    return Result(Statement({"rho less integral": data["rho"] - integral_bound(data, case)}), evidence)


def alpha_certificate(certificates: Any) -> Result:
    """Derived (21) at alpha = 0.02: every sequence of intervals up to h."""
    return proven(certificates, "decay-box")


def alpha_exact(data: Any, case: str) -> Statement:
    """Exact rate of periodic sampling less alpha, printed gain (ball)."""
    A, G, _ = loop(data, case)
    with precision(128):
        return Statement({"rate less alpha": sampled.decay_rate(A, G, data["h"]) - data["alpha"]})


def alpha_box(data: Any, case: str) -> Result:
    """The same for every gain of the box: the largest of these rates that a Lyapunov matrix proves, less alpha."""
    A, G, _ = loop(data, case, "box")
    with precision(128):
        M = sampled.monodromy(A, G, data["h"])
        for rate in ("0.0665", "0.066", "0.065", "0.06", "0.05", "0.03"):
            proven_rate = fmpq(int(float(rate) * 10_000), 10_000)
            if sampled.contracts(M, (-to_ball(proven_rate * data["h"])).exp()):
                return Result(Statement({"proven rate less alpha": arb(proven_rate - data["alpha"])}))
    return Result(Statement({"undecided": undecided()}))


def umax_simulated(data: Any, simulation: Any, case: str) -> Result:
    """u_max less the simulated peak over all instants, with and without the sine [N]."""
    limit, metrics = data.float("thrust_max"), simulation["loops"]["values"]["metrics"]
    margins = {
        f"{disturbance} {axis}": Approx(limit - metrics[f"{case} hold {disturbance}"]["u_peak"][axis], 1e-6)
        for disturbance in ("none", "sine")
        for axis in "xyz"
    }
    later = metrics[f"{case} hold none"]["u_peak_after_first"]
    return Result(Statement(margins), {f"peak after t_1, {axis} [N]": later[axis] for axis in "xyz"})


def umax_certificate(data: Any, model: Any, certificates: Any, case: str) -> Result:
    """(22) bounds the thrust for the zero reference, and for `hold` with the state less xi_ss if (47) still holds."""
    found = verified(certificates, "decay-box")
    P1 = decode(certificates["decay-box"]["witness"]["point"]["P1"])
    start = model["exact"]["xi0"]
    shifted = start - model["orbits"][case]["equilibrium"]
    margins = {
        "rho - V(0), zero": data["rho"] - (start.T @ P1 @ start)[0, 0],
        "rho - V(0), hold, shifted": data["rho"] - (shifted.T @ P1 @ shifted)[0, 0],
    }
    held = {name: provided(found, margin) for name, margin in margins.items()}
    return Result(Statement(held), certificate="decay-box")


def gamma_pulse(data: Any, simulation: Any, case: str) -> Result:
    """gamma^2 less (||z|| / ||d_bar||)^2 of y_r held over eight intervals: a ball from below."""
    ratio = simulation["gains"]["values"]["pulse"][case]["8"]
    sampled_gain = simulation["gains"]["values"]["sampled"][case]["both"]["32"]["gain"]
    return Result(Statement({"gamma^2 less ratio^2": data["gamma"] ** 2 - ratio}), {"sampled gain": sampled_gain})


def gamma_d_only(certificates: Any, simulation: Any, case: str) -> Result:
    """Derived (55) for d alone bounds its gain by 0.4."""
    found = simulation["gains"]["values"]["sampled"][case]["d-only"]["32"]["gain"]
    return proven(certificates, "d-only", {"sampled gain": found})


def jumps(simulation: Any) -> Result:
    """V_2 and V_3 vanish after t_k and are nonnegative before: 1e-9 less the largest jump found along two runs."""
    values = simulation["functional"]["values"]
    margins = {name: Approx(1e-9 - values[name]["jump_up"], 1e-10) for name in ("periodic", "random")}
    return Result(Statement(margins), {"largest fall at t_k, random": values["random"]["jump_down"]})


def conservatism(synthesis: Any) -> Result:
    """Largest h of the derived condition less that of the time-independent one, alpha = 0, per block [s]."""
    found = synthesis["periods"]["h_max"]
    margins = {}
    for block in ("xy", "z"):
        ours, theirs = found["derived-a0"][block], found["time-independent"][block]
        margins[block] = Approx(ours["low"] - theirs["high"], 1e-3)
    return Result(Statement(margins))
