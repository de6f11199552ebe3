"""hashim2015: what carries the verdicts, by a second route (Riccati solvers, corners of boxes, random gains)."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq
from scipy.linalg import solve_continuous_are

from papers.hashim2015 import analysis, certificates, identities, intervals, loops, recipe
from papers.hashim2015.quantities.loops import enclosures, sign_overlap
from papers.hashim2015.readings import formulas, misprints, sentences, words
from papers.hashim2015.readings import gains as design
from papers.hashim2015.readings import loops as loop_readings
from papers.hashim2015.simulation import designs
from papers.hashim2015.simulation.sweep import sweep
from papers.hashim2015.synthesis.identifiability import row_of_52
from papers.hashim2015.synthesis.lqr import EnclosureError, lower_end, moment, upper_end
from recontrol.claims.identity import equal
from recontrol.exact import ball, rational
from recontrol.exact import polynomial as poly
from recontrol.lmi import verify
from tests.papers.hashim2015_artifacts import DATA, MODEL, SYNTHESIS

AXES = ("yaw", "pitch-tf", "pitch-ss", "roll")


def floats(axis: str) -> tuple[np.ndarray, ...]:
    entry = MODEL[axis]
    return entry["A"], entry["B"], entry["C"]


@pytest.mark.parametrize("axis", AXES)
def test_spectral_factor_gain_solves_the_riccati_equation(axis):
    A, B, C = floats(axis)
    K = B.T @ solve_continuous_are(A, B, C.T @ C, np.eye(1))
    # CARE by Schur vectors on data of order one: 1e-12 leaves three digits of reserve.
    assert np.allclose(SYNTHESIS["gains"][axis]["K"], K, rtol=0, atol=1e-12)


@pytest.mark.parametrize("axis", AXES)
def test_estimator_is_the_kalman_filter_of_ten_times_bb(axis):
    A, B, C = floats(axis)
    L = solve_continuous_are(A.T, C.T, 10 * B @ B.T, np.eye(1)) @ C.T
    # L is ill-conditioned against the poles; 1e-10 is what the filter equation reaches.
    assert np.allclose(SYNTHESIS["gains"][axis]["L"]["exact"], L, rtol=1e-10, atol=1e-10)


def test_the_unpaired_pole_contributes_its_real_part():
    poles = [(fmpq(-1), fmpq(2)), (fmpq(-1), fmpq(-2)), (fmpq(-3), fmpq(4))]
    expected = np.poly([-1 + 2j, -1 - 2j, -3 + 4j]).real
    assert np.allclose([float(c) for c in reversed(recipe.typed_poly(poles).coeffs())], expected, atol=1e-14)


def test_rounding_poles_refuses_a_tie():
    with pytest.raises(ValueError, match="cannot be rounded"):
        recipe.decimal_round(ball.ball("0.5", "0.1"), 0)
    assert recipe.decimal_round(ball.ball("-0.14850291"), 4) == fmpq(-1485, 10**4)


@pytest.mark.parametrize("name", sorted(n for n in vars(formulas) if n.startswith("eq")))
def test_derived_formulas_hold(name):
    identity = getattr(formulas, name)()
    assert equal(identity.left, identity.right)


MISPRINTED = {**vars(misprints), **vars(sentences)}


@pytest.mark.parametrize("name", sorted(n for n in MISPRINTED if n.startswith(("eq2", "eq3", "eq4", "s24"))))
def test_misprinted_formulas_fail_and_their_corrections_hold(name):
    result = MISPRINTED[name]()
    assert not equal(result.value.left, result.value.right)
    assert all(value is not False for key, value in result.evidence.items() if "as printed" not in key)


def test_loop_separates_only_with_the_correct_sign():
    plant, K, L = misprints.random_design(seed=11)
    design = recipe.reduced_matrices(plant, K, L)
    M = misprints.x1_loop(plant, design.A, design)
    parts = poly.charpoly(plant.A - plant.B @ K) * poly.charpoly(plant.A[1:, 1:] - L @ plant.A[:1, 1:])
    assert parts == M


def vertices(count: int) -> list[dict[str, np.ndarray]]:
    """Random corners of the rounding box of (66)-(69)."""
    rng = np.random.default_rng(3)
    centre, half = loops.printed_reduced(lambda name: DATA[name]), loops.printed_reduced(DATA.half)
    out = []
    for _ in range(count):
        corner = {}
        for name, M in centre.items():
            signs = rng.choice([-1.0, 1.0], size=M.shape)
            corner[name] = rational.to_float(M) + signs * rational.to_float(half[name])
        out.append(corner)
    return out


def test_corners_of_the_box_agree_with_the_proofs():
    A, B, C = floats("yaw")
    yaw = recipe.Plant(A, B, C)

    def abscissa(c, corner):
        M = np.block([[yaw.A + B @ corner["D_r"] @ c, B @ corner["C_r"]], [corner["B_r"] @ c, corner["A_r"]]])
        return np.linalg.eigvals(M).real.max()

    for corner in vertices(60):
        assert abscissa(np.eye(1, 4), corner) < -0.1
        assert abscissa(C, corner) > 0.2


def test_coefficient_ranges_hold_the_corners():
    polynomials = intervals.coefficient_polynomials(MODEL, DATA)
    ends = [intervals.coefficient_range(c, fmpq(1)) for c in polynomials]
    A, B, _ = floats("yaw")
    for corner in vertices(40):
        M = np.block(
            [[A + B @ corner["D_r"] @ np.eye(1, 4), B @ corner["C_r"]], [corner["B_r"] @ np.eye(1, 4), corner["A_r"]]]
        )
        found = np.poly(M)[:0:-1]
        assert all(float(low) - 1e-9 <= x <= float(high) + 1e-9 for x, (low, high) in zip(found, ends, strict=True))


def test_kharitonov_refuses_what_one_polynomial_refutes():
    ends = [(fmpq(1), fmpq(1)), (fmpq(-1), fmpq(1))]
    assert any(poly.is_hurwitz(corner) is not True for corner in poly.kharitonov_corners(ends))


def test_null_vector_of_the_printed_zero_numerically():
    rng = np.random.default_rng(5)
    A, B, C = floats("yaw")
    for _ in range(5):
        K, L = rng.normal(size=(1, 4)), rng.normal(size=(4, 1))
        Ah = A - B @ K - L @ C
        Ah[1, 0] = 0.0
        M = np.block([[A, -B @ K], [L @ C, Ah]])
        # |det| over a typical product of eigenvalues: zero to rounding.
        assert np.linalg.svd(M, compute_uv=False)[-1] < 1e-13
    assert identities.ace_null_vector_holds(recipe.plant_of(MODEL, "yaw"))
    assert identities.pitch_error_pole_is_zero()


def test_columns_of_66_exclude_each_other_with_the_printed_sign():
    overlap = sign_overlap(MODEL, DATA)
    assert overlap["printed sign"][0, 0] < -10
    assert all(width > 0 for width in overlap["derived sign"].flat)
    meets = enclosures(DATA, MODEL, SYNTHESIS)["print_meets_enclosure"]
    assert len(meets) == 6
    assert all(meets.values())


def test_weights_outside_the_intervals_give_other_digits():
    plant = recipe.plant_of(MODEL, "yaw")
    holds = row_of_52(plant, DATA)
    assert holds(fmpq(1)) is True
    A, B, C = floats("yaw")
    for q in (0.99998, 1.00006):
        row = (A - B @ (B.T @ solve_continuous_are(A, B, q * C.T @ C, np.eye(1))))[0]
        deviation = np.abs(row - DATA.float("A_c")[0]).max()
        assert deviation > 5e-5
        assert holds(rational.from_float(q)) is False


@pytest.mark.parametrize("axis", AXES)
def test_lqr_cost_lies_in_its_enclosure(axis):
    A, B, C = floats(axis)
    plant = recipe.plant_of(MODEL, axis)
    trace = np.trace(solve_continuous_are(A, B, C.T @ C, np.eye(1)))
    low, high = float(lower_end(plant)), float(upper_end(plant))
    # The float Riccati solution is good to 1e-12.
    assert low - 1e-12 <= trace <= high + 1e-12
    assert high - low < 1e-7


def test_a_gain_that_does_not_stabilise_bounds_nothing():
    with pytest.raises(EnclosureError):
        moment(recipe.plant_of(MODEL, "yaw"), rational.matrix("-1 0 0 1"))


def test_members_of_55_have_opposite_verdicts_within_half_a_unit():
    members = analysis.deciding_members(MODEL, DATA)
    assert np.linalg.eigvals(members["stable member"].astype(float)).real.max() < -1e-3
    assert np.linalg.eigvals(members["unstable member"].astype(float)).real.max() > 1e-3
    block = analysis.lower_right(DATA, "ace-print")
    for M in members.values():
        moved = M[4:, 4:] - block
        assert all(abs(x) <= h for x, h in zip(moved.ravel(), DATA.half("A_ce")[4:, 4:].ravel(), strict=True))
        assert all(x == 0 for x, b in zip(moved.ravel(), block.ravel(), strict=True) if b == 0)


@pytest.mark.parametrize("name", ["inverse_lqr", "loop_full", "box_x1", "ace_stable", "ace_unstable"])
def test_certificates_of_the_print_verify_and_rebuild(name):
    certificate = getattr(certificates, name)(DATA)
    found = verify.check(certificate)
    assert found.holds
    assert "rebuilt from papers/hashim2015" in found.why
    tampered = {**certificate, "says": "something else"}
    assert not verify.check(tampered).holds


class Altered:
    """The paper's data with some values replaced."""

    def __init__(self, **values):
        self.values = values

    def __getitem__(self, name):
        return self.values[name] if name in self.values else DATA[name]

    def __getattr__(self, name):
        return getattr(DATA, name)


@pytest.mark.parametrize(
    ("reading", "cited", "right"),
    [
        (words.s1_cite14, "source_cited", fmpq(15)),
        (words.eq16_ref, "plant_cited", fmpq(4)),
        (words.s3_subst, "blocks_cited", np.array([[fmpq(58), fmpq(65)]], dtype=object)),
    ],
)
def test_a_citation_is_wrong_as_printed_and_right_with_the_number_that_is_meant(reading, cited, right):
    printed, corrected = reading(Altered()).value, reading(Altered(**{cited: right})).value
    assert not equal(printed.left, printed.right)
    assert equal(corrected.left, corrected.right)


def test_titles_beside_a_citation_are_those_of_the_reference_list():
    evidence = words.s1_cite14(DATA).evidence
    assert "Panels" in evidence["title of [14]"]
    assert "Space Satellite" in evidence["title of [15]"]


def test_the_printed_input_weight_scales_the_weights_of_the_states():
    one, two = (design.s22_bryson(MODEL, Altered(weight_R=R)).value.margins for R in (fmpq(1), fmpq(2)))
    assert all(two[name].contains(2 * one[name].mid()) for name in one)


def test_sweep_spans_the_printed_weights():
    _, series = sweep({axis: MODEL[axis] for axis in designs.AXES}, DATA)
    assert (series["q"][0], series["q"][-1]) == pytest.approx((DATA.float("weight_low"), DATA.float("weight_high")))


def test_error_is_driven_by_the_state_only_with_another_compensator():
    plant, K, L = recipe.plant_of(MODEL, "yaw"), loops.printed_gain(DATA), DATA["L"]
    due = plant.A - plant.B @ K - L @ plant.C
    for compensator, driven in ((due, False), (due + plant.B @ K, True)):
        M = loop_readings.in_error_states(loops.full_loop(plant, K, L, compensator))
        assert bool((M[4:, :4] != 0).any()) is driven
    assert not loop_readings.eq55_21(MODEL, DATA).any()
