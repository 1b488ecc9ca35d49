"""Rounds of the climbs: look at a few positions around each centre, move to the vertex, narrow.

Each climb looks at `OFFSETS` around its best position and fits parabolas or a polynomial, until a further
round would change too little. A round may find other maxima between the same neighbours, which get climbs of
their own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.line.climb import FIRST_WIDTH, SHRINKING, Climb
from swtstudy.mechanics.line.first_look import SHARE
from swtstudy.mechanics.line.look import SETTLED, Accuracy
from swtstudy.mechanics.line.positions import Positions
from swtstudy.mechanics.line.refine import SAME_PLANE, refine, refine_beside
from swtstudy.mechanics.numerics.arrays import pick
from swtstudy.mechanics.numerics.roots import polynomial_maximum, powers_from_values, vertex_near
from swtstudy.mechanics.planes.through_y import apart
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.scene import Scene

#: Distances at which each round looks, in widths. All over 1.5: 4e-7, the same time.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0, 3.0])
POWERS = powers_from_values(FIRST_WIDTH * OFFSETS)
#: How the width grows while the best position is the outermost one: the search was narrowed too early. 2/3,
#: by which it may never get there: 2e-6 low at a point of tests/mechanics/test_overlooked.py, at every rtol.
WALKING = 2.0
#: Share of the last round's change that further ones make at most: a parabola is off by the square of the
#: width and more, but beside a corner swt may begin like a root.
CHANGE_SHARE, CORNER_CHANGE_SHARE = SHRINKING**2, SHRINKING**0.5
#: Error of the maximum of a polynomial through all values, as a share of its distance from a parabola's.
#: A tenth: 4e-6 at rtol 1e-5, no faster.
POLYNOMIAL_SHARE = 0.3
#: The plane turns so many times faster between two values than between others where another takes over.
#: Never: 2e-6 low at a point of tests/mechanics/test_overlooked.py, at each rtol down to 1e-6.
SUDDEN = 4.0
#: Values closer than this share of the tolerance are equal: the climb stays. 0: it walks off on rounding, and
#: s_error is all of s at a point of tests/mechanics/test_s_error.py. 1: a second maximum is not followed, and
#: s is 1.3e-4 low at a point of tests/mechanics/test_overlooked.py.
TIE = 1e-3
#: Rounds at most: from position to position climbs may go far. A quarter: values over a critical distance are
#: about places on flanks (tests/mechanics/test_worst_means.py).
LARGEST_ROUND_COUNT = 64
#: Local maxima times squared intervals of the cycle that a round does at a time: memory is bounded.
PART_SIZE = 100_000


@dataclass(frozen=True)
class _Seen:
    """Samples of a round of m climbs, k positions each.

    Attributes
    ----------
    scene, brackets
        The climbs' scenes, and the gaps that they are in.
    c, values, angles
        Shape (m, k): positions in the gaps, swt there and 2θ of the best planes, rad.
    best
        Shape (m,): column of the largest value.
    """

    scene: Scene
    brackets: Positions
    c: FloatArray
    values: FloatArray
    angles: FloatArray
    best: IndexArray

    @property
    def place(self) -> FloatArray:
        """Shape (m,): c of the largest value."""
        return pick(self.c, self.best)

    @property
    def largest(self) -> FloatArray:
        """Shape (m,)."""
        return pick(self.values, self.best)

    @property
    def is_outermost(self) -> BoolArray:
        """Shape (m,): whether the largest value is the first or the last."""
        return (self.best == 0) | (self.best == self.c.shape[1] - 1)


@dataclass(frozen=True)
class _Vertex:
    """Where the maxima are, from a fit to what was seen, arrays of shape (m,).

    Attributes
    ----------
    centre, top
        c and swt of the maximum.
    remaining
        How much `top` would change in further rounds, at most.
    clear
        Whether one round is enough.
    """

    centre: FloatArray
    top: FloatArray
    remaining: FloatArray
    clear: BoolArray


def climb_to_tops(
    scene: Scene, positions: Positions, climb: Climb, accuracy: Accuracy, only_highest: bool = False
) -> Climb:
    """Climb until all, or only those that may be the highest of their point, have settled, or long enough."""
    for turn in range(LARGEST_ROUND_COUNT):
        going = np.flatnonzero(~climb.settled)
        if not going.size:
            break
        intervals = int(climb.intervals[going].sum(axis=1).max())
        parts = np.array_split(going, -(-going.size // max(PART_SIZE // intervals**2, 1)))
        rounds = [_climb_round(scene, positions, climb.take(part), accuracy) for part in parts]
        moved = Climb.joined([climb.take(climb.settled), *(same for same, _ in rounds)])
        before = np.concatenate([climb.place[climb.settled], climb.place[going]])
        others = [other for _, other in rounds]
        climb = Climb.joined([moved.without_followers(moved.place != before), *others])
        if only_highest:
            climb = climb.leading(turn)
    return climb


@dataclass(frozen=True)
class Tops(Rows):
    """The closer look where m climbs have ended.

    Attributes
    ----------
    climb
        The climbs.
    position, value, angle
        Shape (m,): signed x in a_H, swt, and 2θ of the best plane, rad.
    """

    climb: Climb
    position: FloatArray
    value: FloatArray
    angle: FloatArray


def tops(
    scene: Scene, positions: Positions, climb: Climb, accuracy: Accuracy, only_highest: bool = False
) -> Tops:
    """Climb, and look once more; from where that is higher, on instants or a plane unseen so far, climb on.

    For ``only_highest`` see `climb_to_tops`.
    """
    found = _looked_at_once_more(scene, positions, climb, accuracy, only_highest)
    higher = found.value > (1.0 + accuracy.tolerance) * found.climb.top
    if not higher.any():
        return found
    some = found.take(higher)
    again = found.climb.twins(np.flatnonzero(higher), some.climb.centre, some.value, some.angle)
    again = replace(again, intervals=np.ones_like(again.intervals))
    more = _looked_at_once_more(scene, positions, again, accuracy, only_highest)
    return Tops.joined([found.take(~higher), more])


def _looked_at_once_more(
    scene: Scene, positions: Positions, climb: Climb, accuracy: Accuracy, only_highest: bool
) -> Tops:
    climb = climb_to_tops(scene, positions, climb, accuracy, only_highest)
    r = positions.take(climb.place).around(climb.centre[:, None])[:, 0]
    swt, angle = refine_beside(scene.take(climb.point), r, climb.side, climb.angle, accuracy.check)
    return Tops(climb, climb.side * r, swt, angle)


def _climb_round(scene: Scene, positions: Positions, climb: Climb, accuracy: Accuracy) -> tuple[Climb, Climb]:
    """One round of m climbs.

    Returns
    -------
    moved, others
        The same climbs one round later, and those to maxima that this round has found besides.
    """
    seen = _look_around(scene, positions, climb, accuracy)
    moved = _moved(positions, climb, seen, _vertex(climb, seen, accuracy), accuracy.tolerance)
    peaks = _other_peaks(climb, seen, accuracy.tolerance)
    return moved, Climb.joined([peaks, _beside_corners(climb, seen, accuracy)])


def _look_around(scene: Scene, positions: Positions, climb: Climb, accuracy: Accuracy) -> _Seen:
    brackets = positions.take(climb.place)
    centre = climb.centre[:, None]
    c = np.clip(centre + climb.width[:, None] * OFFSETS, -1.0, 1.0)
    # A corner's other side is another function.
    corner = brackets.is_corner[:, None]
    c = np.where(corner & (centre > 0.0), np.maximum(c, 0.0), c)
    c = np.where(corner & (centre < 0.0), np.minimum(c, 0.0), c)
    start = np.repeat(climb.angle[:, None], c.shape[1], axis=1)
    chosen = scene.take(climb.point)
    # The closer look where climbs end is at the whole cycle.
    chosen = replace(chosen, cycle=chosen.cycle.only(climb.intervals))
    values, angles = refine(chosen, brackets.around(c), climb.side, start, accuracy.search)
    # Equal values, as beyond the last position, count for the centre.
    away = np.abs(OFFSETS) / OFFSETS[-1]
    best = (values * (1.0 - TIE * accuracy.tolerance * away)).argmax(axis=1)
    return _Seen(chosen, brackets, c, values, angles, best)


def _vertex(climb: Climb, seen: _Seen, accuracy: Accuracy) -> _Vertex:
    is_corner = seen.brackets.is_corner
    centre, top = vertex_near(seen.c, seen.values, seen.best, is_corner)
    beside_corner = is_corner & (np.abs(climb.centre) < OFFSETS[-1] * climb.width)
    share = np.where(beside_corner, CORNER_CHANGE_SHARE, CHANGE_SHARE)
    remaining, clear = share * np.abs(top - climb.top), np.zeros(len(top), dtype=bool)
    # Five values on a smooth maximum may be enough, between neighbours that predict one another.
    first = (climb.width == FIRST_WIDTH) & (climb.centre == 0.0) & ~is_corner & seen.brackets.is_even
    smooth = np.flatnonzero(accuracy.hasty & first & (np.abs(seen.place) < seen.c[:, -1]))
    parabola = top[smooth]
    centre[smooth], top[smooth] = _polynomial_maximum(seen.values[smooth], centre[smooth])
    remaining[smooth] = POLYNOMIAL_SHARE * np.abs(top[smooth] - parabola)
    clear[smooth] = remaining[smooth] <= SETTLED * accuracy.tolerance * top[smooth]
    # A maximum below what was seen is none.
    clear &= top >= seen.largest
    clear[_jumps(seen.angles)[0]] = False  # values on different planes are no polynomial
    return _Vertex(centre, top, remaining, clear)


def _moved(positions: Positions, climb: Climb, seen: _Seen, vertex: _Vertex, tolerance: float) -> Climb:
    """The climbs at their new places, narrower where the maximum lies between what was looked at."""
    rise = vertex.top - seen.largest
    flat = rise <= CHANGE_SHARE * tolerance * vertex.top
    stays = seen.brackets.is_corner & (seen.place == 0.0) & (flat | (climb.rounds == 0))
    # The maximum may lie outside of what was looked at: up to the neighbour, or beyond it.
    neighbour = np.clip(climb.place + seen.place.astype(np.intp), 0, positions.r.size - 1)
    beyond = (np.abs(seen.place) == 1.0) & (neighbour != climb.place)
    beyond &= positions.point[neighbour] == climb.point
    outermost = beyond | (seen.is_outermost & (seen.place != climb.centre))
    width = np.where(outermost, np.minimum(WALKING * climb.width, FIRST_WIDTH), SHRINKING * climb.width)
    small = np.maximum(vertex.remaining, rise) <= SETTLED * tolerance * vertex.top
    # What a round changes tells of further ones where the round before it had the maximum between its places.
    enough = climb.remaining < climb.top
    # The rise of a parabola is a promise, too.
    remaining = np.where(vertex.clear, vertex.remaining, np.maximum(vertex.remaining, rise))
    return replace(
        climb,
        place=np.where(beyond, neighbour, climb.place),
        centre=np.where(beyond | stays, 0.0, vertex.centre),
        width=np.where(beyond, FIRST_WIDTH, width),
        angle=pick(seen.angles, seen.best),
        top=vertex.top,
        seen=seen.largest,
        remaining=np.where(outermost, vertex.top, remaining),
        rounds=climb.rounds + ~outermost,
        settled=vertex.clear | (~outermost & small & enough & (flat | ~stays)),
    )


def _other_peaks(climb: Climb, seen: _Seen, tolerance: float) -> Climb:
    """Climbs to other values of a first round that are almost as high as the best.

    These are local maxima, or on another plane, whose maximum may hide beside the flank of the best one's.
    """
    new = np.flatnonzero(climb.rounds == 0)
    values, best = seen.values[new], seen.best[new]
    padded = np.pad(values, ((0, 0), (1, 1)), constant_values=-1.0)
    peak = (1.0 - TIE * tolerance) * values > np.maximum(padded[:, 2:], padded[:, :-2])
    last, jump = _jumps(seen.angles[new])
    other = np.where(best[last] > jump, jump, jump + 1)
    peak[last, other] = True
    high = values >= (1.0 - SHARE) * pick(values, best)[:, None]
    row, column = np.nonzero(peak & high & (np.arange(values.shape[1]) != best[:, None]))
    at = new[row], column
    return climb.twins(at[0], seen.c[at], seen.values[at], seen.angles[at])


def _jumps(angles: FloatArray) -> tuple[IndexArray, IndexArray]:
    """Which of m climbs have a sudden turn of their planes, 2θ of shape (m, k), and between which columns."""
    turn = apart(np.diff(angles))
    speed = turn / np.diff(OFFSETS)
    jump = speed.argmax(axis=1)
    others = np.sort(speed, axis=1)[:, -2]
    sudden = (pick(speed, jump) > SUDDEN * others) & (pick(turn, jump) > SAME_PLANE)
    return np.flatnonzero(sudden), jump[sudden]


def _beside_corners(climb: Climb, seen: _Seen, accuracy: Accuracy) -> Climb:
    """Climbs to maxima beside corners that a first round took no value of.

    They are on the other side than its largest value, or on either side where that is at the corner and the
    climb stays there.
    """
    middle = len(OFFSETS) // 2
    corner = seen.brackets.is_corner
    row = np.flatnonzero((climb.rounds == 0) & (climb.centre == 0.0) & ((seen.best != middle) | corner))
    largest = seen.largest[row]
    place, height = vertex_near(seen.c[row], seen.values[row], np.full(len(row), middle), corner[row])
    at_corner = seen.best[row] == middle
    share = np.where(at_corner, SETTLED, 1.0) * accuracy.tolerance
    beside = (at_corner & (place != 0.0)) | (seen.place[row] * place < 0.0)
    beside &= height > (1.0 + share) * largest
    row, place, largest = row[beside], place[beside], largest[beside]
    some = climb.take(row)
    if not row.size:
        return some
    r = seen.brackets.take(row).around(place[:, None])
    value, angle = refine(seen.scene.take(row), r, some.side, some.angle[:, None], accuracy.search)
    higher = np.flatnonzero(value[:, 0] > largest)
    return some.twins(higher, place[higher], value[higher, 0], angle[higher, 0])


def _polynomial_maximum(values: FloatArray, c: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Maximum of the polynomials through the values (m, k) of a first round, near ``c`` of shape (m,)."""
    # Not a matrix product, as in `chebyshev`.
    series = np.einsum("pk,mk->pm", POWERS, values)
    c = polynomial_maximum(series, c, c - FIRST_WIDTH, c + FIRST_WIDTH)
    return c, np.polynomial.polynomial.polyval(c, series, tensor=False)
