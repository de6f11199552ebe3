"""Solver runs by topic: points for the certificates, margins, optimal values, largest periods, gains, bounds."""
