"""Readings of the claims, by topic; claims.yaml names them as ``module.function``."""
