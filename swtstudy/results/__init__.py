"""Evaluating results: slices, normalised curves, extrema and tables of any Dataset of this package."""
