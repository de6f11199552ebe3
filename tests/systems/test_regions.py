"""Disk regions: proofs for boxes of matrices."""

import numpy as np
import pytest

from recontrol.exact.ball import box
from recontrol.exact.rational import matrix, to_float, zeros
from recontrol.systems import regions

# Companion matrix of (s + 1)(s + 1/2): poles -1 and -1/2, by construction.
A = matrix([["0", "1"], ["-1/2", "-3/2"]])


def test_radius_is_the_largest_distance_from_the_centre():
    assert regions.disk_radius(np.linalg.eigvals(to_float(A)), 0.75) == pytest.approx(0.25)


def test_proof_succeeds_inside_and_fails_outside():
    assert regions.prove_in_disk(A, "0.75", "0.26") is not None
    assert regions.prove_in_disk(A, "0.75", "0.24") is None


def test_a_box_is_proven_only_while_all_of_it_is_inside():
    def half(width):
        return zeros(2) + matrix([[width, width], [width, width]])

    assert regions.prove_in_disk(box(A, half("1/1000")), "0.75", "0.4") is not None
    # Entry (2,1) = -1/2 + 0.3 gives poles -1.35 and -0.15, 0.6 from the centre.
    assert regions.prove_in_disk(box(A, half("3/10")), "0.75", "0.4") is None


def test_a_certificate_of_another_matrix_is_refused():
    P = regions.prove_in_disk(A, "0.75", "0.26")
    assert regions.verify_in_disk(A, P, "0.75", "0.26")
    assert not regions.verify_in_disk(A + A, P, "0.75", "0.26")
    assert not regions.verify_in_disk(A, -P, "0.75", "0.26")
