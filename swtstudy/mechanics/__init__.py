"""The physics on plain arrays: NumPy and SciPy only, batch axes leading, no labels and no files."""
