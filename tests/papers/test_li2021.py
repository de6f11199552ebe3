"""li2021: the rebuilt inequalities against other assemblies of them, the closed loop against scipy."""

from pathlib import Path

import numpy as np
import pytest
from flint import fmpq

from papers.li2021 import conditions as c
from papers.li2021 import plant as pl
from papers.li2021.problems import problem_data, theorem
from recontrol.exact.rational import identity, matrix, to_float
from recontrol.paper import load

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def data():
    return load(ROOT / "papers" / "li2021").data


def fractions(rng, m, n):
    return matrix([[f"{int(v)}/11" for v in row] for row in rng.integers(-20, 21, (m, n))])


def symmetric(rng, n):
    M = fractions(rng, n, n)
    return M + M.T


def full_rows(t, S, N, A_f, B_f, C_f, delta):
    """(15) with perturbed gains and inertia, built from the loop matrices and the congruence, not from (13)."""
    F, H = delta
    A = t["A"] + t["L"] @ H @ t["K"]
    A_d, B_d, C_d = A_f + A_f @ F[:6, :6], B_f + B_f @ F[6:9, 6:9], C_f + F[9:, 9:] @ C_f
    loop = np.block([[A, t["B"] @ C_d], [B_d @ t["C"], A_d]])
    zero = 0 * identity(6)
    B = np.vstack([t["B"], zero[:, :3]])
    C, W = np.hstack([t["C"], zero[:3]]), np.hstack([t["W"], zero[:3]])
    P = np.block([[S - N, N], [N, -N]])
    tau, gamma2, a, b = fmpq(9, 4), fmpq(100), t["a"], t["b"]
    one = identity(3)
    o = 0 * one
    rows = [
        [P * (-b * b / a), -(P @ B), P @ B, loop.T @ W.T * tau, C.T, (loop + identity(12) * a).T @ P],
        [None, one * -tau, o, -(B.T @ W.T) * tau, o, np.zeros((3, 12), dtype=int)],
        [None, None, one * -gamma2, B.T @ W.T * tau, o, np.zeros((3, 12), dtype=int)],
        [None, None, None, one * -tau, o, np.zeros((3, 12), dtype=int)],
        [None, None, None, None, -one, np.zeros((3, 12), dtype=int)],
        [None, None, None, None, None, P * -a],
    ]
    full = [[rows[i][j] if i <= j else rows[j][i].T for j in range(6)] for i in range(6)]
    return np.block(full)


def test_theorem_1_covers_every_vertex_of_the_uncertainty(data):
    # What a point of (13) means: one P serves the perturbed loops.
    case = "proposed;delta_m=0.02"
    found = theorem(data, "diag", case, gains=True).solve().point
    t = {k: to_float(v) if isinstance(v, np.ndarray) else v for k, v in problem_data(data, case).items()}
    rng = np.random.default_rng(1)
    P = np.block([[found["S"] - found["N"], found["N"]], [found["N"], -found["N"]]])
    assert np.linalg.eigvalsh(P)[0] > 0
    envelope = np.sign(rng.standard_normal((40, 15)))
    for signs in envelope:
        F, delta = np.diag(0.02 * signs[:12]), signs[12:]
        H = np.diag(np.concatenate([delta[list(pl.DELTA_G)], delta[list(pl.DELTA_D)]]))
        A = t["A"] + t["L"] @ H @ t["K"]
        A_f, B_f = t["A_f"] @ (np.eye(6) + F[:6, :6]), t["B_f"] @ (np.eye(3) + F[6:9, 6:9])
        C_f = (np.eye(3) + F[9:, 9:]) @ t["C_f"]
        loop = np.block([[A, t["B"] @ C_f], [B_f @ t["C"], A_f]])
        disk = (loop + 1.01 * np.eye(12)).T @ P @ (loop + 1.01 * np.eye(12)) - P
        assert np.linalg.eigvalsh(disk)[-1] < 0


def turned_and_reduced(whole):
    """The congruence with Gamma1 and the Schur complement of the output block (which is -I) of 36 rows: 33 rows."""
    one = identity(6)
    Gamma1 = np.block([[one, one], [one, 0 * one]])
    T = 0 * identity(36)
    T[:12, :12] = T[24:, 24:] = Gamma1
    T[12:24, 12:24] = identity(12)
    turned = T.T @ whole @ T
    output, rest = slice(21, 24), [*range(21), *range(24, 36)]
    return turned[np.ix_(rest, rest)] + turned[rest, output] @ turned[output, rest]


@pytest.fixture(scope="module")
def theorem_1(data):
    """A random point of (13) with unit multipliers, and what builds (15) there by the other route."""
    t = problem_data(data, "proposed")
    rng = np.random.default_rng(2)
    S, N = symmetric(rng, 6), symmetric(rng, 6)
    A_f, B_f, C_f = fractions(rng, 6, 6), fractions(rng, 6, 3), fractions(rng, 3, 6)
    names = ("A", "B", "C", "L", "K", "W", "a", "b", "delta_m")
    body = c.eq13(
        S, N, N @ A_f, N @ B_f, fmpq(9, 4), identity(12), identity(12), fmpq(100), C_f=C_f, **{k: t[k] for k in names}
    )
    return body, lambda F, H: turned_and_reduced(full_rows(t, S, N, A_f, B_f, C_f, (F, H))), t["delta_m"]


def test_certain_part_of_theorem_1_is_lemma_3_after_the_congruence(theorem_1):
    body, other, _ = theorem_1
    nothing = 0 * identity(12)
    assert (body[:33, :33] == other(nothing, nothing)).all()


def test_uncertain_columns_of_theorem_1_give_every_perturbation(theorem_1):
    # (16): what F and Delta H add to (15) is U F V' + V F U' with the columns U, V that (13) holds, exactly.
    body, other, delta_m = theorem_1
    rng = np.random.default_rng(5)
    F, H = (np.diag(fractions(rng, 1, 12)[0]) for _ in range(2))
    F, H = (M + 0 * identity(12) for M in (F, H))
    nothing = 0 * identity(12)
    U_H, V_H, U_F, V_F = (body[:33, k : k + 12] for k in (33, 45, 57, 69))
    due = U_H @ H @ V_H.T + (U_F @ F @ V_F.T) / delta_m
    assert (other(F, H) - other(nothing, nothing) == due + due.T).all()


def test_state_feedback_step_is_a_compression_of_theorem_1(data):
    # Rows 1-1, 2, 3, 4, 5-1 and the multipliers of (13), with X = S^-1, tau = lambda^2 and D = eps I.
    t = problem_data(data, "plant;e2=0.1;lam=3")
    rng = np.random.default_rng(3)
    X, Z = symmetric(rng, 6) + identity(6) * fmpq(40), fractions(rng, 3, 6)
    from recontrol.exact.linalg import inverse

    S, lam = inverse(X), t["lam"]
    gain = Z @ S
    F_a, F_b, N = 0 * identity(6), 0 * identity(6)[:, :3], -identity(6)
    names = ("A", "B", "C", "L", "K", "W", "a", "b", "delta_m")
    body = c.eq13(S, N, F_a, F_b, lam * lam, t["D1"], t["D2"], t["gamma2"], C_f=gain, **{k: t[k] for k in names})
    kept = [*range(6), *range(12, 27), *range(33, 69), *range(78, 81)]
    part = body[np.ix_(kept, kept)]
    T = identity(len(kept))
    T[:6, :6] = T[15:21, 15:21] = X  # rows 1-1 and 5-1
    T[12:15, 12:15] = identity(3) / lam  # rows of W0 unscaled
    turned = T.T @ part @ T
    names += ("lam", "eps1", "e2", "gamma2")
    sf = c.state_feedback(X, Z, **{k: t[k] for k in names})
    output = slice(21, 24)
    rest = [*range(21), *range(24, len(sf))]
    reduced = sf[np.ix_(rest, rest)] + sf[rest, output] @ sf[output, rest]
    assert (turned == reduced).all()


def test_torque_start_forms_agree_with_their_scalars(data):
    t = problem_data(data, "plant")
    rng = np.random.default_rng(4)
    root = fractions(rng, 6, 6)
    S = to_float(root @ root.T + identity(6))
    N = -S
    x0 = to_float(t["x0"])
    printed = c.eq20_printed(S, N, x0=x0, theta=20.0)
    assert np.linalg.eigvalsh(printed)[-1] < 0  # x0' S^-1 x0 is small against 20
    assert c.eq20_derived(S, N, x0=x0, theta=0.0).item() == pytest.approx((x0.T @ (2 * S) @ x0).item())


def test_closed_loop_simulation_matches_the_exponential(data):
    # Linear plant, no drift, no disturbance: the flow of the 20-state matrix.
    from scipy.linalg import expm

    from papers.li2021.loops import flexible_loops, flexible_plants
    from papers.li2021.simulation.loops import Ensemble, Run, sine_drift
    from recontrol.simulate.rk4 import rk4
    from recontrol.systems.output_feedback import Controller

    gains = pl.float_controller(pl.controller(data, "proposed"))
    ensemble = Ensemble([Run(gains, delta=(1, -1, 1), disturbed=0.0, drift=0.0)], data, linear=True)
    _, x = rk4(ensemble.rhs(sine_drift(0.05)), ensemble.initial(), 0.01, 1000)
    plants, inputs = flexible_plants(data, np.array([[1.0, -1.0, 1.0]]))
    A = flexible_loops(plants, inputs, Controller(*(M[None] for M in gains)))[0]
    x0 = np.concatenate([ensemble.q0[:, 0], np.zeros(4), ensemble.qd0[:, 0], np.zeros(10)])
    expected = expm(10 * A) @ x0
    assert x[-1, :3, 0] == pytest.approx(expected[:3], abs=1e-9)  # fourth order at 0.01 s on poles below 2 rad/s
    assert x[-1, 14:, 0] == pytest.approx(expected[14:], abs=1e-9)


def test_random_draws_are_held_and_the_same_for_both(data):
    from papers.li2021.simulation.random_gains import Held, table

    uniform = table(1)
    column = 4  # hold of 10 s
    steps = uniform[:, 0, column]
    assert len(np.unique(steps)) == 15  # 150 s of draws held for 10 s
    assert (steps[:500] == steps[0]).all()
    assert steps[500] != steps[0]
    assert len(np.unique(uniform[:, 0, 5])) == 1  # constant
    drift = Held(uniform, np.array([0, 0]), np.array([1.0, 0.05]))
    value = drift(3, 0.06)
    assert value[:, 1] == pytest.approx(0.05 * value[:, 0])


def test_a_case_that_names_nothing_is_refused(data):
    with pytest.raises(ValueError, match="expected plant or the name of a controller"):
        problem_data(data, "printed")
