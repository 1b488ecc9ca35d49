"""`swtstudy.optimise`: the parameters for which a quantity is smallest, and for which it is largest.

One range is looked at evenly, then ever more closely where the value may be lowest. The search of a box of
several is differential evolution, a generation in one batch. A polish of its best points knows that the
largest of several maxima has kinks where these change places. s is the largest of many local maxima, over
points, planes and instants, each of which depends smoothly on the parameters. Its least value is mostly in a
kink, where some of them are equal: there a descent along gradients zigzags and a simplex collapses. Planes
through the values and gradients at several points around are below all of the maxima nearby, and the lowest
point of the highest plane is the kink (a bundle method). If the function is smooth, Newton's step with the
same gradients is the better one: both are tried.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Generator, Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
import xarray as xr

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.reading import read_grid
from swtstudy.points.solve import solve_grid
from swtstudy.points.values import NUMERIC
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.derived import LIVES
from swtstudy.vocabulary.mistakes import DEFAULT_RTOL, Mistake, Report, StudyError, literal, nearest, refused
from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import NAMED, Request


def ends_of(corners: Grid, over: Mapping[str, object]) -> FloatArray:
    """The lower and the upper ends of ranges, shape (2, d), from the grid of all ends.

    Raises
    ------
    StudyError
        If a range is the wrong way round.
    """
    low, high = ends = np.array([corners.axes[name] for name in over], float).T
    names = [name for name, wrong in zip(over, low > high, strict=True) if wrong]
    if names:
        raise StudyError([Mistake(f"over.{n}", literal(over[n]), "the lower end first") for n in names])
    return ends


def read_ranges(over: object, names: Collection[str]) -> tuple[dict[str, list[object] | None], Report]:
    """The ranges by name, ``(low, high)`` each, of parameters of some names, None for one that is none."""
    if not isinstance(over, Mapping) or not over:
        raise refused("over", literal(over), 'ranges by name, such as {"phase": (0, "2*pi")}')
    report = Report()
    axes: dict[str, list[object] | None] = {}
    for name, ends in over.items():
        if name not in names:
            report(f"over.{name}", "not a parameter that is a number", nearest(str(name), names))
        elif isinstance(ends, list | tuple | np.ndarray) and np.shape(ends) == (2,):
            axes[name] = list(ends)
        else:
            axes[name] = None
            report(f"over.{name}", literal(ends), "both ends of a range, (low, high)")
    return axes, report


#: Step of a difference quotient as a fraction of the distance, and its least: rounding of s is 1e-8.
_DIFFERENCE, _SMALLEST_DIFFERENCE = 0.03, 1e-6
#: Nearer to an end of a range, as a share of it, an optimum is at the end.
_AT_END = 1e-6
#: A plane that is off by this fraction of its rise is bent by a kink.
_BENT = 0.2


class Planes(NamedTuple):
    """Points, values and gradients of m tangent planes, shapes (m, d), (m,) and (m, d)."""

    points: FloatArray
    values: FloatArray
    gradients: FloatArray


def tangent_planes(points: FloatArray, distance: float) -> Generator[FloatArray, FloatArray, Planes]:
    """The tangent planes at m points, by differences: yields the places, shape (m (d + 2), d), of the values.

    Left out are points where the function has no value, and points with a kink between them and their
    neighbours: differences on either side of it make a plane that touches neither.
    """
    m, d = points.shape
    step = max(_DIFFERENCE * distance, _SMALLEST_DIFFERENCE)
    # Neighbours along each axis, inwards; the last neighbour checks the plane through the others.
    inward = np.where(points > 0.5, -step, step)
    directions = np.concatenate([np.eye(d), np.full((1, d), 0.5)])
    beside = points[:, None, :] + inward[:, None, :] * directions
    found = yield np.concatenate([points, beside.reshape(-1, d)])
    values, shifted = found[:m], found[m:].reshape(m, d + 1)
    with np.errstate(invalid="ignore"):  # infinite where there is no value
        rises = shifted - values[:, None]
        strayed = np.abs(rises[:, -1] - 0.5 * rises[:, :-1].sum(axis=1))
        bent = strayed > _BENT * np.abs(rises).max(axis=1)
    good = np.isfinite(values) & np.isfinite(shifted).all(axis=1) & ~bent
    return Planes(points[good], values[good], (rises[:, :-1] / inward)[good])


def lowest_of(planes: Planes, centre: FloatArray, value: float, distance: float) -> Iterator[FloatArray]:
    """The lowest points of the highest of planes, within distances of the centre along each axis.

    No plane is taken to be above the value at the centre, as the tangents of a curve that bends down may be.
    """
    from scipy.optimize import linprog

    # Relative to the centre, in units of the distance: tolerances of the linear programme are absolute.
    offsets = planes.values + np.sum(planes.gradients * (centre - planes.points), axis=1) - value
    scale = max(float(np.abs(planes.gradients).max()) * distance, np.finfo(float).tiny)
    slopes = planes.gradients * distance / scale
    low, high = np.maximum(-centre / distance, -1.0), np.minimum((1.0 - centre) / distance, 1.0)
    for fraction in (1.0, 0.3):  # curvature spoils long steps
        found = linprog(
            np.append(np.zeros(len(centre)), 1.0),
            A_ub=np.column_stack([slopes, -np.ones(len(slopes))]),
            b_ub=-np.minimum(offsets, 0.0) / scale,
            bounds=[*zip(fraction * low, fraction * high, strict=True), (None, None)],
        )
        if found.success:
            yield np.clip(centre + distance * found.x[:-1], 0.0, 1.0)


def newton(planes: Planes, centre: FloatArray, distance: float) -> FloatArray:
    """Newton's step by the curvature that the gradients show, downhill along each of its axes."""
    nearest = int(np.abs(planes.points - centre).max(axis=1).argmin())
    gradient, origin = planes.gradients[nearest], planes.points[nearest]
    # Least squares: gradients = gradient + (points - origin) @ curvature.
    curvature, *_ = np.linalg.lstsq(planes.points - origin, planes.gradients - gradient, rcond=None)
    size, axes = np.linalg.eigh((curvature + curvature.T) / 2.0)
    slope = gradient @ axes
    # If the curvature is too small for a step within the distance, the whole distance.
    length = np.where(np.abs(slope) > 0.0, distance, 0.0)
    curved = np.abs(size) * distance > np.abs(slope)
    np.divide(np.abs(slope), np.abs(size), out=length, where=curved)
    step = axes @ (-np.sign(slope) * length)
    return np.clip(origin + np.clip(step, -distance, distance), 0.0, 1.0)


#: Where the search begins and where it ends, as a distance in the unit cube. At the end a kink of the slope 1
#: is known to 1e-5, and mostly far better: planes miss it by the square of the distance.
_FIRST, _LAST = 0.05, 1e-5
#: Planes in a round for each parameter: all that meet in a kink have to be found sooner or later.
_PLANES_EACH = 2
#: Planes that count are so many distances away at most.
_NEAR = 2.0
#: Rounds at most: 13 halve the distance to its end, 30 more were enough on every valley tried.
_ROUNDS = 60


def polish(start: FloatArray, value: float, seed: int) -> Generator[FloatArray, FloatArray, None]:
    """Search for the least value near a point: yields points, shape (n, d), and is sent their values, (n,).

    Parameters
    ----------
    start, value
        The point, shape (d,), in the unit cube, and the value there.
    seed
        Seed of the random points at which planes are found.
    """
    rng = np.random.default_rng(seed)
    best, distance, dimensions = start, _FIRST, len(start)
    known = Planes(np.empty((0, dimensions)), np.empty(0), np.empty((0, dimensions)))
    for _ in range(_ROUNDS):
        around = best + distance * rng.uniform(-1.0, 1.0, (_PLANES_EACH * dimensions, dimensions))
        around = np.clip(around, 0.0, 1.0)
        found = yield from tangent_planes(around, distance)
        known = Planes(*map(np.concatenate, zip(known, found, strict=True)))
        near = (np.abs(known.points - best) <= _NEAR * distance).all(axis=1)
        known = Planes(*(column[near] for column in known))
        moved = 0.0
        if len(known.values):
            steps = np.array([*lowest_of(known, best, value, distance), newton(known, best, distance)])
            points = np.concatenate([known.points, steps])
            values = np.append(known.values, (yield steps))
            lowest = int(values.argmin())
            if values[lowest] < value:
                moved = float(np.abs(points[lowest] - best).max())
                best, value = points[lowest], float(values[lowest])
        if moved < 0.5 * distance:
            # 0.35 takes a fifth fewer points, and leaves 2e-3 of a random kink of five parameters, not 3e-4.
            distance *= 0.5
        if distance < _LAST:
            return


#: Even points of a single range, as many as differential evolution begins with.
_EVEN = 65
#: So many points of the search begin to be polished, this far apart in the unit cube: minima may be nearly
#: equal, and the search has stopped at differences of 1 %. With 3 one minimum of 20 random ones was missed.
_POLISHED, _APART = 8, 0.1
#: After so many batches the worse half of them is given up: four rounds show which one leads where.
_TRIAL = 8


def search(
    solve: Callable[[FloatArray], xr.Dataset], dimensions: int, quantity: str, sign: int, seed: int
) -> tuple[FloatArray, FloatArray]:
    """Search the unit cube for the least value of a quantity, or of its negative.

    Parameters
    ----------
    solve
        Results at points of the unit cube, from their shape (n, d).
    dimensions
        d.
    quantity
        Name of the data variable; of a life the damage of a load cycle counts, 1 divided by the life.
    sign
        1 where its least value is wanted, -1 where the greatest is.
    seed
        Seed of the random numbers.

    Returns
    -------
    best
        Shape (d,): the point with the least of the values.
    values
        Shape (n,): the values at all points that were solved, times the sign; infinite where there is none.

    Raises
    ------
    StudyError
        If there is no finite value anywhere.
    """
    points: list[FloatArray] = []
    values: list[FloatArray] = []

    def solved(unit: FloatArray) -> FloatArray:
        """Values at points of the unit cube, (n, d) to (n,)."""
        found = solve(unit)[quantity]
        others = [dim for dim in found.dims if dim != SAMPLE]
        if quantity in LIVES:  # by the damage of a load cycle, which is 0 where a life has no bound
            found = 1.0 / found
        worse = found.max(others).values  # of both bodies, and of both directions
        points.append(unit)
        values.append(np.where(np.isfinite(worse), sign * worse, np.inf))
        return values[-1]

    if dimensions == 1:
        search_line(solved)
    else:
        evolve(solved, dimensions, seed)
    every = np.concatenate(values)
    if not np.isfinite(every.min()):
        words = f"no finite value at any of {len(every)} points"
        raise refused("over", words, "ranges in which the quantity is finite somewhere")
    if dimensions > 1:
        polish_best(solved, np.concatenate(points), every, seed)
        every = np.concatenate(values)
    return np.concatenate(points)[every.argmin()], every


def search_line(solved: Callable[[FloatArray], FloatArray]) -> None:
    """Look at a range evenly, then from each low point to both sides by steps that are halved.

    A point is given up where it cannot become the lowest: next to it the function falls by no more than it
    rises to its sides. ``solved`` gives values at points.
    """
    places = np.linspace(0.0, 1.0, _EVEN)
    step, values = places[1], solved(places[:, None])
    sides = np.stack([np.append(np.inf, values[:-1]), np.append(values[1:], np.inf)], axis=1)
    low = np.isfinite(values) & (values <= sides.min(axis=1))
    places, values, sides = places[low], values[low], sides[low]
    while step > _LAST and len(places):
        rises = np.where(np.isfinite(sides), sides, values[:, None]).max(axis=1) - values
        kept = (values - rises < values.min()) | (np.arange(len(values)) == values.argmin())
        places, values, step = places[kept], values[kept], 0.5 * step
        around = np.clip(places[:, None] + step * np.array([-1.0, 1.0]), 0.0, 1.0)
        sides = solved(around.reshape(-1, 1)).reshape(-1, 2)
        row, side = np.arange(len(values)), sides.argmin(axis=1)
        moved = sides[row, side] < values
        places = np.where(moved, around[row, side], places)
        lowest = np.minimum(sides[row, side], values)
        sides, values = np.where(moved[:, None], values[:, None], sides), lowest


def evolve(solved: Callable[[FloatArray], FloatArray], dimensions: int, seed: int) -> None:
    """Search the unit cube by differential evolution; ``solved`` gives values at points."""
    from scipy.optimize import differential_evolution

    differential_evolution(
        lambda columns: solved(np.clip(columns.T, 0.0, 1.0)),
        # What is beyond the ends of a range counts as the ends: extremes are often there, and the search
        # sends what leaves its bounds back to anywhere inside.
        [(-0.1, 1.1)] * dimensions,
        popsize=max(16, 64 // dimensions),  # about scipy's 15 for each parameter, and 64 at least
        init="sobol",
        maxiter=100,  # most searches converge before
        tol=0.01,  # values differ by this fraction of their mean: the polish does the rest
        seed=seed,
        polish=False,
        updating="deferred",
        vectorized=True,
    )


def polish_best(
    solved: Callable[[FloatArray], FloatArray], points: FloatArray, values: FloatArray, seed: int
) -> None:
    """Polish the best of n points; what all polishes ask for next is one batch, in which a point costs less.

    Parameters
    ----------
    solved
        Values at points, from their shape (n, d).
    points, values
        Shapes (n, d) and (n,).
    seed
        As of `polish`.
    """
    # The best points that are apart from better ones.
    begin: list[int] = []
    for row in values.argsort(kind="stable")[: np.isfinite(values).sum()].tolist():
        away = [np.abs(points[row] - points[other]).max() for other in begin]
        if len(begin) < _POLISHED and min(away, default=1.0) > _APART:
            begin.append(row)
    polishes = [polish(points[row], float(values[row]), seed) for row in begin]
    lowest = dict(zip(polishes, values[begin].tolist(), strict=True))
    asked = {each: next(each) for each in polishes}
    for batch in itertools.count(1):
        found = solved(np.concatenate(list(asked.values())))
        ends = np.cumsum([len(part) for part in asked.values()])
        for each, part in zip(list(asked), np.split(found, ends[:-1]), strict=True):
            lowest[each] = min(lowest[each], *part)
            try:
                asked[each] = each.send(part)
            except StopIteration:
                del asked[each]
        if not asked:
            return
        if batch % _TRIAL == 0:
            leading = sorted(asked, key=lambda each: lowest[each])[: -(-len(asked) // 2)]
            asked = {each: asked[each] for each in leading}


@with_parameters(PARAMETERS.values())
def optimise(
    over: Mapping[str, tuple[object, object]],
    minimise: str = "s",
    *,
    rtol: float = DEFAULT_RTOL,
    seed: int = 0,
    **parameters: object,
) -> xr.Dataset:
    """The parameters in given ranges for which a quantity is smallest, and for which it is largest.

    One range is searched from 65 even points, by steps that are halved. Several are searched by differential
    evolution (`scipy.optimize.differential_evolution`), a generation solved in one batch; a bundle method
    follows its best points into the kinks that s has where two local maxima over the body change places. The
    same call gives the same result.

    Parameters
    ----------
    over
        Ranges by name, ``(low, high)``, of parameters that are numbers. Ends may be texts such as "2*pi".
    minimise
        The data variable to be minimised, "s" by default; or a quantity of
        `swtstudy.vocabulary.quantities.NAMED`.
    rtol
        Relative accuracy asked of s.
    seed
        Seed of the random numbers of a search of several ranges, 0 or more.
    **parameters
        The names below, each a single value, as for `swtstudy.solve`.

    Returns
    -------
    xarray.Dataset
        Along ``case``, "best" and "worst": the data variables of `swtstudy.solve` at the smallest and at the
        largest value of the quantity, with the parameters of ``over`` as coordinates; ``evaluations`` is the
        number of points that were solved. Points where the quantity is not finite are left out;
        ``without_value`` counts them. The attribute ``at_ends`` names ends of ranges at which the best or the
        worst point is: a wider range may have a better one.

    Raises
    ------
    StudyError
        A ValueError with every mistake, or if the quantity is finite nowhere.

    Examples
    --------
    >>> import swtstudy
    >>> found = swtstudy.optimise(over={"phase": (0, "pi")}, normal_amplitude=0.75)
    >>> found.phase.sel(case="best").round(3).item(), found.s.sel(case="best").round(4).item()
    (2.662, 0.1053)
    """
    report = Report()
    # Values that all results have, and quantities on request.
    known = ("s", "s_surface", "critical_x", "critical_angle", *NAMED)
    with report:
        axes, wrong = read_ranges(over, NUMERIC)
        corners, found = read_grid(parameters, axes, lambda name: f"over.{name}" if name in axes else name)
        if corners is None or wrong:
            raise StudyError([*wrong, *found])
        ends_of(corners, over)
        known += corners.margins
    check_asked(report, minimise, rtol, seed, known)
    report.refuse()
    assert corners is not None
    asked = Request((minimise,) if minimise in NAMED else ())
    return optimum_in(corners, over, minimise, float(rtol), int(seed), asked)


def optimum_in(
    corners: Grid, over: Mapping[str, object], minimise: str, rtol: float, seed: int, asked: Request
) -> xr.Dataset:
    """The best and the worst points of ranges; see `optimise`. The best life is the longest.

    Parameters
    ----------
    corners
        The grid of the ends of all ranges; of real contacts of both bodies, too.
    over, minimise, rtol, seed
        As of `optimise`.
    asked
        The quantities to be computed beside s.
    """
    low, high = ends_of(corners, over)
    axes = {name: values for name, values in corners.axes.items() if name not in over}

    @cache  # both searches begin alike
    def solved(content: bytes) -> xr.Dataset:
        unit = np.frombuffer(content).reshape(-1, len(over))
        # Not low + unit (high - low): rounding must not leave the range.
        values = low * (1.0 - unit) + high * unit
        samples = dict(zip(over, map(tuple, values.T.tolist()), strict=True))
        return solve_grid(replace(corners, axes=axes, samples=samples), rtol, asked)

    def solve(unit: FloatArray) -> xr.Dataset:
        """Results at points of the unit cube, shape (n, d), each a point of a sample."""
        return solved(unit.tobytes())

    d = len(over)
    with Progress(None, "optimise"):
        found = [search(solve, d, minimise, sign, seed) for sign in (1, -1)]
        places, values = zip(*found, strict=True)
        cases = solve(np.array(places)).drop_vars(SAMPLE).rename({SAMPLE: "case"})
    words = {"long_name": "number of points solved"}
    cases = cases.assign(evaluations=("case", [*map(len, values)], words))
    cases = cases.assign_coords(case=["best", "worst"])
    without = int(np.isinf(np.concatenate(values)).sum())
    # Beyond an end of a range there may be a better value.
    ends = [
        f"{case} at the {'upper' if unit > 0.5 else 'lower'} end of {name}"
        for case, place in zip(cases.case.values, places, strict=True)
        for name, unit in zip(over, place.tolist(), strict=True)
        if min(unit, 1.0 - unit) < _AT_END
    ]
    words = {"at_ends": ", ".join(ends)} if ends else {}
    return cases.assign_attrs(minimise=minimise, seed=seed, without_value=without, **words)


def check_asked(report: Report, minimise: object, rtol: object, seed: object, known: Collection[str]) -> None:
    """Report mistakes in how an optimum is asked for; ``known`` may be minimised."""
    if minimise not in known:
        report("minimise", literal(minimise), nearest(str(minimise), known))
    report.rtol(rtol)
    report.seed(seed)
