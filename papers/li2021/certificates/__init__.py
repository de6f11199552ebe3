"""Proofs that a reader can check again with ``recontrol verify``; each function gives one certificate."""
