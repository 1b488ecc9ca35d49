"""One parameter point from keywords, as given: its phase is not folded, so that time keeps its origin."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import numpy as np

from swtstudy.mechanics.load.loop import Loop
from swtstudy.mechanics.points import Points
from swtstudy.mechanics.stress.scene import Scene, scene_of
from swtstudy.points.canonical import NUMBERS
from swtstudy.points.reading import read_grid
from swtstudy.points.values import as_number
from swtstudy.vocabulary.families import family_of
from swtstudy.vocabulary.mistakes import StudyError


def read_point(parameters: Mapping[str, object]) -> Points:
    """A batch of one point.

    Parameters
    ----------
    parameters
        Single values by name, as for `swtstudy.solve`; the others have the values of Table 1.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters.
    """
    grid, mistakes = read_grid(dict(parameters), {})
    if grid is None:
        raise StudyError(mistakes)
    profile = grid.fixed["profile"]
    ratio = Fraction(str(grid.fixed["frequency_ratio"]))

    def number(name: str) -> np.ndarray:
        return np.array([as_number(grid.fixed[grid.control.given_for(name)])])

    course = grid.fixed["load"]
    return Points(
        profile=profile,  # type: ignore[arg-type]
        p=np.array([ratio.numerator]),
        q=np.array([ratio.denominator]),
        shape={name: number(name) for name in family_of(profile).shape},
        control=grid.control,
        path=course if isinstance(course, Loop) else None,
        criterion=str(grid.fixed["criterion"]),
        **{name: number(name) for name in NUMBERS},
    )


def read_scene(parameters: Mapping[str, object]) -> Scene:
    """The contact cycle of one point; see `read_point`."""
    return scene_of(read_point(parameters))
