"""Certificates by topic; each function is named in paper.yaml under stages.certificates."""

from .decay import controls, decay_box, functional, hurwitz_box, minus_unstable, reject_zero
from .limits import (
    alpha_below,
    design_10,
    design_15,
    design_20,
    h_a0_above,
    h_a0_below,
    h_a02_above,
    h_a02_below,
    reject_minus,
    reject_minus10,
)
from .performance import d_only, equilibrium_linear, equilibrium_square, linear_K, linear_minus, pair_square
from .void import print_K, print_minus, void_K, void_minus, void_zero

__all__ = [
    "alpha_below",
    "controls",
    "d_only",
    "decay_box",
    "design_10",
    "design_15",
    "design_20",
    "equilibrium_linear",
    "equilibrium_square",
    "functional",
    "h_a0_above",
    "h_a0_below",
    "h_a02_above",
    "h_a02_below",
    "hurwitz_box",
    "linear_K",
    "linear_minus",
    "minus_unstable",
    "pair_square",
    "print_K",
    "print_minus",
    "reject_minus",
    "reject_minus10",
    "reject_zero",
    "void_K",
    "void_minus",
    "void_zero",
]  # fmt: skip
