"""Figures of hashim2015: each function returns the drawing and the curves in it."""
