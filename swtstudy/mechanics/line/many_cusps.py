"""Lines with many cusps, as of a measured loop: those between which swt may be largest, from few looks.

A loop of k vertices has some k cusps or more. Most of them are small, or lie low. Runs of short pieces are
looked at where they begin, and halved where they may hold the largest swt; around the highest places that are
found the pieces stay as they are, elsewhere runs of them become one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.first_look import SHARE, Seen, flanks, look_at, peaks
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.line.positions import Pieces
from swtstudy.mechanics.numerics.arrays import largest_of_rows, place_in_row
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

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


def _begins(scene: Scene, pieces: Pieces) -> NDArray[np.bool_]:
    """With which of the pieces, (P,), one begins once others are joined to it."""
    run = _runs(pieces)
    seen = Seen(*np.full((3, len(run), 1 if scene.mirrored_half else 2), np.nan))
    looked, new = np.zeros_like(run), np.flatnonzero(run)
    for _ in range(int(np.diff(new, append=len(run)).max()).bit_length() + 1):
        of_new = look_at(scene, pieces, new, np.zeros(new.size), ROUGH)
        for values, found in zip(vars(seen).values(), vars(of_new).values(), strict=True):
            values[new] = found
        looked[new] = True
        new = _halves(pieces.point, seen.swt, np.flatnonzero(looked))
    kept = _kept(pieces.point, seen, np.flatnonzero(looked))
    behind = np.append(True, kept[:-1])
    return run | kept | behind


def _runs(pieces: Pieces) -> NDArray[np.bool_]:
    """Which pieces begin a run: every so many, each long one, and what is behind that."""
    first = np.append(True, np.diff(pieces.point) > 0)
    count = np.bincount(pieces.point)
    rank = place_in_row(pieces.point)
    width = largest_of_rows(pieces.point, pieces.high)
    long = pieces.high - pieces.low > width[pieces.point] / RUNS
    return first | (rank % -(-count // RUNS)[pieces.point] == 0) | long | np.append(True, long[:-1])


def _halves(point: NDArray[np.intp], swt: FloatArray, looked: NDArray[np.intp]) -> NDArray[np.intp]:
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


def _kept(point: NDArray[np.intp], seen: Seen, looked: NDArray[np.intp]) -> NDArray[np.bool_]:
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


def _highest(point: NDArray[np.intp], height: FloatArray, count: int) -> NDArray[np.bool_]:
    """Which heights are among the highest ones of their points, (m,) ascending."""
    order = np.lexsort((-height, point))
    highest = np.empty(len(order), dtype=bool)
    highest[order] = place_in_row(point) < count
    return highest
