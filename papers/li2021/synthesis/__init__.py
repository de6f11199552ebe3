"""Designs and analyses; each part is one job."""
