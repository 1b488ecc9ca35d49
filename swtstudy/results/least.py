"""The least value of an objective in the unit cube: a search of all, then a polish of the best points.

The search of the whole box is differential evolution, a generation in one batch. The polish knows that the
largest of several maxima has kinks where these change places. s is the largest of many local maxima, over
points, planes and instants, each of which depends smoothly on the parameters. Its least value is mostly in a
kink, where some of them are equal: there a descent along gradients zigzags and a simplex collapses. Planes
through the values and gradients at several points around are below all of the maxima nearby, and the lowest
point of the highest plane is the kink (a bundle method). Where the function is smooth, Newton's step with the
same gradients is the better one: both are tried.
"""

from __future__ import annotations

import itertools
from collections.abc import Generator, Iterator
from dataclasses import dataclass

import numpy as np

from swtstudy.results.objective import Function, Objective
from swtstudy.vocabulary.arrays import Columns, FloatArray
from swtstudy.vocabulary.mistakes import Mistake, StudyError

#: Points of a generation: so many for each parameter, about scipy's 15, and not fewer than the latter.
_POINTS_EACH, _LEAST = 16, 64
#: The search goes so far beyond the ends of a range, which counts as the ends: extremes are often there, and
#: differential evolution sends what leaves its bounds back to anywhere inside.
_BEYOND = 0.1
#: Generations at most; most searches converge before.
_GENERATIONS = 100
#: A population has converged when its values differ by this fraction of their mean: the polish does the rest.
_SPREAD = 0.01


def search(function: Function, dimensions: int, seed: int) -> tuple[FloatArray, bool]:
    """Search the unit cube for the least value of a function, which keeps where that is.

    Returns
    -------
    progress
        Least value after each generation, the first population included.
    converged
        Whether the population has converged.
    """
    from scipy.optimize import OptimizeResult, differential_evolution

    lowest: list[float] = []

    def batch(columns: FloatArray) -> FloatArray:
        values = function(np.clip(columns.T, 0.0, 1.0))
        lowest.append(float(values.min()))
        return values

    found: OptimizeResult = differential_evolution(
        batch,
        [(-_BEYOND, 1.0 + _BEYOND)] * dimensions,
        popsize=max(_POINTS_EACH, _LEAST // dimensions),
        init="sobol",
        maxiter=_GENERATIONS,
        tol=_SPREAD,
        seed=seed,
        polish=False,
        updating="deferred",
        vectorized=True,
    )
    return np.minimum.accumulate(lowest), bool(found.success)


#: Step of a difference quotient as a fraction of the distance, and its least: rounding of s is 1e-8.
_DIFFERENCE, _SMALLEST_DIFFERENCE = 0.03, 1e-6

#: Distances, as fractions, within which the lowest point is tried: curvature spoils long steps.
_FRACTIONS = (1.0, 0.3)
#: A plane that is off by this fraction of its rise is bent by a kink.
_BENT = 0.2


@dataclass(frozen=True)
class Planes(Columns):
    """Points, values and gradients of m tangent planes, shapes (m, d), (m,) and (m, d)."""

    points: FloatArray
    values: FloatArray
    gradients: FloatArray

    @classmethod
    def none(cls, dimensions: int) -> Planes:
        """No planes."""
        return cls(np.empty((0, dimensions)), np.empty(0), np.empty((0, dimensions)))

    def __len__(self) -> int:
        return len(self.values)

    def within(self, centre: FloatArray, distance: float) -> Planes:
        """Return the planes of points within a distance along each axis."""
        return self[(np.abs(self.points - centre) <= distance).all(axis=1)]


def probes(points: FloatArray, distance: float) -> FloatArray:
    """Where a function has to be known for its tangent planes at m points, shape (m (d + 2), d)."""
    inward, directions = _neighbours(points, distance)
    beside = points[:, None, :] + inward[:, None, :] * directions
    return np.concatenate([points, beside.reshape(-1, points.shape[1])])


def planes_from(points: FloatArray, distance: float, found: FloatArray) -> Planes:
    """The tangent planes at points, by the differences of the values ``found`` at their `probes`.

    Left out are points where the function has no value, and those with a kink between them and their
    neighbours: differences on either side of it make a plane that touches neither.
    """
    inward, directions = _neighbours(points, distance)
    values, shifted = found[: len(points)], found[len(points) :].reshape(len(points), len(directions))
    with np.errstate(invalid="ignore"):  # infinite where there is no value
        rises = shifted - values[:, None]
        strayed = np.abs(rises[:, -1] - 0.5 * rises[:, :-1].sum(axis=1))
        bent = strayed > _BENT * np.abs(rises).max(axis=1)
    good = np.isfinite(values) & np.isfinite(shifted).all(axis=1) & ~bent
    return Planes(points[good], values[good], (rises[:, :-1] / inward)[good])


def _neighbours(points: FloatArray, distance: float) -> tuple[FloatArray, FloatArray]:
    """Steps to the neighbours of points along each axis, and the neighbours in these steps, (d + 1, d)."""
    step = max(_DIFFERENCE * distance, _SMALLEST_DIFFERENCE)
    d = points.shape[1]
    # The last neighbour checks the plane through the others.
    return np.where(points > 0.5, -step, step), np.concatenate([np.eye(d), np.full((1, d), 0.5)])


def lowest_of(planes: Planes, centre: FloatArray, value: float, distance: float) -> Iterator[FloatArray]:
    """The lowest points of the highest of planes, within distances of the centre along each axis.

    No plane is taken to be above the value at the centre, as those of a curve that bends down may be.
    """
    from scipy.optimize import linprog

    # Relative to the centre, in units of the distance: tolerances of the linear programme are absolute.
    offsets = planes.values + np.sum(planes.gradients * (centre - planes.points), axis=1) - value
    scale = max(float(np.abs(planes.gradients).max()) * distance, np.finfo(float).tiny)
    slopes = planes.gradients * distance / scale
    low, high = np.maximum(-centre / distance, -1.0), np.minimum((1.0 - centre) / distance, 1.0)
    for fraction in _FRACTIONS:
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
    # Where the curvature is too small for a step within the distance, the whole distance.
    length = np.where(np.abs(slope) > 0.0, distance, 0.0)
    curved = np.abs(size) * distance > np.abs(slope)
    np.divide(np.abs(slope), np.abs(size), out=length, where=curved)
    step = axes @ (-np.sign(slope) * length)
    return np.clip(origin + np.clip(step, -distance, distance), 0.0, 1.0)


#: Where the search begins and where it ends, as a distance in the unit cube. At the end a kink of the slope 1
#: is known to 1e-5, and mostly far better: planes miss it by the square of the distance.
_FIRST, _LAST = 0.05, 1e-5
#: The distance is multiplied by this where the best point has hardly moved; 0.35 takes a fifth fewer points,
#: and leaves 2e-3 of a random kink of five parameters instead of 3e-4.
_SHRINK = 0.5
#: It has moved, if by more than this fraction of the distance.
_MOVED = 0.5
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
    known = Planes.none(dimensions)
    for _ in range(_ROUNDS):
        around = best + distance * rng.uniform(-1.0, 1.0, (_PLANES_EACH * dimensions, dimensions))
        around = np.clip(around, 0.0, 1.0)
        found = planes_from(around, distance, (yield probes(around, distance)))
        known = Planes.joined([known, found]).within(best, _NEAR * distance)
        moved = 0.0
        if len(known):
            steps = np.array([*lowest_of(known, best, value, distance), newton(known, best, distance)])
            points = np.concatenate([known.points, steps])
            values = np.append(known.values, (yield steps))
            lowest = int(values.argmin())
            if values[lowest] < value:
                moved = float(np.abs(points[lowest] - best).max())
                best, value = points[lowest], float(values[lowest])
        if moved < _MOVED * distance:
            distance *= _SHRINK
        if distance < _LAST:
            return


#: So many points of the search begin to be polished, this far apart in the unit cube: minima may be nearly
#: equal, and the search has stopped at differences of 1 %. With 3 one minimum of 20 random ones was missed.
_POLISHED, _APART = 8, 0.1
#: After so many batches the worse half of them is given up: four rounds show which one leads where.
_TRIAL = 8


@dataclass(frozen=True)
class Least:
    """The least value of an objective, and how it was found.

    Attributes
    ----------
    unit
        Shape (d,): where it is, in the unit cube.
    searched
        Value of the quantity there before the polish.
    progress
        Its value after each generation of the search; infinite before there was a finite one.
    converged
        Whether the population of the search has converged.
    evaluations
        Number of points evaluated.
    """

    unit: FloatArray
    searched: float
    progress: FloatArray
    converged: bool
    evaluations: int


def least(objective: Objective, dimensions: int, seed: int) -> Least:
    """The least value of an objective.

    Raises
    ------
    StudyError
        If it has no finite value anywhere.
    """
    progress, converged = search(objective, dimensions, seed)
    searched = float(objective.values.min())
    if not np.isfinite(searched):
        words = f"no finite value at any of {len(objective.values)} points"
        raise StudyError([Mistake("over", words, "ranges in which the quantity is finite somewhere")])
    _polish_together(objective, seed)
    unit = objective.points[objective.values.argmin()]
    sign = objective.sign
    return Least(unit, sign * searched, sign * progress, converged, len(objective.values))


def _polish_together(objective: Objective, seed: int) -> None:
    """Polish the best points; what all of them ask for next is one batch, in which a point costs less."""
    begin = _starts(objective)
    polishes = [polish(objective.points[row], float(objective.values[row]), seed) for row in begin]
    lowest = dict(zip(polishes, objective.values[begin].tolist(), strict=True))
    asked = {each: next(each) for each in polishes}
    for batch in itertools.count(1):
        values = objective(np.concatenate(list(asked.values())))
        ends = np.cumsum([len(points) for points in asked.values()])
        for each, part in zip(list(asked), np.split(values, ends[:-1]), strict=True):
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


def _starts(objective: Objective) -> list[int]:
    """Rows of the best points evaluated so far that are apart from better ones."""
    starts: list[int] = []
    for row in objective.values.argsort(kind="stable").tolist():
        away = [np.abs(objective.points[row] - objective.points[other]).max() for other in starts]
        if len(starts) < _POLISHED and np.isfinite(objective.values[row]) and min(away, default=1.0) > _APART:
            starts.append(row)
    return starts
