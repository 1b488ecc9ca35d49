"""Quantities that are asked of points beside s."""

from __future__ import annotations

import numpy as np

from swtstudy.kernel.batch import cycle_batch
from swtstudy.solver.counted import few_cycles
from swtstudy.solver.means import worst_means
from swtstudy.solver.points import Points, Solution
from swtstudy.solver.solve import arguments_of
from swtstudy.solver.von_mises import largest_von_mises
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.quantities import NAMED, STICK_ENDS, YIELD, Request, error_of

#: Quantities of the cycle, by their names in `swtstudy.kernel.work.OF_CYCLE`.
OF_CYCLE = ("work", "stick_radius", *STICK_ENDS, "contact_radius", "force_ratio")


def quantities_of(points: Points, asked: Request, solution: Solution) -> dict[str, FloatArray]:
    """Quantities of points.

    Parameters
    ----------
    points
        n points of one profile family and control.
    asked
        The quantities asked for; distances in a_H.
    solution
        Their solution.

    Returns
    -------
    dict
        By data variable, of shape (n, …) with the row's own dimensions, the distances first; NaN
        where there is no cycle, and the nonlocal ones where s is not finite.
    """
    made: dict[str, FloatArray] = {}
    functions = {row.function for row in asked.rows}
    if functions & {*OF_CYCLE}:
        cycles = cycle_batch("force_ratio" in functions, **arguments_of(points))
        made |= {name: cycles[name].copy() for name in cycles.dtype.names}
    if YIELD in asked.names:
        made[NAMED[YIELD].function] = largest_von_mises(points)
    if asked.distances:
        made |= worst_means(points, solution, np.array(asked.distances))
    if asked.counts:
        made |= few_cycles(points, solution)
    return {
        name: made[key]
        for row in asked.rows
        for name, key in zip(row.variables, (row.function, error_of(row.function)), strict=False)
    }
