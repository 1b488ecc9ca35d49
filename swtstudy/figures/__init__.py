"""Figures in the layout of the paper, from an archive alone."""
