"""Quantities that are asked of points beside s."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from swtstudy.kernel.batch import cycle_batch
from swtstudy.solver.counted import FewCycles
from swtstudy.solver.means import KINDS, worst_means
from swtstudy.solver.points import Points, Solution
from swtstudy.solver.solve import arguments_of
from swtstudy.solver.von_mises import largest_von_mises
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.quantities import (
    COUNTED,
    COUNTS,
    NAMED,
    NONLOCAL,
    STICK_ENDS,
    YIELD,
    Request,
    columns_in,
    columns_of,
    error_of,
    item_of,
)

#: Quantities of the cycle, by their names in `swtstudy.kernel.work.OF_CYCLE`.
OF_CYCLE = ("work", "stick_radius", *STICK_ENDS, "contact_radius", "force_ratio")


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
        nonlocal ones where s is not finite.
    """
    asked = Request.of(items)
    found = {column: np.full(len(points), np.nan) for column in columns_of(items)}
    names = [name for name in asked.names if NAMED[name].function in OF_CYCLE]
    if names:
        found |= _of_cycles(points, names)
    if YIELD in asked.names:
        found[YIELD] = largest_von_mises(points)
    if asked.distances:
        found |= _nonlocal(points, solution, asked.distances)
    if asked.counts:
        found |= _counted(points, solution)
    return found


def _of_cycles(points: Points, names: Sequence[str]) -> dict[str, FloatArray]:
    """Quantities of the cycle by column."""
    rows = [NAMED[name] for name in names]
    with_ratio = any(row.function == "force_ratio" for row in rows)
    made = cycle_batch(with_ratio, **arguments_of(points))
    found: dict[str, FloatArray] = {}
    for row in rows:
        columns = row.function, error_of(row.function)
        found |= {name: made[key].copy() for name, key in zip(row.variables, columns, strict=False)}
    return found


def _nonlocal(points: Points, solution: Solution, distances: Sequence[float]) -> dict[str, FloatArray]:
    made = worst_means(points, solution, np.array(distances))
    # Where s is 0, or that of the bulk stress far from the contact, no mean anywhere is larger.
    rows = np.flatnonzero(np.isnan(solution.critical_x) & np.isfinite(solution.s))
    for kind in KINDS:
        for name, own in ((kind, solution.s), (f"{kind}_error", solution.s_error)):
            means = getattr(made, name)
            means[rows] = own[rows].reshape(-1, *(1,) * (means.ndim - 1))
    found: dict[str, FloatArray] = {}
    for row in NONLOCAL.values():
        for variable, function in zip(row.variables, (row.function, error_of(row.function)), strict=False):
            for values, distance in zip(np.moveaxis(getattr(made, function), 1, 0), distances, strict=True):
                columns = columns_in(row, variable, item_of(distance))
                found |= zip(columns, values.reshape(len(values), -1).T, strict=True)
    return found


def _counted(points: Points, solution: Solution) -> dict[str, FloatArray]:
    made = FewCycles.of(points, solution)
    found: dict[str, FloatArray] = {}
    for row in COUNTED.values():
        values = getattr(made, row.function).reshape(len(points), -1)
        found |= zip(columns_in(row, row.name, COUNTS), values.T, strict=True)
    return found
