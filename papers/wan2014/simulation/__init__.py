"""Experiments on the exact two-body motion and on the paper's linear model; each part returns (values, series)."""
