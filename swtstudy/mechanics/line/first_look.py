"""A first look along the surface line: where swt may be largest, from positions that resolve it.

Between two cusps swt(r) is smooth but for square roots at the ends and convex kinks, so that its maxima are
smooth or at the ends. Each piece gets nested cosine-spaced positions, doubled until the finer ones are as the
coarser ones predict, or until what is left unseen cannot be the largest.

A measured loop of k vertices has some k cusps or more, most of which are small, or lie low. Runs of short
pieces are looked at where they begin, and halved where they may hold the largest swt; around the highest
places that are found the pieces stay as they are, elsewhere runs of them become one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.line.look import Look, Resolution, reach
from swtstudy.mechanics.line.positions import Pieces, Positions
from swtstudy.mechanics.numerics.arrays import as_rows, largest_of_rows, place_in_row
from swtstudy.mechanics.planes.through_y import PlaneHistory, apart, coarse_swt
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.scene import Scene

#: Share of the largest swt that planes and instants may leave unseen, and so may positions where it is lower
#: by more than that. Twice or half: no maximum more or less is overlooked (`studies/checks/overlooked.py`).
SHARE = 0.05
#: What positions may leave unseen elsewhere. As much: 6e-4 at a point of tests/mechanics/test_overlooked.py;
#: a third: 1e-3 low at a point of tests/mechanics/test_surface_circle.py.
CLOSE_SHARE = 0.01
#: Roundings by which a position may be off. None: s is 8e-3 low in a slip zone of 1e-11
#: (tests/mechanics/test_stability.py).
ROUNDINGS = 8.0
#: Steps with which a piece begins, and steps at most.
STEPS, MOST_STEPS = 2, 256
#: What three values leave unseen: so many times their misfit from a line (once: results/margins.md), and
#: in a long piece this share of the largest swt at least. None: 0.13 at a point of
#: tests/mechanics/test_overlooked.py.
OF_FIRST, IN_LONG = 8.0, 0.7
#: A layer is thin if it is shorter than this share of a piece. Without: 1.4e-4 at a point of
#: tests/mechanics/test_overlooked.py.
THIN = 1.0 / 12.0
#: Planes that are tried, and instants, which leave such a share unseen; and more instants where that may be
#: the largest. Without: 7e-4 and 3e-3 at points of tests/mechanics/test_overlooked.py.
PLANES, RESOLUTION = 16, Resolution(nodes=2, zooms=0, digits=3.5)
CLOSER = Resolution(nodes=4, zooms=0, digits=4.0)
#: Change of 2θ to the next position, rad, from which on the plane may be another one. Never: 1e-3 at a point
#: of tests/mechanics/test_overlooked.py.
OTHER_PLANE = 0.08
#: Points times positions times intervals of the cycle that are looked at together: memory is bounded, and
#: what is looked at stays in the processor's cache. Three times: 4 % slower.
LOOK_SIZE = 10_000
#: Positions of a point that are looked at together at least, however many intervals its cycle has.
LEAST_PART = 32


@dataclass(frozen=True)
class Seen(Rows):
    """swt at positions of the line to the accuracy of a first look, (…, 2), or (…, 1) where sides are alike.

    Attributes
    ----------
    swt, double_angle
        At x = +r and x = −r, and 2θ of the best planes in rad.
    highest
        How high swt on these planes may really be between the instants.
    """

    swt: FloatArray
    double_angle: FloatArray
    highest: FloatArray


def first_look(scene: Scene, position: FloatArray, resolution: Resolution, planes: int) -> Seen:
    """Look at positions r = |x|, shape (n, X), on both sides of n contacts, on so many planes."""
    # Half of the period is enough where the other half is its mirror image.
    mirrored = scene.mirrored_half
    cycle = scene.cycle.first_half() if mirrored else scene.cycle
    look = Look.at(replace(scene, cycle=cycle), position, resolution.nodes, resolution.digits)
    history, inside = look.history, look.inside
    if mirrored:
        # The same instants with the tangential load reversed.
        history = history.followed_by(history.with_tangential_sign(-1.0))
        inside = np.concatenate([inside, inside], axis=-1)
    signs = (1.0,) if mirrored else (1.0, -1.0)
    sides = [_seen(scene.planes(history, sign), inside, planes) for sign in signs]
    return Seen(*(np.stack(both, axis=-1) for both in zip(*sides, strict=True)))


def _seen(planes: PlaneHistory, inside: BoolArray, count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Values of `Seen` for one side, each (n, X)."""
    swt, angle = coarse_swt(planes, count)
    highest = swt.copy()
    at = np.nonzero(swt >= (1.0 - 3.0 * SHARE) * swt.max(axis=1, keepdims=True))
    some = planes.take(*at)
    of_swt = some.criterion.curves(*some.on_plane(angle[at]))
    highest[at] = some.criterion.of_maxima(*(reach(curve, inside[at]) for curve in of_swt))
    return swt, angle, highest


def resolved(scene: Scene, pieces: Pieces, least: FloatArray | float = np.inf) -> tuple[Positions, Seen]:
    """Positions that resolve swt in all pieces as far as it may be largest there, and what is seen.

    With ``least``, shape (n,), the first values of a piece that may be as high as that are not enough.
    """
    found = list(_nested(scene, pieces, np.broadcast_to(least, len(scene))))
    piece, share = (np.concatenate([part[k] for part in found]) for k in range(2))
    order = np.lexsort((share, piece))
    piece, share, seen = piece[order], share[order], Seen.joined([part[2] for part in found]).take(order)
    # Where swt may be nearly as high, a maximum may hide in what instants leave unseen.
    point = pieces.point[piece]
    enough = (1.0 - CLOSE_SHARE) * largest_of_rows(point, seen.swt.max(axis=1))[point]
    high = np.flatnonzero((seen.highest >= enough[:, None]).any(axis=1))
    closer = look_at(scene, pieces, piece[high], share[high], CLOSER)
    # What either look shows is there, and what either cannot exclude may be.
    before = seen.take(high)
    angle = np.where(closer.swt > before.swt, closer.double_angle, before.double_angle)
    highest = np.maximum(before.highest, closer.highest)
    seen.write(high, Seen(np.maximum(before.swt, closer.swt), angle, highest))
    return Positions.of(pieces, piece, np.pi * share), seen


def _nested(scene: Scene, pieces: Pieces, least: FloatArray) -> Iterator[tuple[IndexArray, FloatArray, Seen]]:
    """Places, as pieces and shares of their angles, and what is seen there: ever closer ones."""
    steps, going = STEPS, np.arange(len(pieces.point))
    # The last piece of a point has its end, too; the others end where the next one begins.
    even = np.repeat(going, steps + pieces.is_last)
    layer, of_layer = pieces.layers(THIN)
    piece, share = np.concatenate([even, layer]), np.concatenate([place_in_row(even) / steps, of_layer])
    order = np.lexsort((share, piece))
    first = look_at(scene, pieces, piece[order], share[order]).take(np.argsort(order))
    yield piece, share, first
    values = first.swt[np.searchsorted(even, going)[:, None] + np.arange(steps + 1)]
    largest, within = np.zeros(len(scene)), np.ones((going.size, steps), dtype=bool)
    # Beside the end of a piece swt goes with the root of the distance.
    rounding = np.sqrt(ROUNDINGS * np.spacing(pieces.high) / (pieces.high - pieces.low))
    while True:
        np.maximum.at(largest, pieces.point[going], values.max(axis=(1, 2)))
        owner, long = pieces.point[going], pieces.are_long[going]
        within &= _open_gaps(values, largest[owner], least[owner], rounding[going], long)
        open_ = within.any(axis=1)
        going, values, within = going[open_], values[open_], within[open_]
        if not going.size or steps == MOST_STEPS:
            break
        row, gap = np.nonzero(within)
        piece, share = going[row], (gap + 0.5) / steps
        seen = look_at(scene, pieces, piece, share)
        yield piece, share, seen
        finer = np.empty((going.size, 2 * steps + 1, values.shape[-1]))
        finer[:, ::2], finer[:, 1::2] = values, _predicted(values)
        finer[row, 2 * gap + 1] = seen.swt
        values, within, steps = finer, np.repeat(within, 2, axis=1), 2 * steps


def _open_gaps(
    values: FloatArray, top: FloatArray, least: FloatArray, rounding: FloatArray, long: BoolArray
) -> BoolArray:
    """Between which values of pieces, (m, k + 1, sides), more are needed, shape (m, k); others of (m,)."""
    unseen = np.abs(values[:, 1::2] - _predicted(values[:, ::2])).max(axis=(1, 2))[:, None]
    are_first = values.shape[1] == STEPS + 1
    if are_first:
        # So few values say little, and less in a long piece.
        unseen = np.maximum(OF_FIRST * unseen, np.where(long, IN_LONG * top, 0.0)[:, None])
    highest = np.maximum(values[:, :-1], values[:, 1:]).max(axis=2) + unseen
    of_piece, top = highest.max(axis=1, keepdims=True), top[:, None]
    enough = (1.0 - SHARE) * top
    # Only a piece that is nearly known can be parted into gaps.
    anywhere = (unseen > SHARE * top) & (of_piece > enough) | are_first & (of_piece > least[:, None])
    close = np.maximum(CLOSE_SHARE, rounding)[:, None]
    return np.asarray(anywhere | ((unseen > close * top) & (highest > enough)))


def _predicted(values: FloatArray) -> FloatArray:
    """Values midway between evenly spaced ones, (m, k, sides), by the nearest four of them, or all."""
    if values.shape[1] == 2:
        return np.asarray(values.mean(axis=1, keepdims=True))
    if values.shape[1] == 3:
        weights = np.array([[3.0, 6.0, -1.0], [-1.0, 6.0, 3.0]]) / 8.0
        return np.asarray(np.einsum("ij,mjs->mis", weights, values))
    inner = 9.0 * (values[:, 1:-2] + values[:, 2:-1]) - values[:, :-3] - values[:, 3:]
    at_end = np.array([5.0, 15.0, -5.0, 1.0])
    first, last = (np.einsum("j,mjs->ms", at_end, v)[:, None] for v in (values[:, :4], values[:, :-5:-1]))
    return np.concatenate([first, inner, last], axis=1) / 16.0


def look_at(
    scene: Scene, pieces: Pieces, piece: IndexArray, share: FloatArray, resolution: Resolution = RESOLUTION
) -> Seen:
    """Look at shares of the angle of pieces, (m,) each, the pieces in ascending order."""
    point, r = pieces.point[piece], pieces.radius(piece, np.pi * share)
    found = Seen(*np.empty((3, point.size, 1 if scene.mirrored_half else 2)))
    intervals = scene.cycle.begin.shape[1]
    owner, part = _parts(point, max(LOOK_SIZE // intervals, LEAST_PART))
    count = np.bincount(part)
    # Parts with as many positions together.
    left = np.argsort(-count, kind="stable")
    while left.size:
        # Rows are as long as the longest, which is at most twice the shortest.
        longest = count[left[0]]
        alike = np.searchsorted(-count[left], -0.5 * longest, side="right")
        size = min(max(LOOK_SIZE // (longest * intervals), 1), int(alike))
        rows, left = left[:size], left[size:]
        index, real = as_rows(part, rows)
        look = first_look(scene.take(owner[rows]), r[index], resolution, PLANES)
        found.write(index[real], look.take(real))
    return found


def _parts(point: IndexArray, most: int) -> tuple[IndexArray, IndexArray]:
    """The positions of points, (m,) ascending, in parts of so many at most: of whom each is, and which."""
    first = place_in_row(point) % most == 0
    return point[first], np.cumsum(first) - 1


def high_positions(
    positions: Positions, seen: Seen, least: FloatArray | None = None
) -> tuple[IndexArray, IndexArray]:
    """Numbers and sides of the positions around which swt may be largest, shape (k,) each.

    These are the local maxima of what is seen, as far as positions, instants and planes may each leave a
    share of it unseen, and those of what may be between the instants, as far as it may be the largest; and
    where another plane takes over, whose maximum may hide beside the flank of a higher neighbour's, or where
    the layer beside one of them ends, behind which another one may be. With ``least``, of shape (n,), those
    as high as that.
    """
    point = positions.point
    if least is None:
        least = largest_of_rows(point, seen.swt.max(axis=1))
    enough = least[point][:, None]
    chosen = peaks(point, seen.swt) & (seen.swt >= (1.0 - 3.0 * SHARE) * enough)
    beside = np.zeros_like(chosen)
    beside[1:] = chosen[:-1]
    beside[:-1] |= chosen[1:]
    beside &= ~(positions.is_even | positions.is_corner)[:, None]
    chosen |= peaks(point, seen.highest) & (seen.highest >= enough)
    chosen |= (flanks(point, seen) | beside) & (seen.swt >= (1.0 - SHARE) * enough)
    place, side = np.nonzero(chosen)
    return place, side


def flanks(point: IndexArray, seen: Seen) -> BoolArray:
    """Which positions, (m, sides), have a higher neighbour on another plane."""
    angle, swt = seen.double_angle, seen.swt
    turn = apart(np.diff(angle, axis=0)) > OTHER_PLANE
    turn &= (np.diff(point) == 0)[:, None]
    flank = np.zeros(swt.shape, dtype=bool)
    flank[:-1] |= turn & (swt[:-1] < swt[1:])
    flank[1:] |= turn & (swt[1:] <= swt[:-1])
    return flank


def peaks(point: IndexArray, values: FloatArray) -> BoolArray:
    """Local maxima of values, (m, sides), at the positions of points, (m,); of equal ones the first."""
    same = (np.diff(point) == 0)[:, None]
    peak = np.ones(values.shape, dtype=bool)
    peak[:-1] &= ~same | (values[:-1] >= values[1:])
    peak[1:] &= ~same | (values[1:] > values[:-1])
    return peak


#: Points with so many pieces at most are looked at in each of them.
MANY = 128
#: Runs of pieces at first, and how many of a point are halved at a time, the highest ones. A piece longer
#: than such a share of the line is none of a run.
RUNS, HALVED = 64, 48
#: Places of a point around which pieces stay, the highest ones, and how many of these to either side.
PLACES, BESIDE = 16, 2
#: How finely swt is computed to choose them.
ROUGH = Resolution(nodes=1, zooms=0, digits=3.5)


def joined_pieces(scene: Scene, pieces: Pieces) -> Pieces:
    """The pieces, of which runs that need no look of their own are joined."""
    many = np.bincount(pieces.point, minlength=len(scene)) > MANY
    begins = np.ones(len(pieces.point), dtype=bool)
    own = np.flatnonzero(many[pieces.point])
    if not own.size:
        return pieces
    begins[own] = _begins(scene, Pieces(pieces.point[own], pieces.low[own], pieces.high[own]))
    # Each piece now ends where the next one of its point begins.
    last = np.append(np.flatnonzero(begins)[1:] - 1, len(begins) - 1)
    return Pieces(pieces.point[begins], pieces.low[begins], pieces.high[last])


def _begins(scene: Scene, pieces: Pieces) -> BoolArray:
    """With which of the pieces, (P,), one begins once others are joined to it."""
    run = _runs(pieces)
    seen = Seen(*np.full((3, len(run), 1 if scene.mirrored_half else 2), np.nan))
    looked, new = np.zeros_like(run), np.flatnonzero(run)
    for _ in range(int(np.diff(new, append=len(run)).max()).bit_length() + 1):
        seen.write(new, look_at(scene, pieces, new, np.zeros(new.size), ROUGH))
        looked[new] = True
        new = _halves(pieces.point, seen.swt, np.flatnonzero(looked))
    kept = _kept(pieces.point, seen, np.flatnonzero(looked))
    behind = np.append(True, kept[:-1])
    return run | kept | behind


def _runs(pieces: Pieces) -> BoolArray:
    """Which pieces begin a run: every so many, each long one, and what is behind that."""
    first = np.append(True, np.diff(pieces.point) > 0)
    count = np.bincount(pieces.point)
    rank = place_in_row(pieces.point)
    width = largest_of_rows(pieces.point, pieces.high)
    long = pieces.high - pieces.low > width[pieces.point] / RUNS
    return first | (rank % -(-count // RUNS)[pieces.point] == 0) | long | np.append(True, long[:-1])


def _halves(point: IndexArray, swt: FloatArray, looked: IndexArray) -> IndexArray:
    """The middles of the runs between places that were looked at, as far as they may hold the largest swt."""
    same = np.diff(point[looked]) == 0
    left, right = swt[looked[:-1]], swt[looked[1:]]
    change = np.where(same[:, None], np.abs(right - left), 0.0)
    around = np.pad(change, ((1, 1), (0, 0)))
    rise = np.maximum(np.maximum(around[:-2], around[2:]), change)
    top = largest_of_rows(point[looked], swt[looked].max(axis=1))[point[looked[:-1]]]
    height = (np.maximum(left, right) + rise).max(axis=1)
    open_ = np.flatnonzero((height >= (1.0 - SHARE) * top) & same & (np.diff(looked) > 1))
    chosen = open_[_highest(point[looked[open_]], height[open_], HALVED)]
    return (looked[chosen] + looked[chosen + 1]) // 2


def _kept(point: IndexArray, seen: Seen, looked: IndexArray) -> BoolArray:
    """Which pieces lie about the highest places."""
    some, own = seen.take(looked), point[looked]
    top = largest_of_rows(own, some.swt.max(axis=1))[own]
    high = some.swt >= (1.0 - 3.0 * SHARE) * top[:, None]
    high &= peaks(own, some.swt) | flanks(own, some)
    height = np.where(high, some.swt, 0.0).max(axis=1)
    places = looked[_highest(own, height, PLACES) & (height > 0.0)]
    kept = np.zeros(len(point), dtype=bool)
    for step in range(-BESIDE, BESIDE):
        kept[np.clip(places + step, 0, len(point) - 1)] = True
    return kept


def _highest(point: IndexArray, height: FloatArray, count: int) -> BoolArray:
    """Which heights are among the highest ones of their points, (m,) ascending."""
    order = np.lexsort((-height, point))
    highest = np.empty(len(order), dtype=bool)
    highest[order] = place_in_row(point) < count
    return highest
