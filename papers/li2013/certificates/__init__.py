"""Certificates by topic; each function is named in paper.yaml under stages.certificates."""
