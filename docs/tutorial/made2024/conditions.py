"""Loops and exact data of the certificates."""

import numpy as np


def loop(data, A_k):
    """State matrix (4, 4) of the loop: plant and controller u = C_k x_k, measured y = C2 x."""
    return np.block([[data["A"], data["B2"] @ data["C_k"]], [data["B_k"] @ data["C2"], A_k]])


def problem_data(data, case):
    """Data of a certificate for the verifier: `case` is a name of paper.yaml, A_k or A_k_mended."""
    return {"M": loop(data, data[case])}
