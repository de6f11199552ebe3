"""Figures of shi2016: each function returns the drawing and the curves in it."""
