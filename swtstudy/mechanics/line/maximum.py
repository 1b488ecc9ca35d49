"""The maximum of swt over the surface line (eq. 10): global first, then local."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.line.accuracy import Accuracy
from swtstudy.mechanics.line.climb import Climb
from swtstudy.mechanics.line.first_look import resolved
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.line.positions import Pieces, Positions, cusps
from swtstudy.mechanics.line.round import climb_round
from swtstudy.mechanics.line.value import refine
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.passing import arrival
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.mechanics.stress.tip import told_by_fronts

#: Local maxima below these shares of the largest are not followed further, after each round. The last one at
#: once: 7e-6 at 1 of 56 points, 5e-3 at some of 600 (tests/test_narrow_maxima.py); 0.9 throughout: no gain.
SHARES = 0.97, 0.995, 0.999
#: Rounds of the climbs at most. Half or twice: no change at 128 points.
LARGEST_ROUND_COUNT = 16
#: Local maxima times squared intervals of the cycle that a round does at a time: memory is bounded.
PART_SIZE = 100_000
#: Least error that is claimed, as a share of the tolerance. Half: none of 128 points misses s_error.
LEAST_SHARE = 0.25
#: What a finer search that misses the tolerance leaves, in what it gained. 1: a third of 50 points with a
#: sharp tip, lost contact and large friction miss s_error.
SLOWNESS = 3.0
#: Nearer to the centre than this, in the largest radius, there is a tip, where extremes may be next to events
#: at all scales of time: they are looked at with so many times the instants, too.
TIP, TIMES_AT_TIP = 1e-6, 8
#: Distance from the singular edge of a flat face, over the face or the ring beside it, up to which its limit
#: has more digits than r. A hundredth and a hundred times: about 1e-7.
REACH = 1e-8
#: Rounding is looked for where this share of what it may be is more than the error. Half or twice: none of
#: 128 points misses s_error.
LARGEST_SHOWN = 0.5
#: Step to the slope of a coordinate, over the distance from a face's edge or the centre, and in roundings.
SLOPE_STEP, LEAST_SLOPE_STEP = 1e-3, 4.0
#: What is looked at shows so much less than all of it. Half or twice: none of 128 points misses s_error.
SHOWN = 1.5
#: Numbers at and next to r, whose swt differs by rounding; those farther off, of which only higher ones tell.
NEIGHBOURS = np.array([-8, -5, -3, -2, -1, 0, 1, 2, 3, 5, 8])
FARTHER = np.outer([-1, 1], 8 ** np.arange(2, 7)).ravel()
#: Zooms and digits more with which they are looked at: other instants, and tables, show other rounding.
LOOKS = ((0, 0.0), (1, 0.0), (2, 2.0), (3, 2.0), (4, 0.0))


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

    Points that miss the tolerance are climbed to once more with twice the instants and more rounds.
    """
    split = scene.split_at_breakpoints()
    ends = cusps(split.cycle, scene.coordinate, scene.bulk is not None)
    positions, seen = resolved(scene, Pieces.between(ends, scene.profile.feature_length))
    start = Climb.start(split, positions, seen, accuracy.search)
    found = _climbed(split, positions, start, accuracy)
    doubtful = np.flatnonzero(found.error > accuracy.tolerance * found.swt)
    if doubtful.size:
        some = start.take(np.isin(start.point, doubtful))
        again = _climbed(split, positions, some, accuracy.finer())
        # What was found is there: the larger value stands, and the smaller error.
        better = (again.error < found.error[doubtful]) & (
            again.swt >= found.swt[doubtful] - found.error[doubtful]
        )
        gain = np.abs(again.swt - found.swt[doubtful])
        found = found.put(doubtful[better], again.take(better))
        # What converges slowly, as next to a sharp tip, has left more than it has gained.
        error = found.error[doubtful]
        slow = error > accuracy.tolerance * found.swt[doubtful]
        found.error[doubtful] = np.where(slow, np.maximum(error, SLOWNESS * gain), error)
    tip = np.flatnonzero(np.abs(found.position) < TIP * scene.profile.radius(scene.profile.largest_depth))
    if tip.size:
        left = SLOWNESS * _left_at_tip(scene.take(tip), found.take(tip), accuracy.check)
        found.error[tip] = np.maximum(found.error[tip], left)
    noise = _noise(scene, np.abs(found.position)[:, None])
    of_stress = (noise + _of_tables(scene, accuracy.check)) * np.sqrt(found.swt)
    may_be = np.maximum(_share_within_rounding(scene, found) * found.swt, of_stress)
    shows = (found.swt > 0.0) & (LARGEST_SHOWN * may_be > found.error)
    if scene.profile.has_singular_edge:
        # Nearer, the limit counts.
        flat = scene.profile.flat_radius
        shows &= np.abs(found.position) - flat >= flat * reach_of_edge(scene.profile)
    rows = np.flatnonzero(shows)
    if rows.size:
        spread = np.maximum(_spread(scene.take(rows), found.take(rows), accuracy.check), noise[rows] ** 2)
        found.error[rows] = np.maximum(found.error[rows], SHOWN * spread)
    return found


def reach_of_edge(profile: Profile) -> FloatArray:
    """How near to a singular edge, over its radius, swt is taken from the limit, shape (n,)."""
    radius, flat = profile.radius(profile.largest_depth), profile.flat_radius
    reach = REACH * np.minimum(radius - flat, flat)
    return np.divide(reach, flat, out=np.zeros_like(flat), where=flat > 0.0)


def _left_at_tip(scene: Scene, found: Maximum, resolution: Resolution) -> FloatArray:
    """How much many more instants change swt at the n positions of the maxima, shape (n,)."""
    split = scene.split_at_breakpoints()
    more = replace(resolution, nodes=TIMES_AT_TIP * resolution.nodes)
    place = np.abs(found.position)[:, None], np.sign(found.position), found.double_angle[:, None]
    value, _ = refine(split, *place, more)
    return np.abs(value[:, 0] - found.swt)


def _noise(scene: Scene, r: FloatArray) -> FloatArray:
    """How far off a stress at r, shape (n, 1), may be by the rounding of what arrives there, shape (n,)."""
    profile, coordinate = scene.profile, scene.coordinate
    r, b = np.minimum(r, profile.radius(profile.largest_depth)[:, None]), profile.flat_radius[:, None]
    r = told_by_fronts(scene.cycle, coordinate, r)
    at, step = coordinate.of(r), np.maximum(SLOPE_STEP * (r - b), LEAST_SLOPE_STEP * np.spacing(r))
    # How far from r an edge is left, in radius: what it leaves is the pressure by that ring.
    width = arrival(scene.cycle.load, coordinate, r, at)[1] * step / (coordinate.of(r + step) - at)
    slope = profile.weighted_slope(r) / np.sqrt(np.maximum((r - b) * (r + b), r * step))
    return np.asarray(slope * np.sqrt(2.0 * np.minimum(width / r, 1.0)) / np.pi)[:, 0]


def _of_tables(scene: Scene, resolution: Resolution) -> FloatArray:
    """How far off tables leave a stress, by the mean slope of the profile, shape (n,)."""
    deepest = scene.profile.largest_depth
    return np.asarray(10.0**-resolution.digits * deepest / scene.profile.radius(deepest))


def _share_within_rounding(scene: Scene, found: Maximum) -> FloatArray:
    """Relative change of swt, were all of it made by the smaller motion and this rounded, shape (n,)."""
    load, r = scene.cycle.load, np.abs(found.position)[:, None]
    r = told_by_fronts(scene.cycle, scene.coordinate, r)
    normal = load.normal_motion
    distance = arrival(load, scene.coordinate, r, scene.coordinate.of(r))[1][:, 0]
    # A motion within rounding is none.
    shares = [
        np.divide(distance, motion, out=np.zeros_like(motion), where=motion > distance)
        for motion in (normal, load.motion - normal)
    ]
    return np.asarray(np.sqrt(np.maximum(*shares)))


def _spread(scene: Scene, found: Maximum, resolution: Resolution) -> FloatArray:
    """How much swt varies over the numbers at and next to the positions of the n maxima, shape (n,).

    A maximum may be at a cusp, with a steep flank on one side: the better half of the numbers counts.
    """
    r = np.abs(found.position)[:, None]
    split = scene.split_at_breakpoints()
    steps = np.concatenate([NEIGHBOURS, FARTHER])
    near = np.maximum(r + steps * np.spacing(r), scene.profile.flat_radius[:, None])
    angle = np.broadcast_to(found.double_angle[:, None], near.shape)
    spread = np.zeros(len(r))
    for zooms, digits in LOOKS:
        closer = replace(resolution, zooms=resolution.zooms + zooms, digits=resolution.digits + digits)
        value, _ = refine(split, near, np.sign(found.position), angle, closer)
        change = value - found.swt[:, None]
        better = np.sort(change[:, : NEIGHBOURS.size], axis=1)[:, NEIGHBOURS.size // 2 :]
        spread = np.maximum(spread, np.maximum(np.abs(better).max(axis=1), change.max(axis=1)))
    return spread


def _climbed(split: Scene, positions: Positions, climb: Climb, accuracy: Accuracy) -> Maximum:
    """The maxima of the points to which climbs belong, in their order, looked at once more at the top."""
    largest_part = max(PART_SIZE // split.cycle.begin.shape[1] ** 2, 1)
    for turn in range(LARGEST_ROUND_COUNT):
        going = np.flatnonzero(~climb.settled)
        if not going.size:
            break
        parts = np.array_split(going, -(-going.size // largest_part))
        rounds = [climb_round(split, positions, climb.take(part), accuracy) for part in parts]
        moved = Climb.joined([climb.take(climb.settled), *(same for same, _ in rounds)])
        before = np.concatenate([climb.place[climb.settled], climb.place[going]])
        others = [other for _, other in rounds]
        climb = Climb.joined([moved.without_followers(moved.place != before), *others])
        climb = climb.leading(climb.top, SHARES[min(turn, len(SHARES) - 1)])
    # What is still on its way counts for what was seen of it.
    climb = climb.leading(np.where(climb.settled, climb.top, climb.seen), SHARES[-1])
    r = positions.take(climb.place).around(climb.centre[:, None])
    value, angle = refine(split.take(climb.point), r, climb.side, climb.angle[:, None], accuracy.check)
    order = np.lexsort((-value[:, 0], climb.point))
    best = order[np.unique(climb.point[order], return_index=True)[1]]
    swt = value[best, 0]
    error = np.abs(swt - climb.top[best]) + climb.remaining[best]
    # Nothing finer than this was looked at.
    error = np.maximum(error, LEAST_SHARE * accuracy.tolerance * swt)
    return Maximum(swt, error, climb.side[best] * r[best, 0], angle[best, 0])
