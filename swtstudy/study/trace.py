"""A profilometer's trace across a body: two sides, with a tilt, an offset, noise, dust, pits and dropouts."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from swtstudy.solver.table import FEWEST, TabulatedProfile
from swtstudy.study.columns import read_columns
from swtstudy.study.cycles import MEDIAN
from swtstudy.study.keys import TraceTable, with_keys
from swtstudy.study.units.rows import Units
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray
from swtstudy.vocabulary.mistakes import refused

#: The columns of a trace.
COLUMNS = ("position", "height")
#: Middles of the first search, over the central half of the trace, and the most radii at which both sides are
#: compared; the distance of these over the step between samples, a share with which no two places are alike.
MIDDLES, MOST_RADII, GOLDEN = 41, 1000, 0.618
#: Share of the heights at each end that may be dust.
DUST = 0.02
#: Share of the first range that is searched again with a tilt, and then so many of its steps in the lowest
#: region.
NEAR, STEPS_AROUND = 0.3, 2.0
#: Misfit over the rise that is not told from none.
FINEST = 1e-4
#: Degree of a polynomial that is taken off first, and the part of all samples whose median an outlier is held
#: against: more than two grains of dust.
DEGREE, BESIDE = 8, 8
#: Increase of the logarithm of the misfit with the tilt over the largest rise per length. A tilted parabola
#: is a shifted one; this picks the shifted one, and is too small to move the middle of other shapes.
TILT_PENALTY = 0.05
#: Share of the rise that belongs to the lowest region, from which the middle follows.
LOWEST = 0.5
#: Standard deviations from which a sample is an outlier, and the share of outliers above which
#: the two sides have different shapes instead.
OUTLIER, MOST_OUTLIERS = 8.0, 0.2
#: A gap is longer than this number of steps; a sample represents its side up to this number of steps.
GAP, REACH = 5.0, 1.5
#: Runs of lines that a message names.
MOST_RUNS = 5
#: Least share of the trace that both sides together cover without a warning.
LEAST_USED = 0.7
#: Share of the points, at least so many, of whose parabola the lowest point is the zero of heights.
INNERMOST, LEAST = 0.1, 5
#: Share of the largest rise up to which heights are 0, and of the largest radius up to which a face is none.
ROUND, LEAST_FACE = 1e-5, 0.05
#: Standard deviations 1/√n of the ratio of two r.m.s. of n numbers from 1: the noise of the mean, and half of
#: the difference of both sides, which is the least of those about many middles.
BY_CHANCE = 4.0
#: Share of the radii up to which a trace is smoothed to one contact area: contacts are smaller as a rule.
COMPACT = 0.5
#: A face may be hidden by noise. So many parts of the heights are averaged; standard deviations of a mean
#: that is none by chance, once in 3000 traces; how often that a height is at 1.5 times the radius of a face.
AVERAGED, BEYOND_NOISE, STEEPLY = 50, 4.5, 10.0
#: Share of its largest rise that a trace has at both of its ends.
LEAST_RISE = 0.02


@with_keys(TraceTable)
def read_trace(path: str | PathLike[str], *, name: str | None = None, **given: Any) -> TabulatedProfile:
    """Read a profile from a trace across it: the mean of both sides, smoothed by their difference.

    The middle follows from the lowest region of the trace by a robust fit. Samples that stand out on one
    side only, such as dust, pits and dropouts, are set aside. A warning tells their rows, gaps between
    samples, and a middle so far from the centre that much of the trace is unused.

    Parameters
    ----------
    path
        The file, a table with a header in a text file or a workbook.
    name
        Name of the profile; the file's name unless given.
    level
        Whether to take off the tilt that makes both sides most alike. An offset is always taken off.
    smoothing, geometry
        As of a `TabulatedProfile`. The default smoothing is the noise of the mean, estimated from the
        difference of both sides, and four standard deviations of this estimate.
    columns
        Headers of the columns ``position`` and ``height``, where they are not these words; both in lengths
        of one unit, heights growing away from the other body.
    separator, decimal, encoding, scale, skip_rows, units_row, sheet
        As of `swtstudy.read_signal`.

    Raises
    ------
    StudyError
        A ValueError with what is wrong.
    """
    return trace_from(Path(path), Path(path).stem if name is None else name, TraceTable.of(given))


def trace_from(own: Path, name: str, form: TraceTable, units: Units | None = None) -> TabulatedProfile:
    """The profile of a trace in a file; see `read_trace`, and `read_columns` for the units."""
    kinds = dict.fromkeys(COLUMNS, "length")
    values, rows = read_columns(own, COLUMNS, (), form, kinds, units, gaps=True)
    position, height = values.T
    if len(position) < 4 * FEWEST:
        raise refused("", f"{len(position)} points", f"{4 * FEWEST} at least", str(own))
    if not np.ptp(position) > 0.0:
        raise refused("", f"{len(position)} points at one position", "a trace across", str(own))
    # Nothing can be folded where a trace hardly rises towards one of its ends.
    real = _without_sentinels(height)
    sound = height[real][np.argsort(position[real])]
    outer, span = max(1, len(sound) // 100), np.ptp(sound)
    ends = sound[:outer].mean(), sound[-outer:].mean()
    is_cap = max(ends) < sound.max() - 0.5 * span
    if min(ends) - sound.min() < LEAST_RISE * span and not is_cap:
        found = "one side only: heights are lowest at an end of the trace"
        allowed = "both sides, with the lowest point between them: of a tilted one take off the slope, "
        allowed += "of one side give a table of radius and height"
        raise refused("", found, allowed, str(own))
    fold = Fold.of(position, height, form.level)
    if -fold.height.min() > fold.height.max():
        found = f"heights that fall by {-fold.height.min():.3g} from the middle to the sides"
        allowed = "heights that grow away from the other body: scale = { height = -1 }, or minus its scale"
        raise refused("", found, allowed, str(own))
    for line in _doubts(position, fold, rows):
        warnings.warn(f"{name}: {line}", stacklevel=2)
    given = fold.smoothing if form.smoothing is None else form.smoothing
    profile = TabulatedProfile(name, fold.radius, fold.height, given, form.geometry)
    compact = COMPACT * fold.radius[-1]
    is_fine = form.smoothing is not None or profile.compact_radius >= compact
    if is_fine or (least := profile.least_smoothing(compact)) is None:
        return profile
    found = f"smoothing = {least:.3g}, {least / fold.noise:.2g} times the r.m.s. difference of both sides"
    warnings.warn(f"{name}: {found}: with less it touches in several places", stacklevel=2)
    return TabulatedProfile(name, fold.radius, fold.height, least, form.geometry)


def _doubts(position: FloatArray, fold: Fold, rows: IndexArray) -> Iterator[str]:
    """Lines on the samples that were set aside, on gaps, and on a trace of which much is unused."""
    aside = rows[~fold.kept]
    if aside.size:
        plural = "s" * (aside.size > 1)
        parts = np.split(aside, np.flatnonzero(np.diff(aside) > 1) + 1)
        runs = [f"{part[0]} to {part[-1]}" if len(part) > 1 else f"{part[0]}" for part in parts]
        more = f" and {len(runs) - MOST_RUNS} more places" if len(runs) > MOST_RUNS else ""
        places = f"line{plural} {', '.join(runs[:MOST_RUNS])}{more} of the file"
        yield f"{aside.size} sample{plural} set aside that the other side does not have: {places}"
    at = np.sort(position)
    steps = np.diff(at)
    middle_step = float(np.median(steps[steps > 0.0]))
    gaps = np.flatnonzero(steps > GAP * middle_step)
    if gaps.size:
        widest = gaps[np.argmax(steps[gaps])]
        ends = f"a gap of {steps[widest]:.4g} in the positions, from {at[widest]:.4g} to {at[widest + 1]:.4g}"
        more = f", and {gaps.size - 1} more, none wider" if gaps.size > 1 else ""
        yield f"{ends}{more}, where most steps are {middle_step:.4g}: the heights there are unknown"
    used = 2.0 * fold.radius[-1] / np.ptp(position)
    if used < LEAST_USED:
        found = f"the middle is at {fold.middle:.4g}, so that only {used:.0%} of the trace has two sides"
        way = "is that the middle? A tilt may hide it: take the slope off the heights"
        yield f"{found}: radii up to {fold.radius[-1]:.4g}; {way}"


@dataclass(frozen=True, eq=False)
class Fold:
    """Both sides of a trace together.

    Attributes
    ----------
    radius, height
        Shape (m,): even radii from 0 on, and the mean of both sides above the lowest point.
    noise
        Root mean square of the noise of the heights: that of half of the difference of both sides, and more
        where one side is unknown.
    compared
        Number of radii at which both sides are known.
    middle
        Position of the middle.
    kept
        Shape (k,): which samples count; the others are sentinels and outliers.
    """

    radius: FloatArray
    height: FloatArray
    noise: float
    compared: int
    middle: float
    kept: BoolArray

    @classmethod
    def of(cls, position: FloatArray, height: FloatArray, level: bool) -> Fold:
        """Fold a trace, of positions and heights (k,) in any order; with ``level`` without its tilt."""
        kept = real = _without_sentinels(height)
        for _ in range(2):  # the middle of what is left without dust is closer
            middle, tilt = _middle(position[kept], height[kept], level)
            kept = real.copy()
            kept[real] = ~_outliers(position[real], height[real] - tilt * position[real], middle)
        # Distances and heights of both sides, each with the nearest samples across the middle.
        sides = []
        for sign in (1.0, -1.0):
            distance, own = _merged(sign * (position[kept] - middle), height[kept] - tilt * position[kept])
            first = max(int(np.searchsorted(distance, 0.0)) - 3, 0)
            sides.append((distance[first:], own[first:]))
        radius = np.linspace(0.0, min(side[0][-1] for side in sides), len(position) // 2)
        known = np.array([_reached(side[0], radius) for side in sides])
        weights = np.where(known.any(axis=0), known, True)
        both = np.asarray(known.all(axis=0))
        values = _interpolated(sides, radius, both)
        odd = 0.5 * np.diff(values, axis=0)[0, both]
        mean = np.average(values, axis=0, weights=weights)
        noise = float(np.sqrt(np.mean(odd**2) * np.mean(2.0 / weights.sum(axis=0)))) if odd.size else 0.0
        inner = slice(max(LEAST, int(INNERMOST * len(radius))))
        mean = mean - np.polynomial.Polynomial.fit(radius[inner] ** 2, mean[inner], 1)(0.0)
        mean[0] = 0.0
        rises = _face(mean, noise)
        if radius[rises] > LEAST_FACE * radius[-1]:
            mean = np.maximum(mean - mean[:rises].mean(), 0.0)
            mean[:rises] = 0.0
        return cls(radius, mean, noise, odd.size, middle, kept)

    @property
    def smoothing(self) -> float:
        """Misfit that no noise of the heights exceeds by chance: with less a fit follows the noise."""
        return self.noise * (1.0 + BY_CHANCE / np.sqrt(max(self.compared, 1)))


def _interpolated(
    sides: list[tuple[FloatArray, FloatArray]], radius: FloatArray, known: BoolArray
) -> FloatArray:
    """Heights of both sides at radii, shape (2, m), by cubics, or by lines where these differ less.

    Clean heights are closest to cubics. Cubics magnify noise where positions are uneven.
    """
    from scipy.interpolate import CubicSpline

    cubic = np.array([CubicSpline(*side)(radius) for side in sides])
    linear = np.array([np.interp(radius, *side) for side in sides])
    squares = [float(np.sum(np.diff(values, axis=0)[0, known] ** 2)) / 4.0 for values in (cubic, linear)]
    missed = float(np.mean([_missed(*side).mean() for side in sides]))
    return linear if squares[1] + np.sum(known) * missed**2 < squares[0] else cubic


def _face(height: FloatArray, noise: float) -> int:
    """Number of heights from the middle on that are a flat face, but for their noise."""
    some = max(LEAST, len(height) // AVERAGED)
    means = np.convolve(height, np.full(some, 1.0 / some), "same")
    limit = BEYOND_NOISE * noise / np.sqrt(some)
    up_to = np.cumsum(height) / np.arange(1, len(height) + 1)
    hidden = int(np.argmax(np.abs(means - up_to)[some:] > limit))
    # A parabola is within its noise at first, too: behind a face heights grow faster.
    behind = means[min(some + hidden + hidden // 2, len(means) - some)]
    hidden = hidden + some if hidden and behind > STEEPLY * limit else 0
    return max(int(np.argmax(height > ROUND * height.max())), hidden)


def _without_sentinels(height: FloatArray) -> BoolArray:
    """Which heights are no sentinel: one extreme value, further from the others than these are apart."""
    kept = np.ones(len(height), bool)
    for _ in range(4):
        values = np.unique(height[kept])
        if len(values) < 2 * FEWEST:
            break
        if values[1] - values[0] > values[-1] - values[1]:
            kept &= height != values[0]
        elif values[-1] - values[-2] > values[-2] - values[0]:
            kept &= height != values[-1]
        else:
            break
    return kept


def _middle(position: FloatArray, height: FloatArray, level: bool) -> tuple[float, float]:
    """The middle, and the tilt about it."""
    x, z = _merged(position, height)
    centre, reach = 0.5 * float(x[0] + x[-1]), 0.25 * float(np.ptp(x))
    found = _best(x, z, centre, reach, np.inf, False)
    best = _best(x, z, found.middle, NEAR * reach, np.inf, level)
    if level:
        # A tilted flat is lowest at an edge. With a tilt a flank alone has two sides, too, but it is smaller.
        found = _best(x, z, centre, reach, np.inf, True)
        if found.cost < best.cost and found.radius[-1] > best.radius[-1]:
            best = found
    reach *= NEAR
    if best.lowest.sum() >= 2 * FEWEST:
        # All middles with one window: with a smaller one each would have less to differ in.
        reach *= STEPS_AROUND * 2.0 / (MIDDLES - 1)
        window = float(best.lowest.mean() * best.radius[-1]) - reach
        best = _best(x, z, best.middle, reach, window, level)
    return best.middle, best.tilt


def _best(x: FloatArray, z: FloatArray, centre: float, reach: float, window: float, level: bool) -> _Trial:
    """A trace folded at the best middle within reach of a centre."""
    from scipy.optimize import minimize_scalar

    def cost(middle: float) -> float:
        return _Trial.at(x, z, middle, window, level).cost

    middles = np.linspace(centre - reach, centre + reach, MIDDLES)
    best = int(np.argmin([*map(cost, middles)]))
    bounds = middles[max(best - 1, 0)], middles[min(best + 1, MIDDLES - 1)]
    options = {"xatol": 1e-6 * (middles[1] - middles[0])}
    found = minimize_scalar(cost, bounds=bounds, method="bounded", options=options)
    return _Trial.at(x, z, float(found.x), window, level)


class _Trial(NamedTuple):
    """Ascending samples folded at a middle: their radii, their lowest region, and the tilt.

    ``cost`` is the logarithm of the mean difference of both sides over the rise, and what the tilt adds. Dust
    is the same in it at all middles, and so the edges of a flat face tell its middle, however few they are.
    """

    middle: float
    tilt: float
    radius: FloatArray
    lowest: BoolArray
    cost: float

    @classmethod
    def at(cls, x: FloatArray, z: FloatArray, middle: float, window: float, level: bool) -> _Trial:
        """Fold within a window; where a side has a gap, nothing is known."""
        end, step = min(middle - x[0], x[-1] - middle, window), float(np.median(np.diff(x)))
        # Between samples noise is lower: radii have all places between them, whatever the middle.
        radius = np.arange(0.5, MOST_RADII) * max(GOLDEN * step, end / MOST_RADII)
        radius = radius[radius <= end]
        both = middle + np.outer([1.0, -1.0], radius)
        known = _reached(x, both).all(axis=0)
        radius, (right, left) = radius[known], np.interp(both[:, known], x, z)
        odd, even, tilt = 0.5 * (right - left), 0.5 * (right + left), 0.0
        if level:  # the line through 0 of the least absolute deviations
            order = np.argsort(odd / radius)
            share = np.cumsum(radius[order])
            tilt = float((odd / radius)[order[np.searchsorted(share, 0.5 * share[-1])]])
        low, high = np.quantile(even, [DUST, 1.0 - DUST])
        span, rise = float(np.ptp(z)) or 1.0, float(high - low)
        loss = float(np.abs(odd - tilt * radius).mean())
        cost = np.log(np.hypot(loss, FINEST * span) / max(rise, FINEST * span))
        cost += TILT_PENALTY * abs(tilt) * end / span
        return cls(middle, tilt, radius, even - low <= LOWEST * rise, cost)


def _outliers(position: FloatArray, height: FloatArray, middle: float) -> BoolArray:
    """Which samples stand out of the samples beside them, and of the samples opposite."""
    from scipy.ndimage import median_filter

    radius = np.abs(position - middle)
    left = position < middle
    differs = np.full(len(position), np.nan)
    for side in (left, ~left):
        r, z = _merged(radius[~side], height[~side])
        inside = side & (radius <= r[-1]) & (radius >= r[0]) & _reached(r, radius)
        differs[inside] = height[inside] - np.interp(radius[inside], r, z)
    order, shape = np.argsort(position), np.polynomial.Polynomial.fit(position, height, DEGREE)
    residual = height - shape(position)
    residual[order] -= median_filter(residual[order], len(height) // BESIDE, mode="nearest")
    known = np.isfinite(differs)
    if not known.any():
        return np.zeros(len(position), bool)
    missed, floor = float(np.quantile(_missed(*_merged(position, height)), 1.0 - DUST)), 1e-6 * np.ptp(height)
    limits = [OUTLIER * max(float(np.median(np.abs(v[known]))) / MEDIAN, floor) for v in (residual, differs)]
    out = known & (np.abs(residual) > limits[0]) & (np.abs(differs) > limits[1] + missed)
    # The one of two opposite samples that is nearer to the spline is sound.
    out &= np.abs(residual) >= 0.5 * np.abs(differs)
    return out if out.mean() < MOST_OUTLIERS else np.zeros(len(position), bool)


def _merged(distance: FloatArray, height: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Ascending distances, and the mean of the heights of samples next to one another."""
    order = np.argsort(distance, kind="stable")
    distance, height = distance[order], height[order]
    steps = np.diff(distance)
    if not steps.any():
        return distance[:1], height[:1]
    group = np.append(0, np.cumsum(steps > 0.1 * np.median(steps[steps > 0.0])))
    count = np.bincount(group)
    return np.bincount(group, distance) / count, np.bincount(group, height) / count


def _missed(distance: FloatArray, height: FloatArray) -> FloatArray:
    """Errors of linear interpolation between samples: a quarter of those at the samples without them."""
    step, steps = np.diff(distance)[:-1], distance[2:] - distance[:-2]
    return 0.25 * np.abs(np.diff(height)[:-1] - step / steps * (height[2:] - height[:-2]))


def _reached(distance: FloatArray, radius: FloatArray) -> BoolArray:
    """Which radii are within reach of a sample on each side of them."""
    after, steps = np.clip(np.searchsorted(distance, radius), 1, len(distance) - 1), np.diff(distance)
    return np.asarray(steps[after - 1] <= (1.0 + REACH) * np.median(steps))
