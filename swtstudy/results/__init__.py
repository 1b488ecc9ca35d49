"""Evaluating results: slices, extrema, fits and optima of any Dataset; fields and inspection of one point."""
