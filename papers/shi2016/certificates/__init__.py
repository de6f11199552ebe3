"""Proofs by name; each function returns one certificate of `recontrol.lmi.proof`."""
