"""The physics on plain arrays: NumPy and SciPy only, batch axes leading, no labels and no files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swtstudy.mechanics.points import REGIMES, Points, Solution

if TYPE_CHECKING:
    from swtstudy.mechanics.solver import solve_points

__all__ = ["REGIMES", "Points", "Solution", "solve_points"]


def __getattr__(name: str) -> object:
    # Imported on first use: a run asks for points before its workers start, and those solve.
    if name != "solve_points":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from swtstudy.mechanics.solver import solve_points

    return solve_points
