"""Quantities that are asked of points beside s, in batches of bounded memory."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from swtstudy.mechanics.body import von_mises
from swtstudy.mechanics.control.force import unit_half_load
from swtstudy.mechanics.line.few_cycles import FewCycles
from swtstudy.mechanics.points import FloatArray, Points, Solution
from swtstudy.mechanics.solver import scenes
from swtstudy.mechanics.stress import work
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.mechanics.worst_means import worst_means
from swtstudy.vocabulary.quantities import (
    COUNTED,
    COUNTS,
    NAMED,
    NONLOCAL,
    YIELD,
    Request,
    columns_in,
    columns_of,
    error_of,
    item_of,
)


def quantities_of(points: Points, items: Sequence[str], solution: Solution) -> dict[str, FloatArray]:
    """Quantities of points.

    Parameters
    ----------
    points
        n points of one profile family and control.
    items
        What is asked, as in `swtstudy.vocabulary.quantities.Request.items`.
    solution
        Their solution.

    Returns
    -------
    dict
        By `swtstudy.vocabulary.quantities.columns_of`, of shape (n,); NaN where there is no cycle, and the
        nonlocal ones where there is no critical point.
    """
    asked = Request.of(items)
    found = {column: np.full(len(points), np.nan) for column in columns_of(items)}
    for index, scene in scenes(points):
        some = points.take(index)
        parts = _of_cycles(scene, unit_half_load(some.profile, some.shape, len(index)), asked.names)
        place = solution.critical_x[index], solution.critical_angle[index]
        if asked.distances:
            parts |= _nonlocal(scene, *place, asked.distances)
        if asked.counts:
            parts |= _counted(scene, *place)
        for column, values in parts.items():
            found[column][index] = values
    return found


def _of_cycles(scene: Scene, unit: FloatArray, names: Sequence[str]) -> dict[str, FloatArray]:
    found: dict[str, FloatArray] = {}
    for name in names:
        row = NAMED[name]
        function = getattr(von_mises if name == YIELD else work, row.function)
        made = function(scene, unit)
        found |= zip(row.variables, made if row.has_error else (made,), strict=True)
    return found


def _nonlocal(
    scene: Scene, position: FloatArray, angle: FloatArray, distances: Sequence[float]
) -> dict[str, FloatArray]:
    made = worst_means(scene, position, angle, np.array(distances))
    found: dict[str, FloatArray] = {}
    for row in NONLOCAL.values():
        for variable, function in zip(row.variables, (row.function, error_of(row.function)), strict=False):
            for values, distance in zip(np.moveaxis(getattr(made, function), 1, 0), distances, strict=True):
                columns = columns_in(row, variable, item_of(distance))
                found |= zip(columns, values.reshape(len(values), -1).T, strict=True)
    return found


def _counted(scene: Scene, position: FloatArray, angle: FloatArray) -> dict[str, FloatArray]:
    made = FewCycles.of(scene, position, np.radians(2.0 * angle))
    found: dict[str, FloatArray] = {}
    for row in COUNTED.values():
        values = getattr(made, row.function).reshape(len(position), -1)
        found |= zip(columns_in(row, row.name, COUNTS), values.T, strict=True)
    return found
