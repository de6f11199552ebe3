"""Speed of the ensemble steppers against one run at a time, and how cost grows: docs/performance.md and its plot.

    python tools/bench.py [--quick] [--write]

Every method samples the same trajectories on the same grid; agreement is checked before anything is timed. Times are
processor seconds of one run of this program on one thread, so that their ratio survives a busy machine.
"""

from __future__ import annotations

import argparse
import inspect
import platform
import re
import sys
import time
from pathlib import Path

from recontrol.pipeline import environment

environment.pin()

import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
STEP, SAMPLES = 0.1, 801
TOLERANCES = {"solve_ivp": 1e-5, "forced_response": 1e-9}
"""Largest deviation over a run's own peak: the integrator is asked for 1e-6, the others are exact up to rounding."""
REQUIRED = 100.0
"""How many times the plain solve_ivp loop the linear loops have to be, or the program fails."""
MOTION_TOLERANCE = 1e-6
"""Largest deviation of the two-body motion over a run's own peak; both sides are asked for 1e-8."""


def printed_loops(runs):
    """Members of the full-order ensemble of hashim2015: matrices (runs, 8, 8) and starts (runs, 8)."""
    from papers.hashim2015 import campaign
    from recontrol import paper

    data = paper.load(ROOT / "papers/hashim2015").data
    kept = {}

    def keep(A, x0, row):
        kept["loops"] = (A, x0)
        return {}

    original, campaign.outcomes = campaign.outcomes, keep
    try:
        campaign.full_order(np.random.default_rng(1), runs, data)
    finally:
        campaign.outcomes = original
    return kept["loops"]


def random_loops(runs, n):
    """Stable random matrices of spectral abscissa -0.1 and starts of length one."""
    rng = np.random.default_rng(n)
    A = rng.standard_normal((runs, n, n)) / np.sqrt(n)
    A -= (np.linalg.eigvals(A).real.max(axis=1)[:, None, None] + 0.1) * np.eye(n)
    x0 = rng.standard_normal((runs, n))
    return A, x0 / np.linalg.norm(x0, axis=1, keepdims=True)


def batched(A, x0, samples=SAMPLES):
    """All runs by doubling products of batched exponentials, block by block; returns the states of the last block."""
    from recontrol.campaign.linear import blocks, trajectories

    for part in blocks(A, samples):
        states = trajectories(A[part], x0[part], STEP, samples)
    return states


def solve_ivp_loop(A, x0, samples=SAMPLES):
    """The plain loop: one adaptive integration a run."""
    from scipy.integrate import solve_ivp

    grid = STEP * np.arange(samples)
    return np.array(
        [
            solve_ivp(lambda _t, x, a=a: a @ x, (0, grid[-1]), start, t_eval=grid, rtol=1e-6, atol=1e-9).y.T
            for a, start in zip(A, x0, strict=True)
        ]
    )


def forced_response_loop(A, x0, samples=SAMPLES):
    """python-control, one run at a time: states of the free response on the grid."""
    import control

    grid, n = STEP * np.arange(samples), A.shape[1]
    B, D = np.zeros((n, 1)), np.zeros((n, 1))
    states = []
    for a, start in zip(A, x0, strict=True):
        system = control.ss(a, B, np.eye(n), D)
        states.append(control.forced_response(system, grid, np.zeros(samples), start).states.T)
    return np.array(states)


def rendezvous(runs):
    """A batch of the ensemble of wan2014: observer-based loop around the two-body motion."""
    from papers.wan2014 import campaign, model
    from recontrol import paper

    data = paper.load(ROOT / "papers/wan2014").data
    plant = model.model(**dict.fromkeys(inspect.signature(model.model).parameters, data))
    return campaign.drawn(np.random.default_rng(1), runs, data, plant)


def batched_motion(batch):
    """All runs in one adaptive integration: states and estimates (runs, samples, 12)."""
    from papers.wan2014 import campaign
    from papers.wan2014.loop import simulate

    found = simulate(batch, campaign.TIMES, rtol=campaign.TOLERANCE)
    return np.concatenate([found["state"], found["estimate"]]).transpose(2, 1, 0)


def motion_loop(batch):
    """The plain loop over runs: state, estimate, radius and radial rate of one of them at a time."""
    from scipy.integrate import solve_ivp

    from papers.wan2014 import campaign
    from recontrol.spacecraft.orbit import relative_acceleration

    def rhs(_t, s, K, L, momentum, gm):
        u = -K @ s[6:12] / batch.mass
        rate = momentum / s[12] ** 2
        free = relative_acceleration(s[:3], s[3:6], s[12], s[13], rate, gm)
        observer = batch.A @ s[6:12] + L @ (s[:3] - s[6:9])
        observer[3:] += u
        return np.concatenate([s[3:6], free + u, observer, [s[13], s[12] * rate**2 - gm / s[12] ** 2]])

    states, times = [], campaign.TIMES
    for k, target in enumerate(batch.orbits):
        radius, radial_rate, _ = target.radial_state(batch.anomaly[k])
        first = np.concatenate([batch.start[:, k], batch.estimate[:, k], [radius, radial_rate]])
        given = (batch.K[k], batch.L[k], target.angular_momentum, target.gm)
        options = {"method": "DOP853", "t_eval": times, "rtol": campaign.TOLERANCE, "atol": 1e-8}
        states.append(solve_ivp(rhs, (0, times[-1]), first, args=given, **options).y[:12].T)
    return np.array(states)


def motion(quick):
    """Ratio of the batched two-body motion to the plain loop, and their deviation. Stops the program if they differ."""
    few, many = rendezvous(2 if quick else 10), rendezvous(50 if quick else 1000)
    ours, theirs = batched_motion(few), motion_loop(few)
    deviation = float(np.max(np.abs(ours - theirs) / np.abs(theirs).max(axis=(1, 2), keepdims=True)))
    if not deviation <= MOTION_TOLERANCE:
        sys.exit(f"bench: the motion deviates by {deviation:.1e}, allowed {MOTION_TOLERANCE:g}: nothing is timed")
    seconds = {}
    for name, method, batch in (("batched", batched_motion, many), ("loop", motion_loop, few)):
        start = time.process_time()
        method(batch)
        seconds[name] = (time.process_time() - start) / len(batch.orbits)
    return {"deviation": deviation, "ratio": seconds["loop"] / seconds["batched"], "runs": len(many.orbits)} | seconds


OTHERS = {"solve_ivp": solve_ivp_loop, "forced_response": forced_response_loop}


def agreement(A, x0):
    """Largest deviation of each method from ours over the run's own peak. Stops the program if one is too large."""
    ours = batched(A, x0)
    peak = np.abs(ours).max(axis=(1, 2), keepdims=True)
    found = {name: float(np.max(np.abs(method(A, x0) - ours) / peak)) for name, method in OTHERS.items()}
    for name, deviation in found.items():
        if not deviation <= TOLERANCES[name]:
            sys.exit(f"bench: {name} deviates by {deviation:.1e}, allowed {TOLERANCES[name]:g}: nothing is timed")
    return found


def rate(method, A, x0, repeats=3, **options):
    """Trajectories per processor second, the best of some repeats."""
    best = np.inf
    for _ in range(repeats):
        start = time.process_time()
        method(A, x0, **options)
        best = min(best, time.process_time() - start)
    return A.shape[0] / max(best, 1e-9)


def growth(quick):
    """Processor seconds a trajectory over ensemble, horizon and state size; each table maps size -> seconds."""
    runs, samples, states = (10, 100, 1000, 10000), (101, 401, 1601, 6401), (2, 4, 8, 16, 32)
    runs, samples, states = (sizes[: -1 if quick else None] for sizes in (runs, samples, states))
    return {
        "runs in the ensemble": {k: 1 / rate(batched, *random_loops(k, 8)) for k in runs},
        "samples in a run": {k: 1 / rate(batched, *random_loops(400, 8), samples=k) for k in samples},
        "states": {k: 1 / rate(batched, *random_loops(200, k)) for k in states},
    }


def exponent(table):
    """Slope of the logarithms, by least squares over the larger half of the sizes."""
    sizes, costs = np.log(list(table)), np.log(list(table.values()))
    half = len(sizes) // 2
    return float(np.polyfit(sizes[half - 1 :], costs[half - 1 :], 1)[0])


def measure(quick):
    """Agreement, rates and growth."""
    check = agreement(*printed_loops(10))
    rates = {"this project": rate(batched, *printed_loops(400 if quick else 2000))}
    few = printed_loops(10 if quick else 40)
    rates |= {name: rate(method, *few, repeats=2) for name, method in OTHERS.items()}
    return {"agreement": check, "rates": rates, "growth": growth(quick), "motion": motion(quick)}


def table(rows):
    """A Markdown table; the first row is the head."""
    head, *body = rows
    lines = [head, ["---"] * len(head), *body]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def page(found):
    """docs/performance.md."""
    ours = found["rates"]["this project"]
    speeds = [["method", "trajectories a second", "this project is faster by", "deviation over the peak, allowed"]]
    for name, speed in found["rates"].items():
        deviation = f"{found['agreement'][name]:.1e}, {TOLERANCES[name]:g}" if name in OTHERS else ""
        speeds.append([name, f"{speed:.3g}", f"{ours / speed:.0f}", deviation])
    parts = []
    for what, sizes in found["growth"].items():
        rows = [[what, *sizes], ["microseconds a trajectory", *(f"{1e6 * s:.3g}" for s in sizes.values())]]
        parts.append(f"{table(rows)}\n\nExponent over the larger sizes: {exponent(sizes):.2f}.")
    return TEMPLATE.format(
        speeds=table(speeds), growth="\n\n".join(parts), samples=SAMPLES, step=STEP, machine=platform.machine(),
        python=platform.python_version(), numpy=np.__version__, required=REQUIRED, motion=found["motion"],
        allowed=MOTION_TOLERANCE,
    )  # fmt: skip


KEPT = re.compile(r"<!-- speed -->.*?<!-- /speed -->", re.DOTALL)
"""A section of docs/performance.md that another program writes."""


def with_kept(text, old):
    """The page with the marked section of an earlier one behind it, where there is one."""
    section = KEPT.search(old)
    return f"{text}\n{section.group()}\n" if section else text


TEMPLATE = """# Performance of the ensembles

Made by `make bench` (tools/bench.py), which first demands that all methods agree. Work: the full-order loop of
hashim2015, a different member of the rounding boxes in every run, 8 states, all of them at {samples} instants {step} s
apart. One thread; processor seconds of one program on {machine}, Python {python}, numpy {numpy}. The ratios are what
carries over to another machine.

{speeds}

`solve_ivp` is the plain loop with RK45 at rtol 1e-6, atol 1e-9; `forced_response` is python-control's, a new system for
every run. This project exponentiates all matrices of a block at once and doubles the known samples by one dense product
(`recontrol.campaign.linear`). The program fails if the first ratio falls below {required:g}.

The nonlinear ensemble, the two-body motion of wan2014 over 3000 s with observer and controller, is one adaptive
integration of {motion[runs]} runs at once. It is {motion[ratio]:.0f} times as fast as the plain `solve_ivp` loop over
the runs (DOP853 at rtol 1e-8 on both sides); states deviate by {motion[deviation]:.1e} of their peak, allowed
{allowed:g}. What it saves is the interpreter's part of a step, not arithmetic.

## Growth

Random stable loops; 8 states and {samples} samples where nothing else varies.

![cost of a trajectory over ensemble, horizon and state size](performance.svg)

{growth}

The cost of a trajectory hardly depends on the size of the ensemble, and memory stays that of one block (32 MiB of
states). It grows with the horizon, at most in proportion. In the state size it lies between the first power (samples
are written once) and the third (products of n x n matrices).
"""


def picture(found, stem):
    """Cost over each size on doubly logarithmic axes, as SVG."""
    from recontrol import plotting

    fig, axes = plotting.subplots(1, 3, width=plotting.PAGE, height=52, sharey=True)
    for ax, (what, sizes) in zip(axes, found["growth"].items(), strict=True):
        ax.loglog(list(sizes), [1e6 * s for s in sizes.values()], marker="o", **plotting.SERIES[0].line)
        plotting.label_axes(ax, (what, "1"))
    plotting.label_axes(axes[0], None, ("cost of a trajectory", "µs"))
    plotting.save(fig, stem, formats=("svg",))


def main():
    """Measure, print the page; with --write, renew docs/. Exit code 1 if the required ratio is missed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="a few seconds, for a test")
    parser.add_argument("--write", action="store_true", help="renew docs/performance.md and its plot")
    options = parser.parse_args()
    found = measure(options.quick)
    text = page(found)
    print(text)
    if options.write:
        target = ROOT / "docs/performance.md"
        target.write_text(with_kept(text, target.read_text() if target.exists() else ""))
        picture(found, ROOT / "docs/performance")
    ratio = found["rates"]["this project"] / found["rates"]["solve_ivp"]
    if ratio < REQUIRED:
        sys.exit(f"bench: only {ratio:.0f} times the plain solve_ivp loop, required {REQUIRED:.0f}")


if __name__ == "__main__":
    main()
