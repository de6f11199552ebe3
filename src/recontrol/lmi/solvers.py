"""Solver profiles, and one guarded run of a CVXPY problem: timed, with normalised words.

A child process protects the caller from crashes and hangs of compiled solvers (CVXOPT and SDPA know no time limit).
CLARABEL needs none: it is memory-safe and keeps its own time limit, and a fork costs as much as a small solve. What a
solver says is kept word for word; what is believed is decided by `recontrol.lmi.problem` from the stored point.
"""

from __future__ import annotations

import importlib.util
import multiprocessing
import os
import time
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

OPTIMAL, INACCURATE, INFEASIBLE, UNBOUNDED, FAILED = "optimal", "inaccurate", "infeasible", "unbounded", "failed"

_WORDS = {
    "optimal": OPTIMAL,
    "optimal_inaccurate": INACCURATE,
    "user_limit": INACCURATE,
    "infeasible_inaccurate": INACCURATE,
    "unbounded_inaccurate": INACCURATE,
    "infeasible": INFEASIBLE,
    "unbounded": UNBOUNDED,
}

DEFAULT_TIME_LIMIT = 120.0

BACKUP = "CLARABEL"
"""Profile that is asked where the run's own choice gives no answer."""


class SolverMissingError(ValueError):
    """A solver profile is unknown or its package is not installed."""


@dataclass(frozen=True)
class Profile:
    """A named way to call a solver through CVXPY.

    ``time_option`` is the solver's own time limit, if it has one. ``run`` replaces the call (for tests): a function of
    the CVXPY problem that leaves status and values in it. ``guarded`` solvers run in a child process. ``fast`` are the
    options for searches and for multipliers that are proven afterwards.
    """

    name: str
    solver: str
    package: str
    kind: str  # "interior point" or "first order"
    options: Mapping[str, Any] = field(default_factory=dict)
    time_option: str | None = None
    run: Callable[[Any], None] | None = None
    guarded: bool = True
    fast: Mapping[str, Any] = field(default_factory=dict)


PROFILES: dict[str, Profile] = {
    # "auto" takes faer, the supernodal factorisation, for larger problems, and its results change with the number of
    # threads. With the one thread of this profile it gives the same bytes in each run, in two thirds of the time.
    "CLARABEL": Profile(
        "CLARABEL",
        "CLARABEL",
        "clarabel",
        "interior point",
        {"direct_solve_method": "qdldl", "max_threads": 1},
        "time_limit",
        guarded=False,
        fast={"direct_solve_method": "faer"},
    ),
    # The default KKT solver of CVXOPT fails on many of these problems.
    "CVXOPT": Profile("CVXOPT", "CVXOPT", "cvxopt", "interior point", {"kktsolver": "robust"}),
    "SDPA": Profile("SDPA", "SDPA", "sdpap", "interior point", {"numThreads": 1}),
    # First order: recorded, never relied on.
    "SCS": Profile("SCS", "SCS", "scs", "first order", {"eps": 1e-9, "max_iters": 100_000}, "time_limit_secs"),
}


def default() -> str:
    """Name of the profile that is used where none is named: RECONTROL_SOLVER, which the stage runner sets from the
    configuration, else CLARABEL."""
    return os.environ.get("RECONTROL_SOLVER", "CLARABEL")


def profile(name: str | Profile, *, fast: bool = False, **options: Any) -> Profile:
    """Profile by name (or a profile itself) with ``options`` over its own, those of a search between them if ``fast``.

    Raises SolverMissingError if the name is unknown or the package is not installed.
    """
    found = name if isinstance(name, Profile) else PROFILES.get(name)
    if found is None:
        raise SolverMissingError(f"no solver profile is called {name!r}; there are {', '.join(PROFILES)}")
    if found.run is None and importlib.util.find_spec(found.package) is None:
        raise SolverMissingError(f"solver {found.name}: package {found.package!r} is not installed")
    return replace(found, options={**found.options, **(found.fast if fast else {}), **options})


@dataclass(frozen=True)
class Run:
    """What came back from one guarded run: the solver's words, values of variables and duals by position."""

    words: str
    outcome: str
    reported: float | None = None
    values: tuple[Any, ...] = ()
    duals: tuple[Any, ...] = ()
    iterations: int | None = None
    seconds: float = 0.0


def run(problem: Any, chosen: Profile, time_limit: float = DEFAULT_TIME_LIMIT) -> Run:
    """Solve a CVXPY problem within ``time_limit`` [s]; never raises for what the solver does.

    A crash, an exception or a killed child gives outcome "failed" with words that say so.
    """
    started = time.perf_counter()
    if chosen.run is None and not chosen.guarded:
        return Run(**_answer(problem, chosen, time_limit), seconds=_since(started))
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(duplex=False)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # fork beside idle BLAS threads, Python 3.12
        child = context.Process(target=_child, args=(problem, chosen, time_limit, send), daemon=True)
        child.start()
    send.close()
    # The solver's own limit comes first where it has one: it may still hand over its best point.
    patience = time_limit * 1.25 + 2.0 if chosen.time_option else time_limit
    try:
        answer = receive.recv() if receive.poll(patience) else None
    except EOFError:
        child.join()
        return Run(f"crashed: the solver's process ended with code {child.exitcode}", FAILED, seconds=_since(started))
    finally:
        receive.close()
    if answer is None:
        child.kill()
        child.join()
        return Run(f"out of time: stopped after {time_limit:g} s", FAILED, seconds=_since(started))
    child.join()
    return Run(**answer, seconds=_since(started))


def _since(started: float) -> float:
    return time.perf_counter() - started


def _child(problem: Any, chosen: Profile, time_limit: float, send: Any) -> None:
    """Runs in the child: solve, send plain data, leave without clean-up handlers of the parent."""
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    send.send(_answer(problem, chosen, time_limit))
    send.close()
    os._exit(0)


def _answer(problem: Any, chosen: Profile, time_limit: float) -> dict[str, Any]:
    """What the solver says, or the error that it raised, in words."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return _solve(problem, chosen, time_limit)
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # a panic of a Rust solver is no Exception
        return {"words": f"error: {type(error).__name__}: {error}".strip()[:300], "outcome": FAILED}


def _solve(problem: Any, chosen: Profile, time_limit: float) -> dict[str, Any]:
    if chosen.run is not None:
        chosen.run(problem)
    else:
        options = dict(chosen.options)
        if chosen.time_option:
            options[chosen.time_option] = float(time_limit)
        problem.solve(solver=chosen.solver, warm_start=False, **options)
    words = str(problem.status)
    stats = problem.solver_stats
    value = problem.value
    return {
        "words": words,
        "outcome": _WORDS.get(words, FAILED),
        "reported": float(value) if value is not None else None,
        "values": tuple(v.value for v in problem.variables()),
        "duals": tuple(c.dual_value for c in problem.constraints),
        "iterations": None if stats is None or stats.num_iters is None else int(stats.num_iters),
    }
