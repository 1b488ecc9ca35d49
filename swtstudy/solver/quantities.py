"""Quantities that are asked of points beside s, and strain cycles of a round of the load as few numbers.

The strain of a plane is counted by rainflow, each cycle with its own amplitude and its own largest σ_n: a
swt of its own (`swtstudy.kernel.cycles`). A round does the damage Σ 1/N(SWT_i), which depends on a material's
constants; so the cycles themselves are kept, divided by the largest swt: cycles that are alike are one, with
how many they are.
"""

from __future__ import annotations

import numpy as np

from swtstudy.kernel.batch import count_batch, cycle_batch
from swtstudy.solver.means import worst_means
from swtstudy.solver.points import Points, Solution, arguments_of
from swtstudy.solver.von_mises import largest_von_mises
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.quantities import COUNTED_SIZES, YIELD, Request

#: Data variables that the kernel has by other names.
_OF_CYCLE = {"work": "dissipation", "work_error": "dissipation_error"}
#: Cycles whose SWT differ by less than this, relative, are equal.
EQUAL = 1e-6
#: Cycles are alike whose logarithms of SWT differ by less than a width times that to the largest SWT plus so
#: much; the first width with which they are few enough. So are 300 random cycles 8, with a damage that is
#: right to 14 % for lives that go with SWT to the minus 1 to 9. 0.4 instead of 0.05: 27 %.
WIDTHS, LEAST_DEPTH = 1e-3 * 1.5 ** np.arange(25), 0.05
#: Cycles that are alike have the mean of this power of SWT, so that a life which goes with SWT to the minus
#: this power stays as it is.
POWER = 4.0


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
    if {*asked.names} - {YIELD}:
        cycles = cycle_batch("force_ratio" in asked.names, **arguments_of(points))
        made |= {_OF_CYCLE.get(name, name): cycles[name].copy() for name in cycles.dtype.names}
    if YIELD in asked.names:
        made[YIELD] = largest_von_mises(points)
    if asked.distances:
        made |= worst_means(points, solution, np.array(asked.distances))
    if asked.counts:
        made |= few_cycles(points, solution)
    return {name: made[name] for row in asked.rows for name in row.variables}


def few_cycles(points: Points, solution: Solution) -> dict[str, FloatArray]:
    """Strain cycles in a round of n points with their solution, of shape (n, places, cycles).

    `COUNTED_SIZES` gives the sizes. ``counted`` is SWT of a cycle over the largest SWT, descending at each
    place, and ``counted_number`` how many cycles have it; NaN where there are no more, or no critical plane.
    Where there is a plane but no critical point, s is that far from the contact.
    """
    share, number = np.full((2, len(points), *COUNTED_SIZES.values()), np.nan)
    double_angle = np.radians(2.0 * solution.critical_angle)
    found = count_batch(solution.critical_x, double_angle, **arguments_of(points))
    for point, places in enumerate(found):
        for place, cycles in enumerate(places):
            shares, numbers = few(cycles, share.shape[-1])
            share[point, place, : shares.size], number[point, place, : shares.size] = shares, numbers
    return {"counted": share, "counted_number": number}


def few(shares: FloatArray, most: int) -> tuple[FloatArray, FloatArray]:
    """At most so many cycles instead of many, and how many each stands for.

    The largest stays as it is, so that the damage is never less than its own.

    Parameters
    ----------
    shares
        Shape (k,), positive and descending.
    most
        Two at least.

    Examples
    --------
    >>> few(np.array([1.0, 1.0, 0.5]), 8)
    (array([1. , 0.5]), array([2., 1.]))
    """
    depth = np.log(shares[0] / shares)
    equal = int(np.searchsorted(depth, EQUAL, side="right"))
    rest = depth[equal:]
    for width in WIDTHS:
        begins: list[int] = []  # of groups, by the depths below the largest SWT
        for place, value in enumerate(rest):
            begin = rest[begins[-1]] if begins else -np.inf
            if value - begin > width * (LEAST_DEPTH + begin):
                begins.append(place)
        if len(begins) < most:
            break
    groups = np.split(shares[equal:], begins[1 : most - 1]) if rest.size else []
    means = [float((group**POWER).mean() ** (1.0 / POWER)) for group in groups]
    return np.array([shares[0], *means]), np.array([equal, *map(len, groups)], float)
