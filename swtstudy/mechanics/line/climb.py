"""The local search for maxima of swt along the surface line, many at once.

Each looks at a few positions around its best one, fits parabolas or a polynomial, moves to the vertex and
narrows, until a further round would change too little.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.first_look import TWIN, FirstLook, local_maxima
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.line.positions import PositionBrackets, Positions
from swtstudy.mechanics.line.value import hot_intervals, refine
from swtstudy.mechanics.numerics.arrays import gather, pick
from swtstudy.mechanics.numerics.peaks import polynomial_maximum, powers_from_values, vertex_near
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Distances at which each round of the local search looks, in widths, and how the width shrinks.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0, 3.0])
FIRST_WIDTH, SHRINKING = 0.25, 0.2
_POWERS = powers_from_values(FIRST_WIDTH * OFFSETS)
#: How the width shrinks while the best position is the outermost one.
WALKING = 2.0 / 3.0
LEAST_ROUND_COUNT = 2
#: Digits that a zoom gains at least.
DIGITS_PER_ZOOM = 3.2
#: Share of the last round's change that further ones would make at most, and beside a corner, where swt may
#: begin like a square root.
CHANGE_SHARE, CORNER_CHANGE_SHARE = 0.03, SHRINKING**0.5
#: Error of the maximum of a polynomial through all values, as a share of its distance from a parabola's.
POLYNOMIAL_SHARE = 0.3
#: Error left to the search over x, as a share of the tolerance.
SETTLED = 0.3
#: Values closer than this are equal, relative.
TIE = 1e-12


@dataclass(frozen=True)
class Accuracy:
    """What a relative tolerance asks of the local search.

    Attributes
    ----------
    search
        Resolution of the local search over x.
    check
        A finer one for the value itself; the difference of the two is the error in time and angle.
    tolerance
        Relative accuracy asked for.
    hasty
        Whether one round may be enough where swt is smooth.
    """

    search: Resolution
    check: Resolution
    tolerance: float
    hasty: bool = True

    @classmethod
    def for_tolerance(cls, rtol: float) -> Accuracy:
        """The least effort that keeps the error below ``rtol``."""
        digits = -np.log10(rtol)
        # Four digits by the first zoom, and so many more by each further one.
        zooms = max(int(np.ceil((digits - 1.0) / DIGITS_PER_ZOOM)), 1)
        return cls(Resolution(4, zooms, digits + 1.0), Resolution(5, zooms + 1, digits + 2.5), rtol)

    def finer(self) -> Accuracy:
        """The same with twice the instants, closer looks at the extremes and more rounds."""
        search, check = (replace(r, nodes=2 * r.nodes, zooms=r.zooms + 1) for r in (self.search, self.check))
        return replace(self, search=search, check=check, hasty=False)


@dataclass
class Climb:
    """The local search of m local maxima; arrays of shape (m,).

    Attributes
    ----------
    point, side, column
        Number of the point, sign of x, and column of the position around which is searched.
    hot
        Shape (m, i): intervals of the cycle that are looked at.
    angle
        2θ of the best plane so far, rad.
    centre, width
        Where the next round looks, in the c of `PositionBrackets`.
    top, seen
        Estimated maximum of swt, and the largest value so far.
    remaining
        How much `top` would change in further rounds, at most.
    rounds
        Rounds that narrowed the search.
    settled
        Whether the next round would change too little to matter.
    """

    point: NDArray[np.intp]
    side: FloatArray
    column: NDArray[np.intp]
    hot: NDArray[np.bool_]
    angle: FloatArray
    centre: FloatArray
    width: FloatArray
    top: FloatArray
    seen: FloatArray
    remaining: FloatArray
    rounds: NDArray[np.intp]
    settled: NDArray[np.bool_]

    @classmethod
    def start(
        cls,
        scene: Scene,
        split: Scene,
        part_of: NDArray[np.intp],
        look: FirstLook,
        positions: Positions,
        resolution: Resolution,
    ) -> Climb:
        """From the first look at a scene, for its finer division, see `split_at_breakpoints`."""
        peak = local_maxima(look.swt, look.double_angle, positions.r)
        point, side, column = peak
        angle, hot = look.closer(scene, *peak)
        hot = gather(hot, part_of[point])
        x_sign = np.where(side == 0, 1.0, -1.0)
        chosen = split.select(point, hot)
        found = hot_intervals(chosen, positions.r[point, column], x_sign, angle, resolution)
        hot = chosen.cycle.numbered(found, hot.shape[1])
        centre, top, seen, remaining = np.zeros((4, len(point)))
        width, rounds = np.full(len(point), FIRST_WIDTH), np.zeros(len(point), dtype=np.intp)
        settled = np.zeros(len(point), dtype=bool)
        return cls(point, x_sign, column, hot, angle, centre, width, top, seen, remaining, rounds, settled)

    def take(self, index: NDArray[np.intp] | NDArray[np.bool_]) -> Climb:
        """The local maxima at ``index``."""
        return Climb(*(values[index] for values in vars(self).values()))

    def leading(self, height: FloatArray, share: float) -> Climb:
        """Those whose height, shape (m,), is at least a share of the largest one at their point."""
        largest = np.zeros(self.point.max(initial=0) + 1)
        np.maximum.at(largest, self.point, height)
        return self.take(height >= share * largest[self.point])

    def without_followers(self, moved: NDArray[np.bool_]) -> Climb:
        """Without those that have just moved to a position around which another one searches."""
        order = np.lexsort((moved, self.column, self.side, self.point))
        key = np.stack([self.point, self.side, self.column])[:, order]
        same = np.zeros(len(order), dtype=bool)
        same[1:] = (key[:, 1:] == key[:, :-1]).all(axis=0)
        return self.take(order[~(same & moved[order])])

    @classmethod
    def joined(cls, several: list[Climb]) -> Climb:
        """All local maxima of several searches."""
        columns = zip(*(vars(one).values() for one in several), strict=True)
        return cls(*(np.concatenate(values) for values in columns))

    def twins(
        self, index: NDArray[np.intp], centre: FloatArray, value: FloatArray, angle: FloatArray
    ) -> Climb:
        """Searches between the same neighbours as those at ``index``, around other values that were seen."""
        twins = self.take(index)
        return replace(
            twins,
            angle=angle,
            centre=centre,
            width=twins.width * SHRINKING,
            top=value,
            seen=value,
            remaining=value,
            rounds=twins.rounds + 1,
        )

    def brackets(self, positions: Positions) -> PositionBrackets:
        """Where the positions around which is searched lie."""
        return PositionBrackets.around(positions, self.point, self.column)


def step(
    scene: Scene, positions: Positions, climb: Climb, active: NDArray[np.intp], accuracy: Accuracy
) -> Climb:
    """Look around the centres of the active local maxima, move there and narrow the search.

    Returns
    -------
    Other local maxima that this look has found between the same neighbours.
    """
    now = climb.take(active)
    brackets = now.brackets(positions)
    c = _look(now.centre, now.width)
    start = np.repeat(now.angle[:, None], c.shape[1], axis=1)
    chosen = scene.select(now.point, now.hot)
    values, angles = refine(chosen, brackets.radius(c), now.side, start, accuracy.search)
    # Equal values, as beyond the last position, count for the centre.
    best = (values * (1.0 - TIE * np.abs(c - now.centre[:, None]))).argmax(axis=1)
    found = pick(c, best)
    centre, top = vertex_near(c, values, best, brackets.is_corner)
    beside_corner = brackets.is_corner & (np.abs(now.centre) < OFFSETS[-1] * now.width)
    remaining = np.where(beside_corner, CORNER_CHANGE_SHARE, CHANGE_SHARE) * np.abs(top - now.top)
    # Five values on a smooth maximum may be enough.
    first = accuracy.hasty & (now.width == FIRST_WIDTH) & (now.centre == 0.0) & (np.abs(found) < c[:, -1])
    smooth = np.flatnonzero(first & ~brackets.is_corner)
    parabola = top[smooth]
    centre[smooth], top[smooth] = _polynomial_maximum(values[smooth], centre[smooth])
    remaining[smooth] = POLYNOMIAL_SHARE * np.abs(top[smooth] - parabola)
    clear = np.zeros(len(active), dtype=bool)
    clear[smooth] = remaining[smooth] <= SETTLED * accuracy.tolerance * top[smooth]
    # A maximum next to a corner shows only once the search is narrow.
    rise = top - pick(values, best)
    flat = rise <= CHANGE_SHARE * accuracy.tolerance * top
    stays = brackets.is_corner & (found == 0.0) & (flat | (now.rounds < LEAST_ROUND_COUNT))
    centre = np.where(stays, 0.0, centre)
    # The maximum may lie outside of what was looked at: up to the neighbour, or beyond it.
    neighbour = now.column + found.astype(np.intp)
    beyond = (np.abs(found) == 1.0) & (neighbour >= 0) & (neighbour < positions.count[now.point])
    outermost = ((best == 0) | (best == c.shape[1] - 1)) & (found != now.centre)
    climb.column[active] = np.where(beyond, neighbour, now.column)
    climb.centre[active] = np.where(beyond, 0.0, centre)
    climb.angle[active], climb.top[active] = pick(angles, best), top
    climb.seen[active], climb.remaining[active] = pick(values, best), remaining
    narrower = now.width * np.where(outermost, WALKING, SHRINKING)
    climb.width[active] = np.where(beyond, FIRST_WIDTH, narrower)
    climb.rounds[active] += ~outermost
    small = np.maximum(remaining, rise) <= SETTLED * accuracy.tolerance * top
    enough = now.rounds + 1 >= LEAST_ROUND_COUNT
    climb.settled[active] = clear | (~outermost & small & enough & (flat | ~stays))
    new = np.flatnonzero(now.rounds == 0)
    row, second = _other_peaks(values[new], best[new], accuracy.tolerance)
    row = new[row]
    peaks = now.twins(row, c[row, second], values[row, second], angles[row, second])
    return Climb.joined([peaks, _behind_corners(chosen, positions, now, c, values, accuracy)])


def _behind_corners(
    scene: Scene,
    positions: Positions,
    climb: Climb,
    c: FloatArray,
    values: FloatArray,
    accuracy: Accuracy,
) -> Climb:
    """Local maxima beside corners that a first look took no value of, behind lower ones on the other side.

    Parameters
    ----------
    scene, climb
        m points and the searches at them.
    c, values
        Shape (m, k): where was looked, and swt there.
    """
    middle, best = len(OFFSETS) // 2, values.argmax(axis=1)
    row = np.flatnonzero((climb.rounds == 0) & (climb.centre == 0.0) & (best != middle))
    c, values, best = c[row], values[row], best[row]
    largest = pick(values, best)
    is_corner = climb.take(row).brackets(positions).is_corner
    place, height = vertex_near(c, values, np.full(len(row), middle), is_corner)
    behind = (pick(c, best) * place < 0.0) & (height > (1.0 + accuracy.tolerance) * largest)
    row, place, largest = row[behind], place[behind], largest[behind]
    some = climb.take(row)
    if not row.size:
        return some
    r = some.brackets(positions).radius(place[:, None])
    value, angle = refine(scene.take(row), r, some.side, some.angle[:, None], accuracy.search)
    higher = np.flatnonzero(value[:, 0] > largest)
    return some.twins(higher, place[higher], value[higher, 0], angle[higher, 0])


def _other_peaks(
    values: FloatArray, best: NDArray[np.intp], tolerance: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Row and column of local maxima of each row, shape (m, k), that are almost as high as the best."""
    padded = np.pad(values, ((0, 0), (1, 1)), constant_values=-1.0)
    peak = (1.0 - tolerance) * values > np.maximum(padded[:, 2:], padded[:, :-2])
    high = values >= (1.0 - TWIN) * pick(values, best)[:, None]
    row, column = np.nonzero(peak & high & (np.arange(values.shape[1]) != best[:, None]))
    return row, column


def _polynomial_maximum(values: FloatArray, c: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Maximum of the polynomials through the values (m, k) of a first look, near ``c`` of shape (m,)."""
    # Not a matrix product, see `chebyshev.running_integral`.
    series = np.einsum("pk,mk->pm", _POWERS, values)
    c = polynomial_maximum(series, c, c - FIRST_WIDTH, c + FIRST_WIDTH)
    return c, np.polynomial.polynomial.polyval(c, series, tensor=False)


def _look(centre: FloatArray, width: FloatArray) -> FloatArray:
    """Values of c around the centres, ascending, shape (m, k), on the centre's side of a corner."""
    c = np.clip(centre[:, None] + width[:, None] * OFFSETS, -1.0, 1.0)
    c = np.where(centre[:, None] > 0.0, np.maximum(c, 0.0), c)
    return np.where(centre[:, None] < 0.0, np.minimum(c, 0.0), c)
