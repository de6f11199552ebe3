"""Floquet multipliers and the quadratic-stability radius against closed forms, Liouville's formula and integration."""

import numpy as np
import pytest
from flint import arb, fmpq
from oracles import integrated_monodromy

from recontrol.exact.ball import box, midpoint, precision, radius
from recontrol.exact.rational import from_float, matrix, to_float, zeros
from recontrol.systems import periodic
from recontrol.systems.norms import hinf_norm


def mathieu(stiffness: str, pump: str, damping: str = "0.1") -> tuple[np.ndarray, list[periodic.Mode], arb]:
    """x'' + damping x' + (stiffness - pump sin 2t) x = 0."""
    A = matrix(f"0 1\n-{stiffness} -{damping}")
    return A, [periodic.Mode(matrix(f"0 0\n{pump} 0"), fmpq(2), fmpq(0))], arb.pi()


def test_constant_system_gives_the_matrix_exponential() -> None:
    A = matrix("0 1\n-1 0")
    with precision(200):
        found = periodic.monodromy(A, [], arb.pi() / 2, steps=16)
        # Rotation by 90 degrees.
        assert found[0, 1].contains(1)
        assert found[0, 0].contains(0)
        assert max(radius(found).flat) < 1e-25


def test_remainder_covers_a_low_order() -> None:
    with precision(200):
        found = periodic.monodromy(matrix("0 1\n-1 0"), [], arb.pi() / 2, steps=8, order=4)
        # The truncation error of exp at order 4 is about 8 h^5/120 = 2e-5: only the remainder bound can cover it.
        assert found[0, 1].contains(1)
        assert 1e-6 < max(radius(found).flat) < 0.1


def test_commuting_system_has_a_closed_form() -> None:
    # x' = (-1/2 + sin t) x over 2 pi: multiplier exp(-pi); over pi: exp(-pi/2 + 2).
    modes = [periodic.Mode(matrix("1"), fmpq(1), fmpq(0))]
    with precision(200):
        assert periodic.monodromy(matrix("-0.5"), modes, arb.pi())[0, 0].contains((2 - arb.pi() / 2).exp())


@pytest.mark.parametrize("pump", ["0.3", "1.5"])
def test_mathieu_against_integration_and_liouville(pump: str) -> None:
    A, modes, period = mathieu("1", pump)
    found = periodic.monodromy(A, modes, period)
    reference = integrated_monodromy(lambda t: to_float(A) + np.sin(2 * t) * to_float(modes[0].matrix), np.pi)
    # DOP853 at 1e-12 over one period.
    assert midpoint(found) == pytest.approx(reference, abs=1e-10)
    with precision(200):
        # Liouville: det Phi = exp(trace A * T).
        assert (found[0, 0] * found[1, 1] - found[0, 1] * found[1, 0]).contains((-arb.pi() / 10).exp())


def test_principal_resonance_is_a_period_doubling() -> None:
    # Pumping at twice the natural frequency: unstable for pump > 2 * damping * w0 = 0.2 (first order).
    A, modes, period = mathieu("1", "0.6")
    found = periodic.monodromy(A, modes, period)
    assert periodic.period_doubling_margin(found) > 0
    assert periodic.spectral_radius(found) > 1
    A, modes, period = mathieu("1", "0.1")
    found = periodic.monodromy(A, modes, period)
    assert periodic.period_doubling_margin(found) < 0
    assert periodic.spectral_radius(found) < 1


def test_box_contains_its_members() -> None:
    A, modes, period = mathieu("1", "0.6")
    half = zeros(2)
    half[1, 0] = half[1, 1] = fmpq(1, 1000)
    wide = periodic.monodromy(box(A, half), modes, period)
    for stiffness, damping in (("0.999", "0.101"), ("1.001", "0.099"), ("1.0005", "0.1")):
        member = periodic.monodromy(*mathieu(stiffness, "0.6", damping))
        assert all(wide[i, j].contains(member[i, j]) for i in range(2) for j in range(2))
    # No wrapping: the width stays within a few times half width x period x size of the transition matrices.
    assert 1e-4 < max(radius(wide).flat) < 2e-2
    assert periodic.period_doubling_margin(wide) > 0


def test_multipliers_lie_in_their_discs() -> None:
    rng = np.random.default_rng(3)
    M = rng.normal(size=(5, 5))
    discs = periodic.multiplier_discs(from_float(M))
    values = np.linalg.eigvals(M)
    for centre, size in discs:
        assert float(size) < 1e-12
        # numpy's eigenvalues are good to 1e-14 times the condition of a random 5x5 matrix.
        assert np.min(np.abs(values - complex(centre))) < 1e-11


def test_quadratic_stability_radius_of_a_scalar() -> None:
    # x' = (-2 + delta) x: the radius is 2.
    found = periodic.quadratic_stability_radius(matrix("-2"), matrix("1"), matrix("1"))
    assert found.contains(2)
    assert found.rad() < 1e-7


def test_quadratic_stability_radius_is_below_the_periodic_threshold() -> None:
    # No F within the radius may destabilise, so every multiplier at that amplitude stays inside the circle.
    A, _, period = mathieu("1", "0")
    found = periodic.quadratic_stability_radius(A, matrix("0\n1"), matrix("1 0"))
    pump = matrix([[fmpq(0), fmpq(0)], [from_float(float(found.lower())), fmpq(0)]])
    assert periodic.spectral_radius(periodic.monodromy(A, [periodic.Mode(pump, fmpq(2), fmpq(0))], period)) < 1
    norm = hinf_norm(A, matrix("0\n1"), matrix("1 0"), matrix("0"), rtol=1e-9).value
    # Closed form: damping 0.1 at w0 = 1 gives 1/(0.1 sqrt(1 - 0.1^2/4)).
    assert norm.contains(1 / (arb(fmpq(1, 10)) * (1 - arb(fmpq(1, 400))).sqrt()))
