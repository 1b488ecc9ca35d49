"""The maximum of swt over the surface line (eq. 10): global first, then local."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.passages import split_at_breakpoints
from swtstudy.mechanics.line.accuracy import Accuracy
from swtstudy.mechanics.line.climb import Climb
from swtstudy.mechanics.line.first_look import first_look
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.line.positions import positions_of_first_look
from swtstudy.mechanics.line.round import climb_round
from swtstudy.mechanics.line.value import refine
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.line import arrival
from swtstudy.mechanics.stress.scene import Scene

#: Planes that the first look tries. Half or twice: no change at 128 points, 5 % faster or slower.
SCAN_PLANES = 16
#: One step in place of two: 3e-7 at rtol 1e-5, 5 % faster; a digit less: 3e-8, no faster.
SCAN_RESOLUTION = Resolution(nodes=2, zooms=0, digits=3.5)
#: Local maxima below these shares of the largest are not followed further, after each round. The last one at
#: once: 7e-6 at 1 of 56 points, 5e-3 at some of 600 (tests/test_narrow_maxima.py); 0.9 throughout: no gain.
SHARES = 0.97, 0.995, 0.999
#: Rounds of the climbs at most. Half or twice: no change at 128 points.
LARGEST_ROUND_COUNT = 16
#: Local maxima times squared intervals of the cycle that one look takes at a time: its memory is bounded. A
#: hundred times: 28 MB more at 1,600 points, no faster.
PART_SIZE = 400_000
#: Least error that is claimed, as a share of the tolerance. Half: none of 128 points misses s_error.
LEAST_SHARE = 0.25
#: Rounding is looked for where this share of what it may be is more than the error. It leaves 1e-8 p, and is
#: looked for, too, where swt and 1/2 − ν are smaller. Half or twice: none of 128 points misses s_error.
LARGEST_SHOWN, FAINT, NO_SPREAD = 0.5, 1e-6, 0.01
#: What is looked at shows so much less than all of it. Half or twice: none of 128 points misses s_error.
SHOWN = 1.5
#: Numbers at and next to r, whose swt differs by rounding, and how often the extremes are looked at there:
#: closer looks show more of it. Four times as far, 2 or 10 looks: none of 128 points misses s_error.
NEIGHBOURS, ROUNDING_ZOOMS = np.array([-8, -5, -3, -2, -1, 0, 1, 2, 3, 5, 8]), 5


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

    @classmethod
    def unknown(cls, count: int, value: float) -> Maximum:
        """``count`` points that all have the same ``value`` everywhere."""
        return cls(*(np.full(count, value) for _ in range(4)))

    def take(self, index: NDArray[np.intp] | NDArray[np.bool_]) -> Maximum:
        """The points at ``index``."""
        return Maximum(*(values[index] for values in vars(self).values()))

    def put(self, index: NDArray[np.intp] | NDArray[np.bool_], other: Maximum) -> Maximum:
        """The same with other points at ``index``."""
        result = [values.copy() for values in vars(self).values()]
        for values, new in zip(result, vars(other).values(), strict=True):
            values[index] = new
        return Maximum(*result)


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene.

    Points that miss the tolerance are searched once more with twice the instants and more rounds.
    """
    found = _search(scene, accuracy)
    doubtful = np.flatnonzero(found.error > accuracy.tolerance * found.swt)
    if doubtful.size:
        again = _search(scene.take(doubtful), accuracy.finer())
        # What was found is there: the larger value stands, and the smaller error.
        better = (again.error < found.error[doubtful]) & (
            again.swt >= found.swt[doubtful] - found.error[doubtful]
        )
        found = found.put(doubtful[better], again.take(better))
    faint = (found.swt < FAINT) & (0.5 - scene.poisson_ratio < NO_SPREAD)
    rows = np.flatnonzero(
        (LARGEST_SHOWN * _rounding(scene, found) > found.error) | (faint & (found.swt > 0.0))
    )
    if rows.size:
        spread = SHOWN * _spread(scene.take(rows), found.take(rows), accuracy.check)
        found.error[rows] = np.maximum(found.error[rows], spread)
    return found


def _rounding(scene: Scene, found: Maximum) -> FloatArray:
    """How much of swt rounding may be, were it all at the scale of the smaller motion, shape (n,)."""
    load, r = scene.cycle.load, np.abs(found.position)[:, None]
    normal = 0.5 * (load.largest_normal - load.least_normal)
    tangential = load.motion - normal
    motion = np.where(tangential > 0.0, np.minimum(normal, tangential), normal)
    distance = arrival(load, scene.coordinate, r, scene.coordinate.of(r))[1][:, 0]
    # Where the normal load rests, what arrives at the edge is there.
    share = np.divide(distance, motion, out=np.zeros_like(motion), where=motion > distance)
    return np.asarray(np.sqrt(share) * found.swt)


def _spread(scene: Scene, found: Maximum, resolution: Resolution) -> FloatArray:
    """How much swt varies over the numbers at and next to the positions of the n maxima, shape (n,).

    A maximum may be at a cusp, with a steep flank on one side: the better half of the numbers counts.
    """
    r = np.abs(found.position)[:, None]
    split = replace(scene, cycle=split_at_breakpoints(scene.cycle)[0])
    near = np.maximum(r + NEIGHBOURS * np.spacing(r), scene.profile.flat_radius[:, None])
    angle = np.broadcast_to(found.double_angle[:, None], near.shape)
    closer = replace(resolution, zooms=max(resolution.zooms, ROUNDING_ZOOMS))
    value, _ = refine(split, near, np.sign(found.position), angle, closer)
    better = np.sort(value, axis=1)[:, NEIGHBOURS.size // 2 :]
    return np.asarray(np.abs(better - found.swt[:, None]).max(axis=1))


def _search(scene: Scene, accuracy: Accuracy) -> Maximum:
    """First look, local search and check."""
    finer, part_of = split_at_breakpoints(scene.cycle)
    split = replace(scene, cycle=finer)
    positions = positions_of_first_look(split.cycle, scene.coordinate, scene.bulk is not None)
    look = first_look(scene, positions.r, SCAN_RESOLUTION, SCAN_PLANES)
    climb = Climb.start(scene, split, part_of, look, positions, accuracy.search)
    largest_part = max(PART_SIZE // split.cycle.begin.shape[1] ** 2, 1)
    for turn in range(LARGEST_ROUND_COUNT):
        going = np.flatnonzero(~climb.settled)
        if not going.size:
            break
        parts = np.array_split(going, -(-going.size // largest_part))
        rounds = [climb_round(split, positions, climb.take(part), accuracy) for part in parts]
        moved = Climb.joined([climb.take(climb.settled), *(same for same, _ in rounds)])
        before = np.concatenate([climb.column[climb.settled], climb.column[going]])
        others = [other for _, other in rounds]
        climb = Climb.joined([moved.without_followers(moved.column != before), *others])
        climb = climb.leading(climb.top, SHARES[min(turn, len(SHARES) - 1)])
    # What is still on its way counts for what was seen of it.
    climb = climb.leading(np.where(climb.settled, climb.top, climb.seen), SHARES[-1])
    r = climb.brackets(positions).radius(climb.centre[:, None])
    value, angle = refine(
        split.select(climb.point, climb.hot), r, climb.side, climb.angle[:, None], accuracy.check
    )
    order = np.lexsort((-value[:, 0], climb.point))
    best = order[np.unique(climb.point[order], return_index=True)[1]]
    swt = value[best, 0]
    error = np.abs(swt - climb.top[best]) + climb.remaining[best]
    # Nothing finer than this was looked at.
    error = np.maximum(error, LEAST_SHARE * accuracy.tolerance * swt)
    return Maximum(swt, error, climb.side[best] * r[best, 0], angle[best, 0])
