"""Quantities that are asked of points beside s."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from swtstudy.kernel.batch import cycle_batch
from swtstudy.solver.counted import few_cycles
from swtstudy.solver.means import KINDS, Means, worst_means
from swtstudy.solver.points import Points, Solution
from swtstudy.solver.solve import arguments_of
from swtstudy.solver.von_mises import largest_von_mises
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.quantities import (
    COUNTED,
    NAMED,
    NONLOCAL,
    STICK_ENDS,
    YIELD,
    Quantity,
    Request,
    error_of,
)

#: Quantities of the cycle, by their names in `swtstudy.kernel.work.OF_CYCLE`.
OF_CYCLE = ("work", "stick_radius", *STICK_ENDS, "contact_radius", "force_ratio")


def quantities_of(points: Points, asked: Request, solution: Solution) -> dict[str, FloatArray]:
    """Quantities of points.

    Parameters
    ----------
    points
        n points of one profile family and control.
    asked
        What is asked; distances in a_H.
    solution
        Their solution.

    Returns
    -------
    dict
        By data variable, of shape (n, …) with the row's own dimensions, that of the distances first; NaN
        where there is no cycle, and the nonlocal ones where s is not finite.
    """
    found: dict[str, FloatArray] = {}
    of_cycle = [NAMED[name] for name in asked.names if NAMED[name].function in OF_CYCLE]
    if of_cycle:
        with_ratio = any(row.function == "force_ratio" for row in of_cycle)
        made = cycle_batch(with_ratio, **arguments_of(points))
        found |= {name: made[key].copy() for row in of_cycle for name, key in _fields(row)}
    if YIELD in asked.names:
        found[YIELD] = largest_von_mises(points)
    if asked.distances:
        means = _nonlocal(points, solution, asked.distances)
        found |= {name: means[key] for row in NONLOCAL.values() for name, key in _fields(row)}
    if asked.counts:
        cycles = few_cycles(points, solution)
        found |= {name: cycles[row.function] for name, row in COUNTED.items()}
    return found


def _fields(row: Quantity) -> Iterator[tuple[str, str]]:
    """The data variables of a quantity, and the names of what has them."""
    return zip(row.variables, (row.function, error_of(row.function)), strict=False)


def _nonlocal(points: Points, solution: Solution, distances: Sequence[float]) -> Means:
    made = worst_means(points, solution, np.array(distances))
    # Where s is 0, or that of the bulk stress far from the contact, no mean anywhere is larger.
    rows = np.flatnonzero(np.isnan(solution.critical_x) & np.isfinite(solution.s))
    for kind in KINDS:
        for name, own in ((kind, solution.s), (f"{kind}_error", solution.s_error)):
            made[name][rows] = own[rows].reshape(-1, *(1,) * (made[name].ndim - 1))
    return made
