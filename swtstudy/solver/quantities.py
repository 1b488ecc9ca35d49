"""Quantities that are asked of points beside s, in batches of bounded memory.

Means over a critical distance are taken about whichever place of the surface line has most of them: the
critical point has the largest swt, but about another local maximum swt may fall off more slowly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from swtstudy.kernel.batch import cycle_batch, maxima_batch
from swtstudy.kernel.field import largest_radius, open_cycle
from swtstudy.solver.counted import FewCycles
from swtstudy.solver.nonlocal_swt import OF_VALUE, NonlocalSwt, nonlocal_swt
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
#: What each place may be the worst of.
KINDS = ("volume", "point", "line")


#: Relative accuracy of swt at local maxima.
CANDIDATE_TOLERANCE = 1e-4
#: Maxima nearer to one another than this share of the contact radius are one: a smooth maximum is found to
#: the root of the accuracy.
SAME_MAXIMUM = 0.01


def worst_means(points: Points, solution: Solution, distance: FloatArray) -> NonlocalSwt:
    """The largest values over critical distances among those about the critical points and other maxima.

    Each kind, distance and direction has its own place. Another local maximum of swt along the line is tried
    if its swt is above one of the values found so far: no mean about it could be larger otherwise, but where
    what is nearby is higher, which is tried itself.

    Parameters
    ----------
    points, solution
        n points and their solution.
    distance
        As of `nonlocal_swt`.
    """
    position = solution.critical_x
    found = nonlocal_swt(points, position, solution.critical_angle, distance)
    rows = np.flatnonzero(np.isfinite(position))
    if not rows.size:
        return found
    limits = np.maximum(_least(found)[rows], 0.0), solution.s[rows]
    others = maxima_batch(*limits, **arguments_of(points[rows]), rtol=CANDIDATE_TOLERANCE)
    for row, maxima in zip(rows, others, strict=True):
        one, tried = points[[row]], [float(position[row])]
        near = SAME_MAXIMUM * largest_radius(open_cycle(**arguments_of(one)))
        for x, double_angle, swt in zip(*maxima, strict=True):
            if swt <= _least(found)[row] or np.abs(np.array(tried) - x).min() <= near:
                continue
            tried.append(float(x))
            degrees = np.degrees(0.5 * double_angle)
            own = nonlocal_swt(one, np.array([x]), np.array([degrees]), distance)
            found = _larger(found, int(row), own)
    return found


def _least(found: NonlocalSwt) -> FloatArray:
    """The smallest of the values of n points, shape (n,)."""
    return np.concatenate(
        [getattr(found, kind).reshape(len(found.volume), -1) for kind in KINDS], axis=1
    ).min(axis=1)


def _larger(found: NonlocalSwt, row: int, other: NonlocalSwt) -> NonlocalSwt:
    """With the values of another place in a row, where they are larger."""
    changed = {}
    for kind in KINDS:
        # It is not by noise that one of two is taken.
        worse = getattr(other, kind)[0] > (1.0 + OF_VALUE) * getattr(found, kind)[row]
        for name in (kind, f"{kind}_error", f"{kind}_x"):
            values = getattr(found, name).copy()
            values[row] = np.where(worse, getattr(other, name)[0], values[row])
            changed[name] = values
    return replace(found, **changed)


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
