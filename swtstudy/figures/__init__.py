"""Figures drawn from an archive alone, by default in the layout of the paper."""
