"""The maximum of swt over the surface line (eq. 10): global first, then local."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.gather import gather, pick
from swtstudy.mechanics.instants import split_at_breakpoints
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.positions import PositionBrackets, Positions, positions_of_first_look
from swtstudy.mechanics.swt_line import FirstLook, Resolution, Scene, first_look, refine

#: Planes that the first look tries.
SCAN_PLANES = 24
SCAN_RESOLUTION = Resolution(nodes=2, zooms=0, digits=3.5)
#: Local maxima below these shares of the largest are not followed, after the first look and each round.
CANDIDATE_SHARES = np.array([0.85, 0.97, 0.995, 0.999])
#: Distances at which each round of the local search looks, in widths, and how the width shrinks.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0, 3.0])
FIRST_WIDTH, SHRINKING = 0.25, 0.2
#: How the width shrinks while the best position is the outermost one.
WALKING = 2.0 / 3.0
LEAST_ROUND_COUNT, LARGEST_ROUND_COUNT = 2, 9
#: Local maxima times squared intervals of the cycle that one look takes at a time: its memory is bounded.
PART_SIZE = 400_000
#: Share of the last round's change that the next one would make at most.
CHANGE_SHARE = 0.03
#: Error left to the search over x, and least error that is claimed, as shares of the tolerance.
SETTLED, LEAST_ERROR = 0.3, 0.1
#: Two local maxima whose heights differ by less, relative, are both followed.
TWIN = 0.01
#: Positions nearer than this share of their range lie side by side.
SIDE_BY_SIDE = 1e-4
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
    """

    search: Resolution
    check: Resolution
    tolerance: float

    @classmethod
    def for_tolerance(cls, rtol: float) -> Accuracy:
        """The least effort that keeps the error below ``rtol``."""
        digits = -np.log10(rtol)
        # A zoom gains a factor of 30.
        zooms = max(int(np.ceil(0.5 * digits)) + int(digits > 5.0), 1)
        return cls(Resolution(4, zooms, digits + 1.0), Resolution(5, zooms + 1, digits + 2.5), rtol)

    def finer(self) -> Accuracy:
        """The same with twice the instants."""
        search, check = (replace(r, nodes=2 * r.nodes) for r in (self.search, self.check))
        return replace(self, search=search, check=check)


@dataclass(frozen=True)
class Maximum:
    """Largest swt of n points.

    Attributes
    ----------
    swt, error
        Shape (n,): over E* δ0/R, and its estimated absolute error.
    position
        Shape (n,): signed x in a_H.
    double_angle
        Shape (n,): 2θ of the critical plane's normal, rad.
    """

    swt: FloatArray
    error: FloatArray
    position: FloatArray
    double_angle: FloatArray


@dataclass
class _Climb:
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
    top
        Estimated maximum of swt.
    change
        Change of `top` in the last round.
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
    change: FloatArray
    rounds: NDArray[np.intp]
    settled: NDArray[np.bool_]

    @classmethod
    def start(cls, split: Scene, look: FirstLook, scene: Scene, positions: Positions) -> _Climb:
        """From the first look at the scene, for its finer division."""
        peak = local_maxima(look.swt, positions.r)
        point, side, column = peak
        angle, hot = look.closer(scene, *peak)
        hot = gather(hot, split.cycle.number[point])
        centre, top, change = np.zeros((3, len(point)))
        width, rounds = np.full(len(point), FIRST_WIDTH), np.zeros(len(point), dtype=np.intp)
        settled = np.zeros(len(point), dtype=bool)
        x_sign = np.where(side == 0, 1.0, -1.0)
        return cls(point, x_sign, column, hot, angle, centre, width, top, change, rounds, settled)

    def take(self, index: NDArray[np.intp] | NDArray[np.bool_]) -> _Climb:
        return _Climb(*(values[index] for values in vars(self).values()))

    def without_followers(self, moved: NDArray[np.bool_]) -> _Climb:
        """Without those that have just moved to a position around which another one searches."""
        order = np.lexsort((moved, self.column, self.side, self.point))
        key = np.stack([self.point, self.side, self.column])[:, order]
        same = np.zeros(len(order), dtype=bool)
        same[1:] = (key[:, 1:] == key[:, :-1]).all(axis=0)
        return self.take(order[~(same & moved[order])])

    def joined(self, other: _Climb) -> _Climb:
        both = zip(vars(self).values(), vars(other).values(), strict=True)
        return _Climb(*(np.concatenate(pair) for pair in both))

    def brackets(self, positions: Positions) -> PositionBrackets:
        return PositionBrackets.around(positions, self.point, self.column)


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene.

    Points that miss the tolerance are searched once more with twice the instants.
    """
    found = _search(scene, accuracy)
    doubtful = np.flatnonzero(found.error > accuracy.tolerance * found.swt)
    if doubtful.size:
        again = _search(scene.take(doubtful), accuracy.finer())
        # What was found is there: the larger value stands, and the smaller error.
        better = (again.error < found.error[doubtful]) & (
            again.swt >= found.swt[doubtful] - found.error[doubtful]
        )
        rows = doubtful[better]
        for old, new in zip(vars(found).values(), vars(again).values(), strict=True):
            old[rows] = new[better]
    return found


def _search(scene: Scene, accuracy: Accuracy) -> Maximum:
    """First look, local search and check."""
    split = replace(scene, cycle=split_at_breakpoints(scene.cycle))
    positions = positions_of_first_look(split.cycle, scene.profile)
    look = first_look(scene, positions.r, SCAN_RESOLUTION, SCAN_PLANES)
    climb = _Climb.start(split, look, scene, positions)
    largest_part = max(PART_SIZE // split.cycle.begin.shape[1] ** 2, 1)
    for _ in range(LARGEST_ROUND_COUNT):
        active = np.flatnonzero(~climb.settled)
        if not active.size:
            break
        before = climb.column.copy()
        parts = np.array_split(active, -(-active.size // largest_part))
        twins = [_step(split, positions, climb, part, accuracy) for part in parts]
        climb = climb.without_followers(climb.column != before)
        for some in twins:
            climb = climb.joined(some)
        largest = np.zeros(len(scene))
        np.maximum.at(largest, climb.point, climb.top)
        share = CANDIDATE_SHARES[climb.rounds.clip(0, len(CANDIDATE_SHARES) - 1)]
        climb = climb.take(climb.top >= share * largest[climb.point])
    order = np.lexsort((-climb.top, climb.point))
    best = climb.take(order[np.unique(climb.point[order], return_index=True)[1]])
    r = best.brackets(positions).radius(best.centre[:, None])
    value, angle = refine(
        split.select(best.point, best.hot), r, best.side, best.angle[:, None], accuracy.check
    )
    error = np.abs(value[:, 0] - best.top) + CHANGE_SHARE * best.change
    # Nothing finer than this was looked at.
    error = np.maximum(error, LEAST_ERROR * accuracy.tolerance * value[:, 0])
    return Maximum(value[:, 0], error, best.side * r[:, 0], angle[:, 0])


def _step(
    scene: Scene, positions: Positions, climb: _Climb, active: NDArray[np.intp], accuracy: Accuracy
) -> _Climb:
    """Look around the centres of the active local maxima, move there and narrow the search.

    Returns
    -------
    Other local maxima that this look has found between the same neighbours.
    """
    now = climb.take(active)
    brackets = now.brackets(positions)
    c = _look(now.centre, now.width)
    start = np.repeat(now.angle[:, None], c.shape[1], axis=1)
    values, angles = refine(
        scene.select(now.point, now.hot), brackets.radius(c), now.side, start, accuracy.search
    )
    # Equal values, as beyond the last position, count for the centre.
    best = (values * (1.0 - TIE * np.abs(c - now.centre[:, None]))).argmax(axis=1)
    found = pick(c, best)
    centre, top = _vertex(c, values, best, brackets.is_corner)
    change = np.abs(top - now.top)
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
    climb.change[active] = change
    narrower = now.width * np.where(outermost, WALKING, SHRINKING)
    climb.width[active] = np.where(beyond, FIRST_WIDTH, narrower)
    climb.rounds[active] += ~outermost
    small = np.maximum(CHANGE_SHARE * change, rise) <= SETTLED * accuracy.tolerance * top
    enough = now.rounds + 1 >= LEAST_ROUND_COUNT
    climb.settled[active] = ~outermost & small & enough & (flat | ~stays)
    row, second = _other_peaks(values, best, accuracy.tolerance)
    row, second = (index[now.rounds[row] == 0] for index in (row, second))
    twins = now.take(row)
    return replace(
        twins,
        angle=angles[row, second],
        centre=c[row, second],
        width=twins.width * SHRINKING,
        top=values[row, second],
        change=values[row, second],
        rounds=twins.rounds + 1,
    )


def _other_peaks(
    values: FloatArray, best: NDArray[np.intp], tolerance: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Row and column of local maxima of each row, shape (m, k), that are almost as high as the best."""
    padded = np.pad(values, ((0, 0), (1, 1)), constant_values=-1.0)
    peak = (1.0 - tolerance) * values > np.maximum(padded[:, 2:], padded[:, :-2])
    high = values >= (1.0 - TWIN) * pick(values, best)[:, None]
    row, column = np.nonzero(peak & high & (np.arange(values.shape[1]) != best[:, None]))
    return row, column


def local_maxima(
    swt: FloatArray, r: FloatArray
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Point, side and column of the local maxima that may hold the largest swt.

    Parameters
    ----------
    swt
        Shape (n, 1 or 2, X), on one or both sides.
    r
        Shape (n, X): the positions, ascending; shorter rows repeat their first one.
    """
    largest = swt.max(axis=(1, 2), keepdims=True)
    # Of two cusps side by side, each has its own neighbour on the other side.
    gap = np.diff(r)
    close = (gap > 0.0) & (gap < SIDE_BY_SIDE * (r.max(axis=1) - r[:, 0])[:, None])
    least = np.where(close, 1.0 - TWIN, 1.0)[:, None]
    above = np.pad(swt[..., :-1] >= least * swt[..., 1:], ((0, 0), (0, 0), (0, 1)), constant_values=True)
    before = (swt[..., 1:] > swt[..., :-1]) | (close[:, None] & (swt[..., 1:] >= least * swt[..., :-1]))
    before = np.pad(before, ((0, 0), (0, 0), (1, 0)), constant_values=True)
    peak = above & before & (swt >= CANDIDATE_SHARES[0] * largest)
    # A point without tension anywhere keeps one bracket all the same.
    peak[:, 0, 0] |= largest[:, 0, 0] <= 0.0
    point, side, column = np.nonzero(peak)
    return point, side, column


def _look(centre: FloatArray, width: FloatArray) -> FloatArray:
    """Values of c around the centres, ascending, shape (m, k), on the centre's side of a corner."""
    c = np.clip(centre[:, None] + width[:, None] * OFFSETS, -1.0, 1.0)
    c = np.where(centre[:, None] > 0.0, np.maximum(c, 0.0), c)
    return np.where(centre[:, None] < 0.0, np.minimum(c, 0.0), c)


def _vertex(
    c: FloatArray, values: FloatArray, best: NDArray[np.intp], is_corner: NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray]:
    """Abscissa and value of the maximum of a parabola through the ``best`` value and its neighbours.

    At a corner each side has its own parabola, through the corner and the next two values.
    """
    last = c.shape[1] - 1
    corner = is_corner & (pick(c, best) == 0.0)
    position, top = pick(c, best), pick(values, best)
    for toward in (-1, 1):
        middle = np.where(corner, best + toward, best)
        middle = np.clip(middle, 1, last - 1)
        index = middle[:, None] + np.array([-1, 0, 1])
        x, y = gather(c, index), gather(values, index)
        vertex, height = _parabola_maximum(x, y)
        higher = height > top
        position, top = np.where(higher, vertex, position), np.where(higher, height, top)
    return position, top


def _parabola_maximum(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Maximum of the parabolas through three points within their range, shapes (m, 3); else the largest y."""
    left, right = x[:, 1] - x[:, 0], x[:, 2] - x[:, 1]
    proper = (left > 0.0) & (right > 0.0)
    left, right = np.where(proper, left, 1.0), np.where(proper, right, 1.0)
    rise, fall = (y[:, 1] - y[:, 0]) / left, (y[:, 2] - y[:, 1]) / right
    bend = (fall - rise) / (left + right)
    proper &= bend < 0.0
    slope = (rise * right + fall * left) / (left + right)
    shift = np.where(proper, -0.5 * slope / np.where(proper, bend, 1.0), 0.0)
    proper &= (shift >= -left) & (shift <= right)
    best = y.argmax(axis=1)
    return (
        np.where(proper, x[:, 1] + shift, pick(x, best)),
        np.where(proper, y[:, 1] + 0.5 * slope * shift, pick(y, best)),
    )
