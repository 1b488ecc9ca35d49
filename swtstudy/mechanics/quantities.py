"""Quantities that are asked of points beside s, in batches of bounded memory.

Means over a critical distance are taken about whichever place of the surface line has most of them: the
critical point has the largest swt, but about another local maximum swt may fall off more slowly.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from swtstudy.kernel.batch import cycle_batch, maxima_batch
from swtstudy.kernel.field import largest_radius, open_cycle
from swtstudy.mechanics.body.nonlocal_swt import OF_VALUE, NonlocalSwt, nonlocal_swt
from swtstudy.mechanics.body.von_mises import largest_von_mises
from swtstudy.mechanics.counted import FewCycles
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray, Points, Solution
from swtstudy.mechanics.solver import arguments_of
from swtstudy.vocabulary.quantities import COUNTED, NAMED, NONLOCAL, YIELD, Quantity, Request, error_of

#: Quantities of the cycle, by their names in `swtstudy.kernel.work.OF_CYCLE`.
OF_CYCLE = ("work", "stick_radius", "contact_radius", "force_ratio")
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
    others = maxima_batch(*limits, **arguments_of(points.take(rows)), rtol=CANDIDATE_TOLERANCE)
    for row, maxima in zip(rows, others, strict=True):
        one, tried = points.take(np.array([row])), [float(position[row])]
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
        found |= {name: getattr(means, key) for row in NONLOCAL.values() for name, key in _fields(row)}
    if asked.counts:
        cycles = FewCycles.of(points, solution)
        found |= {name: getattr(cycles, row.function) for name, row in COUNTED.items()}
    return found


def _fields(row: Quantity) -> Iterator[tuple[str, str]]:
    """The data variables of a quantity, and the names of what has them."""
    return zip(row.variables, (row.function, error_of(row.function)), strict=False)


def _nonlocal(points: Points, solution: Solution, distances: Sequence[float]) -> NonlocalSwt:
    made = worst_means(points, solution, np.array(distances))
    # Where s is 0, or that of the bulk stress far from the contact, no mean anywhere is larger.
    rows = np.flatnonzero(np.isnan(solution.critical_x) & np.isfinite(solution.s))
    for kind in KINDS:
        for name, own in ((kind, solution.s), (f"{kind}_error", solution.s_error)):
            means = getattr(made, name)
            means[rows] = align(own[rows], means)
    return made
