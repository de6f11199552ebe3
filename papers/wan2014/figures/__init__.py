"""Figures of wan2014: the paper's, redrawn from the two-body motion, and the findings."""
