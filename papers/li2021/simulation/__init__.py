"""Experiments: attitude runs (Figs 4-7), one orbit, random gains (Figs 8, 9), constant random gains, integrators."""
