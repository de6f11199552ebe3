"""Reproduction of published control papers, number by number."""
