"""System norms against closed forms, python-control with slycot, and sweeps that share no code."""

import numpy as np
import pytest
from flint import arb, fmpq

from recontrol.exact.ball import box, precision
from recontrol.exact.rational import from_float, identity, matrix, to_float, zeros
from recontrol.systems import norms, riccati, stability

RNG_SEEDS = (0, 1, 2)


def second_order(damping: str) -> tuple[np.ndarray, ...]:
    """1 / (s^2 + 2 d s + 1)."""
    two_d = fmpq(2) * matrix([[damping]])[0, 0]
    A = np.array([[fmpq(0), fmpq(1)], [fmpq(-1), -two_d]], dtype=object)
    return A, matrix("0\n1"), matrix("1 0"), matrix("0")


def random_system(seed: int) -> tuple[np.ndarray, ...]:
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(5, 5))
    A -= (np.linalg.eigvals(A).real.max() + 0.2) * np.eye(5)
    return A, rng.normal(size=(5, 2)), rng.normal(size=(3, 5)), rng.normal(size=(3, 2))


def test_h2_norm_of_a_second_order_lag() -> None:
    A, B, C, _ = second_order("0.2")
    # Closed form: ||1/(s^2 + 2 d s + 1)||_2^2 = 1/(4 d).
    with precision(200):
        assert norms.h2_norm(A, B, C).contains((arb(1) / arb(fmpq(8, 10))).sqrt())


def test_h2_norm_holds_over_a_box() -> None:
    A, B, C, _ = second_order("0.2")
    half = zeros(2)
    half[1, 1] = fmpq(1, 1000)
    wide = norms.h2_norm(box(A, half), B, C)
    for damping in ("0.1995", "0.2", "0.2005"):
        assert wide.contains(norms.h2_norm(*second_order(damping)[:3]))


def test_hinf_norm_of_a_resonance() -> None:
    # Closed form: 1/(2 d sqrt(1 - d^2)) at w = sqrt(1 - 2 d^2).
    found = norms.hinf_norm(*second_order("0.2"), rtol=1e-12)
    with precision(200):
        d = arb(fmpq(1, 5))
        assert found.value.contains(1 / (2 * d * (1 - d**2).sqrt()))
        assert found.value.rad() < 1e-11
    assert found.frequency == pytest.approx(np.sqrt(1 - 2 * 0.04), rel=1e-5)


@pytest.mark.parametrize(("C", "D", "norm", "frequency"), [("1 0", "0", 1, 0.0), ("-1 -4", "1", 1, None)])
def test_hinf_norm_at_the_ends_of_the_frequency_axis(C: str, D: str, norm: int, frequency: float | None) -> None:
    A, B, _, _ = second_order("2")
    # 1/(s^2+4s+1) peaks at zero; 1 - (4s+1)/(s^2+4s+1) = s^2/(s^2+4s+1) approaches 1 at infinity, from below.
    found = norms.hinf_norm(A, B, matrix(C), matrix(D), rtol=1e-9)
    with precision(200):
        assert found.value.contains(norm)
    assert found.frequency == frequency


def test_excess_far_above_the_bandwidth_is_found() -> None:
    # The off-diagonal gyroscopic part lifts the largest singular value above one by 3e-9, far above the poles.
    coupling = "0.00002"
    A = matrix(f"0 0 1 0\n0 0 0 1\n-0.01 0 -0.3 {coupling}\n0 -0.01 -{coupling} -0.3")
    B, C, D = matrix("0 0\n0 0\n1 0\n0 1"), A[2:, :], identity(2)
    found = norms.hinf_norm(A, B, C, D, rtol=1e-14)
    # Complex coordinate q1 + i q2 makes it scalar: |1 + V(s)/(...)| maximised by an independent dense sweep.
    s = 1j * np.geomspace(1e1, 1e6, 200001)
    rest = [-(V := (0.3 - sign * 2e-5j) * s + 0.01) / (s * s + V) for sign in (1, -1)]
    excess = max(np.max(r.real + np.abs(r) ** 2 / 2) for r in rest)
    # |1 + r| - 1 = Re r + |r|^2/2 + O(r^2 Re r), |r| ~ 1e-4: the next terms are 1e-4 smaller.
    assert float(found.lower - 1) == pytest.approx(excess, rel=1e-3)
    assert 2e-9 < float(found.lower - 1) < float(arb(found.upper) - 1) < 4e-9


@pytest.mark.parametrize("seed", RNG_SEEDS)
def test_agreement_with_control_and_slycot(seed: int) -> None:
    control = pytest.importorskip("control")
    pytest.importorskip("slycot")
    system = random_system(seed)
    exact = [from_float(M) for M in system]
    # slycot's linfnorm stops at 1e-10 relative; its H2 norm is a Lyapunov solve of order 5.
    assert float(norms.hinf_norm(*exact, rtol=1e-10).value.mid()) == pytest.approx(
        control.linfnorm(control.ss(*system))[0], rel=1e-8
    )
    strict = control.ss(*system[:3], np.zeros((3, 2)))
    assert float(norms.h2_norm(*exact[:3])) == pytest.approx(control.system_norm(strict, 2), rel=1e-9)


@pytest.mark.parametrize("seed", RNG_SEEDS)
def test_agreement_with_a_sweep(seed: int) -> None:
    A, B, C, D = random_system(seed)
    w = np.geomspace(1e-4, 1e4, 20001)
    values, vectors = np.linalg.eig(A)
    left, right = np.linalg.solve(vectors, B), C @ vectors
    response = np.einsum("ik,wk,kj->wij", right, 1 / (1j * w[:, None] - values), left) + D
    peak = np.linalg.svd(response, compute_uv=False)[:, 0].max()
    found = norms.hinf_norm(*(from_float(M) for M in (A, B, C, D)), rtol=1e-9)
    # The grid is 1e-3 fine in log frequency, the peak quadratic: 1e-5 below at most; never above the proven bound.
    assert peak < float(arb(found.upper))
    assert peak == pytest.approx(float(found.value.mid()), rel=1e-4)
    assert norms.hinf_norm_float(A, B, C, D) == pytest.approx(float(found.value.mid()), rel=1e-7)


def test_no_certificate_below_the_norm() -> None:
    system = second_order("0.2")
    lower = norms.hinf_norm(*system).lower
    assert norms.hinf_certificate(*system, fmpq(99, 100) * from_float(float(lower))) is None


def test_stability_is_decided_before_any_norm() -> None:
    A, B, C, D = second_order("-0.2")
    assert stability.is_hurwitz(A) is False
    for norm in (lambda: norms.h2_norm(A, B, C), lambda: norms.hinf_norm(A, B, C, D)):
        with pytest.raises(stability.UnstableError):
            norm()
    with pytest.raises(stability.UnstableError):
        norms.hinf_norm_float(*(to_float(M) for M in (A, B, C, D)))


def test_a_box_across_the_boundary_is_undecided() -> None:
    half = zeros(2)
    half[1, 1] = fmpq(1, 2)
    assert stability.is_hurwitz(box(second_order("0.2")[0], half)) is None


def test_minimal_riccati_solution_of_a_scalar_equation() -> None:
    # -2 p + 1/2 + p^2/2 = 0: roots 2 -+ sqrt(3).
    A, Q, S = (matrix([[x]]) for x in ("-1", "0.5", "0.5"))
    found = riccati.bounds(A, Q, S).trace(identity(1))
    assert found.contains(arb(2) - arb(3).sqrt())
    assert found.rad() < 1e-11


@pytest.mark.parametrize("seed", RNG_SEEDS)
def test_minimal_riccati_solution_against_the_hamiltonian(seed: int) -> None:
    A, B, C, _ = random_system(seed)
    gamma = 1.1 * norms.hinf_norm_float(A, B, C, np.zeros((3, 2)))
    S, Q = B @ B.T / gamma**2, C.T @ C
    reference = np.trace(riccati.float_minimal_solution(A, Q, S))
    found = riccati.bounds(*(from_float(M) for M in (A, Q, S)))
    assert float(found.trace(identity(5)).mid()) == pytest.approx(reference, rel=1e-7)


def test_unsolvable_riccati_equation_is_refused() -> None:
    # -2 p + 2 + p^2 = 0 has no real root.
    with pytest.raises(riccati.NoSolutionError):
        riccati.bounds(*(matrix([[x]]) for x in ("-1", "2", "1")))


def test_bounded_real_certificate_holds_for_the_box() -> None:
    A, B, C, D = second_order("0.2")
    half = zeros(2)
    half[1, 1] = fmpq(1, 1000)
    found = norms.hinf_norm(box(A, half), B, C, D, rtol=1e-3)
    assert all(float(arb(found.upper)) > float(norms.hinf_norm(*second_order(d)).lower) for d in ("0.1995", "0.2005"))
    assert float(arb(found.upper)) < 2.8
