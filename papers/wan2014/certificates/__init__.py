"""Proofs that `recontrol verify` checks again; the synthesis searched, here mostly exact arithmetic remains."""
