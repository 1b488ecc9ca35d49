"""swt not at a point but over a critical distance ℓ: means over a volume or a line, and the point method.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about a place x of the surface line, in a plane contact over the half disc in its section; or taken at the
depth ℓ/2 (point method), or as the mean over the depths 0 … 2ℓ, straight down or along the critical plane of
that place. These are means of a parameter that is quadratic in stress, not of stress, as Taylor's volume and
line methods are.

Each is the largest one over x. swt is largest at a peak that may be narrower than ℓ, and the largest mean is
often elsewhere. Columns of a few values tell about where it is; from the highest of them parabolas lead
to its maximum.

With ℓ → 0 all three tend to the largest swt over all planes of the surface line. That is s, unless a plane
that does not hold the y axis is higher, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

from swtstudy.kernel.chebyshev import gauss_legendre
from swtstudy.kernel.field import (
    MANY,
    Opened,
    criterion_at,
    direction_at,
    far_field_of,
    largest_radius,
    mean_about,
    open_cycle,
    surface_above,
)
from swtstudy.kernel.mean import FIRST, LINE, POINT, ROUGHLY, SPHERE
from swtstudy.solver.points import Points, Solution, arguments_of
from swtstudy.vocabulary.arrays import FloatArray, IntArray
from swtstudy.vocabulary.parameters import DIRECTIONS

#: Kinds of means, and the kernel's.
KINDS = {"volume": SPHERE, "point": POINT, "line": LINE}
#: Data variables of a kind: the mean, its error, and the place that it is about.
VARIABLES = {kind: (f"s_{kind}", f"s_{kind}_error", f"{kind}_x") for kind in KINDS}
#: Relative accuracy of means, of means at first, and of single values in a column; what a place that is found
#: may miss; tolerance of what grew in stick.
RTOL, ROUGH, OF_COLUMNS, OF_PLACE, GROWTH = 1e-3, 3e-2, 1e-2, 1e-3, 1e-5
#: Relative accuracy of means on the way to their largest one: values at a depth and along lines have kinks.
CLOSE = {"volume": 1e-2, "point": 2e-3, "line": 2e-3}
#: A parabola has found a place if it foretells the mean there so closely, over the accuracy of means on the
#: way; those that differ by less than the second number, over it, may be equal; most means on the way.
FORETOLD, TOLD_APART, MOST_STEPS = 0.1, 0.2, 12
#: Places are one if they are nearer than such a share of the width of a climb.
SAME = 1e-3
#: Columns of at least this share of the highest are looked at, and columns are added beside them until the
#: mean falls by no more than the second number from each to the next; means at these of the third share of
#: the largest one are climbed from.
WORTH_A_LOOK, FALL, WORTH_A_CLIMB = 0.7, 0.03, 0.9
#: Columns are no nearer than this share of ℓ, but for lines.
FINEST = 1.0 / 16.0
#: Sine of an angle by which the critical plane turns at once, or nearly; places among which that is looked
#: for beside the highest mean, and how closely; and how closely between columns.
JUMP, LOOKS, HALVINGS, ROUGH_HALVINGS = 0.05, 17, 20, 6
#: Straight down, to the right and down.
DOWN = (0.0, 1.0)
#: Gauss's nodes t of a column, at depths 2ℓt², and their weights in the mean over the depths.
_NODE, _WEIGHT = gauss_legendre(7)
NODE, OF_LINE = 0.5 + 0.5 * _NODE, 0.5 * (1.0 + _NODE) * _WEIGHT
#: Columns are looked at so many ℓ beside the contact.
FARTHEST = 8.0
#: Most columns within the contact, their largest distance over the largest contact radius; over s, a limit
#: below which all of them are looked at.
MOST_COLUMNS, NARROW, LOWEST = 400, 0.1, 0.02
#: A mean about a place, and its error.
Mean = Callable[[float], tuple[float, float]]
#: The direction of a column from a place: to the right, and down.
Direction = Callable[[float], tuple[float, float]]


#: Distances of columns from the middle of a ball, over ℓ.
OFFSET = np.linspace(0.0, 1.0, 33)


def _of_ball(power: float) -> FloatArray:
    """Weights of the values of a column in the mean over a half ball, by the column's offset, over ℓ.

    The weight of a place is its distance from the surface of the ball: to the power 1 that is a half sphere
    with a field that does not depend on y, to the power 0 a half disc.
    """
    share, of_share = gauss_legendre(24)
    deepest = np.sqrt(0.5 * np.sqrt(1.0 - OFFSET**2))[:, None]  # at the surface of the ball
    t = deepest * (0.5 + 0.5 * share)
    inside = np.maximum(1.0 - OFFSET[:, None] ** 2 - 4.0 * t**4, 0.0) ** (0.5 * power)
    # A column's value at t is of the polynomial through its values.
    series = np.linalg.inv(np.polynomial.legendre.legvander(_NODE, len(NODE) - 1))
    in_series = np.polynomial.legendre.legvander(2.0 * t - 1.0, len(NODE) - 1) @ series
    weights = np.einsum("oi,oij->oj", deepest * of_share * t * inside, in_series)
    whole = weights.sum(axis=1)  # 0 at the last offset: by the trapezium rule half of the first value counts
    return weights / (2.0 * OFFSET[1] * (whole.sum() - 0.5 * whole[0]))


OF_SPHERE, OF_DISC, OF_POINT = _of_ball(1.0), _of_ball(0.0), (NODE == 0.5).astype(float)


def worst_means(points: Points, solution: Solution, distance: FloatArray) -> dict[str, FloatArray]:
    """The largest means over places of the surface line.

    Each kind, distance and direction has its own place.

    Parameters
    ----------
    points, solution
        n points and their solution.
    distance
        Shape (k,): ℓ > 0 in a_H.

    Returns
    -------
    dict
        By data variable, over E* δ0/R as s, NaN without s. ``s_volume``, shape (n, k), are means over half
        spheres, or half discs in the plane; ``s_point`` and ``s_line``, shape (n, k, 2), values at ℓ/2 and
        means over 0 … 2ℓ in both `DIRECTIONS`. Each has its absolute error, such as ``s_volume_error``, and
        the signed x of the place of the surface line that it is about, such as ``volume_x``: NaN far from
        the contact.
    """
    shape = len(solution.s), len(distance), len(DIRECTIONS)
    found = {
        name: np.full(shape[:2] if kind == "volume" else shape, np.nan)
        for kind, names in VARIABLES.items()
        for name in names
    }
    for row in np.flatnonzero(np.isfinite(solution.s) & (solution.s > 0.0)):
        opened = open_cycle(GROWTH, **arguments_of(points[[row]]))
        # Where the bulk stress alone makes s, it may be larger beneath the contact: the pressure adds to it.
        critical, s = float(np.nan_to_num(solution.critical_x[row])), float(solution.s[row])
        for k, each in enumerate(distance):
            for kind, means in _largest(opened, critical, s, float(each)).items():
                for name, own in zip(VARIABLES[kind], means.T, strict=True):
                    found[name][row, k] = own[0] if kind == "volume" else own
    rows = np.flatnonzero(solution.s == 0.0)
    for mean, error, _ in VARIABLES.values():
        # The points come last, so that their values are repeated along the other dimensions.
        found[mean].T[..., rows] = 0.0
        # Beside a line without tension there may be some.
        found[error].T[..., rows] = np.fmax(solution.s_error, solution.s_surface - solution.s)[rows]
    return found


def _largest(opened: Opened, critical: float, s: float, distance: float) -> dict[str, FloatArray]:
    """By kind the largest means over ℓ in each direction, their errors and their places, (directions, 3)."""
    directions: tuple[Direction, ...] = (lambda _: DOWN), cache(partial(direction_at, opened))

    def mean(kind: str, way: int, known: float, rtol: float, first: int, x: float) -> tuple[float, float]:
        return mean_about(opened, KINDS[kind], x, directions[way](x), distance, known, rtol, first)

    spacing, far, near = _spacing(opened, distance), far_field_of(opened), _spacing(opened, 0.0)
    found: dict[str, list[tuple[float, float, float]]] = {kind: [] for kind in KINDS}
    for way, into in enumerate(directions):
        kinds = [kind for kind in KINDS if way == 0 or kind != "volume"]
        least = min(mean(kind, way, 0.0, ROUGH, ROUGHLY, critical)[0] for kind in kinds)
        x, estimates = _columns(opened, critical, s, distance, least, into, kinds)
        for kind, estimate in estimates.items():
            most, starts = float(estimate.max()), list(x[_tops(estimate)])
            step = 0.5 * spacing if kind == "line" else 0.25 * distance
            if min(abs(start - critical) for start in starts) > 0.5 * distance:
                starts.append(critical)
            starts += [place for _, _, place in found[kind] if np.isfinite(place)]
            rough = partial(mean, kind, way, most, ROUGH, ROUGHLY)
            close = partial(mean, kind, way, most, CLOSE[kind], FIRST)
            place, known = _climb_all(rough, close, starts, step, near, CLOSE[kind])
            if way == 1:
                around = place + distance * np.linspace(-1.0, 1.0, LOOKS)
                places = [place, *_beside_jumps(around, into, HALVINGS)]
                known, place = max((close(x)[0] if x != place else known, x) for x in places)
            value, error = mean(kind, way, known, RTOL, FIRST, place)
            told = (far, 0.0, np.nan) if far > value else (value, error + OF_PLACE * value, place)
            found[kind].append(told)
    return {kind: np.array(rows) for kind, rows in found.items()}


def _ball_means(x: FloatArray, columns: FloatArray, of_ball: FloatArray) -> FloatArray:
    """Estimates of the means over half balls, with values that are linear between columns; lengths over ℓ."""
    offset = np.concatenate([-OFFSET[:0:-1], OFFSET])
    weights = OFFSET[1] * np.concatenate([of_ball[:0:-1], of_ball])
    at = x[:, None] + offset
    parts = (np.interp(at, x, values) @ own for own, values in zip(weights.T, columns.T, strict=True))
    return np.sum(list(parts), axis=0)


def _columns(
    opened: Opened,
    critical: float,
    s: float,
    distance: float,
    limit: float,
    into: Direction,
    kinds: list[str],
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Columns where the surface exceeds a limit: their x, ascending, and estimates of the means of kinds."""
    place, value = surface_above(opened, max(limit, LOWEST * s), s)
    high = (value[:-1] > limit) | (value[1:] > limit) | (limit < LOWEST * s)
    end = largest_radius(opened) + distance
    left, right = (np.clip(each[high], -end, end) for each in (place[:-1] - distance, place[1:] + distance))
    step = _spacing(opened, distance)
    near = [np.arange(np.floor(a / step), np.ceil(b / step) + 1) for a, b in zip(left, right, strict=True)]
    # Peaks of the surface may be narrower than the distance of columns.
    peaks = place[1:-1][(value[1:-1] >= np.maximum(value[:-2], value[2:])) & (value[1:-1] > limit)]
    outside = place[(value > limit) & (np.abs(place) > end)]
    # At a depth beneath which all is pressed, tension is far to the side.
    beyond = largest_radius(opened) + distance * np.geomspace(1.0, FARTHEST, 8)
    own = [step * each for each in near]
    x = np.unique(np.concatenate([*own, outside, peaks, beyond, -beyond, [critical]]))
    if opened.point.load["mirrored"]:
        x = x[x >= -distance]
    of_ball = OF_DISC if opened.point.profile["plane"] else OF_SPHERE
    x = np.unique(np.concatenate([x, _beside_jumps(x, into, ROUGH_HALVINGS)]))
    ways = _ways(into, x)
    columns = _columns_at(opened, x, ways, distance, limit)
    while True:
        estimates = {"point": columns @ OF_POINT, "line": columns @ OF_LINE}
        if "volume" in kinds:
            estimates["volume"] = _ball_means(x / distance, columns, of_ball)
        wide = _wide_gaps(x, estimates, distance, ways)
        if not wide.size:
            return x, estimates
        new = 0.5 * (x[wide] + x[wide + 1])
        of_new = _ways(into, new)
        columns = np.insert(columns, wide + 1, _columns_at(opened, new, of_new, distance, limit), axis=0)
        x, ways = np.insert(x, wide + 1, new), np.insert(ways, wide + 1, of_new, axis=0)


def _ways(into: Direction, x: FloatArray) -> FloatArray:
    """Directions of columns from places, (n, 2)."""
    return np.array([into(float(each)) for each in x])


def _wide_gaps(
    x: FloatArray, estimates: dict[str, FloatArray], distance: float, ways: FloatArray
) -> IntArray:
    """Gaps beside the highest columns, over which a mean falls or the direction turns, or wider than ℓ.

    Over places nearer than a share of ℓ only means along lines change: these reach up to the surface.
    """
    wide, width = np.zeros(len(x) - 1, dtype=bool), np.diff(x)
    turns = _turned(ways[:-1].T, ways[1:].T) & (width > FINEST * distance)
    for kind, estimate in estimates.items():
        is_top = np.isin(np.arange(len(x)), _tops(estimate))
        falls = np.abs(np.diff(estimate)) > FALL * np.maximum(estimate[1:], estimate[:-1])
        falls &= width > distance * (SAME if kind == "line" else FINEST)
        wide |= (is_top[1:] | is_top[:-1]) & (falls | turns | (width > distance))
    return np.flatnonzero(wide)


def _spacing(opened: Opened, distance: float) -> float:
    """Distance of columns from one another at first."""
    radius = largest_radius(opened)
    return max(min(0.5 * distance, NARROW * radius), 2.0 * (radius + distance) / MOST_COLUMNS)


def _columns_at(opened: Opened, x: FloatArray, ways: FloatArray, distance: float, limit: float) -> FloatArray:
    """Values at `NODE` into the body from places, (n, len(NODE)); below the limit they may be low."""
    depth = 2.0 * distance * NODE**2
    at = np.zeros((len(x), len(NODE), 3))
    at[..., 0], at[..., 2] = x[:, None] + ways[:, :1] * depth, ways[:, 1:] * depth
    return criterion_at(opened, at.reshape(-1, 3), OF_COLUMNS, limit, MANY)[0].reshape(len(x), -1)


def _tops(estimate: FloatArray) -> list[int]:
    """Columns that are as high as both neighbours, the highest first, if they are worth a look.

    From each the estimate falls, before it rises to a higher one, by more than a place may miss.
    """
    padded = np.concatenate([[-1.0], estimate, [-1.0]])
    is_top = (estimate >= padded[:-2]) & (estimate >= padded[2:])
    is_top &= estimate >= WORTH_A_LOOK * estimate.max()
    found: list[int] = []
    for k in np.argsort(-estimate, kind="stable"):
        low = (1.0 - OF_PLACE) * estimate[k]
        if is_top[k] and all(estimate[min(j, k) : max(j, k)].min() < low for j in found):
            found.append(int(k))
    return found


def _climb_all(
    rough: Mean, close: Mean, starts: list[float], step: float, near: float, accuracy: float
) -> tuple[float, float]:
    """The place of the largest mean that is reached from places, and the mean: roughly the highest first.

    From a start near the place that is the best so far nothing else is reached unless its own mean is higher.
    """
    best, largest = starts[0], 0.0
    for value, x in sorted(((rough(x)[0] if len(starts) > 1 else 1.0, x) for x in starts), reverse=True):
        if value < largest * (1.0 if abs(x - best) < near else WORTH_A_CLIMB):
            continue
        place, value = _climb(close, x, step, accuracy)
        if value > largest:
            best, largest = place, value
    return best, largest


def _beside_jumps(x: FloatArray, into: Direction, halvings: int) -> list[float]:
    """Places next to places at which the critical plane jumps, on both sides of each jump between places.

    There two planes are equally high, and the mean along the critical plane jumps, too.
    """
    found = []
    for a, b in itertools.pairwise(map(float, x)):
        for _ in range(halvings):
            if not _turned(into(a), into(b)):
                break
            middle = 0.5 * (a + b)
            a, b = (middle, b) if _turned(into(middle), into(b)) else (a, middle)
        else:
            found += [a, b]
    return found


def _turned(one: Any, other: Any) -> Any:
    """True if two directions, of lines without an end, are apart; of arrays, (2, n), one by one."""
    return abs(one[0] * other[1] - one[1] * other[0]) > JUMP


def _climb(mean: Mean, x: float, step: float, accuracy: float) -> tuple[float, float]:
    """From a place to a maximum by parabolas through three places, until one foretells the mean there.

    The outer two are the next ones whose means are lower than the highest by more than these miss, or that
    are so far away that next to nothing is to be gained.
    """
    at, of, foretold, far = [x], [mean(x)[0]], np.inf, 3.0 * step
    for _ in range(MOST_STEPS):
        k = int(np.argmax(of))
        lower = np.array(of) < (1.0 - TOLD_APART * accuracy) * of[k]
        outer = np.flatnonzero(lower | (np.abs(np.array(at) - at[k]) >= far))
        before, after = outer[outer < k], outer[outer > k]
        if before.size and after.size:
            three = [int(before[-1]), k, int(after[0])]
            new, foretold = _top_of_parabola([at[j] for j in three], [of[j] for j in three])
        else:
            right = before.size > 0 or (after.size == 0 and 2 * k >= len(at) - 1)
            new, foretold = (at[-1] + step if right else at[0] - step), np.inf
            step *= 2.0 if len(at) > 2 else 1.0
        if np.abs(np.array(at) - new).min() < SAME * far:  # means of such places differ by what they miss
            break
        value = mean(new)[0]
        j = int(np.searchsorted(at, new))
        at.insert(j, new)
        of.insert(j, value)
        if abs(value - foretold) <= FORETOLD * accuracy * value:
            break
    k = int(np.argmax(of))
    return at[k], of[k]


def _top_of_parabola(at: list[float], of: list[float]) -> tuple[float, float]:
    """Place and value of the top of the parabola through three places, the highest in the middle."""
    (a, b, c), (before, m, after) = at, of
    left, right = (m - before) / (b - a), (m - after) / (c - b)
    curvature = (left + right) / (c - a)
    slope = (left * (c - b) - right * (b - a)) / (c - a)
    if curvature <= 0.0:  # three equal means
        return b + 0.5 * (c - b), m
    return b + 0.5 * slope / curvature, m + 0.25 * slope * slope / curvature
