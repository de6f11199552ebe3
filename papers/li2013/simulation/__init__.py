"""Experiments, one part each: the linear loop, the nonlinear one, the functional along it, and gains of d_bar -> z."""
