"""Gains of the recipe, LQR by other routes, rejected recipes, and how sharply the print identifies the weights."""
