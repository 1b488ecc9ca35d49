"""Points by named columns: the grid that a user spans, its distinct points, solving, and results."""
