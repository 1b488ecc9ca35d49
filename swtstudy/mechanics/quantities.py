"""Quantities that are asked of points beside s, in batches of bounded memory."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from swtstudy.mechanics.control.force import unit_half_load
from swtstudy.mechanics.points import FloatArray, Points
from swtstudy.mechanics.solver import _scenes
from swtstudy.mechanics.stress import work
from swtstudy.quantities import QUANTITIES, variables_of


def quantities_of(points: Points, names: Sequence[str]) -> dict[str, FloatArray]:
    """Quantities of points.

    Parameters
    ----------
    points
        n points of one profile family.
    names
        Some of `swtstudy.quantities.QUANTITIES`.

    Returns
    -------
    dict
        By data variable, of shape (n,); NaN where there is no cycle.
    """
    found = {variable: np.full(len(points), np.nan) for variable in variables_of(names)}
    for index, scene in _scenes(points):
        some = points.take(index)
        unit = unit_half_load(some.profile, some.shape, len(index))
        for name in names:
            row = QUANTITIES[name]
            made = getattr(work, row.function)(scene, unit)
            for variable, values in zip(row.variables, made if row.has_error else (made,), strict=True):
                found[variable][index] = values
    return found
