"""The physics on plain arrays: NumPy and SciPy only, batch axes leading, no labels and no files."""

from swtstudy.mechanics.points import REGIMES, Points, Solution
from swtstudy.mechanics.solver import solve_points

__all__ = ["REGIMES", "Points", "Solution", "solve_points"]
