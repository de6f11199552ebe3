"""Experiments of hashim2015, one part each; see the module of a part for what its artifact holds."""
