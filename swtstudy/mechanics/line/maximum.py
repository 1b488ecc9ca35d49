"""The maximum of swt over the surface line (eq. 10): global first, then local.

Local maxima far below the largest one are found as well: a mean over a critical distance may be largest about
one of these.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.line.climb import Climb
from swtstudy.mechanics.line.first_look import joined_pieces, resolved
from swtstudy.mechanics.line.look import Accuracy, Look, Resolution
from swtstudy.mechanics.line.positions import Pieces, Positions
from swtstudy.mechanics.line.rounds import CHANGE_SHARE, climb_to_tops, looked_at_once_more
from swtstudy.mechanics.points import FloatArray, Rows
from swtstudy.mechanics.stress.line import arrival
from swtstudy.mechanics.stress.scene import Scene

#: Local maxima below these shares of the largest are not followed further, after each round. The last one at
#: once: 7e-6 at 1 of 56 points, 5e-3 at some of 600 (tests/mechanics/test_narrow_maxima.py); 0.9 throughout:
#: no gain.
SHARES = 0.97, 0.995, 0.999
#: Distance from the singular edge of a flat face, over the face or the ring beside it, up to which its limit
#: has more digits than r. A hundredth and a hundred times: about 1e-7.
REACH = 1e-8
#: Rounding of a plane's normal stress, over the parts that it is the sum of.
PARTS = 4.0 * float(np.finfo(float).eps)
#: Step to the slope of a coordinate, over the distance from a face's edge or the centre, and in roundings.
SLOPE_STEP, LEAST_SLOPE_STEP = 1e-3, 4.0


@dataclass(frozen=True)
class Maximum(Rows):
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

    def put(self, index: NDArray[np.intp] | NDArray[np.bool_], other: Maximum) -> Maximum:
        """The same with other points at ``index``."""
        result = Maximum(*(values.copy() for values in vars(self).values()))
        result.write(index, other)
        return result


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene.

    Points that miss the tolerance are climbed to once more with twice the instants and more rounds.
    """
    split = scene.split_at_breakpoints()
    positions, seen = resolved(scene, joined_pieces(scene, Pieces.of(split)))
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
        found = found.put(doubtful[better], again.take(better))
    rows = np.flatnonzero(found.swt > 0.0)
    if rows.size:
        of_rounding = _of_rounding(scene.take(rows), found.take(rows), accuracy)
        found.error[rows] = np.maximum(found.error[rows], of_rounding)
    return found


def _of_rounding(scene: Scene, found: Maximum, accuracy: Accuracy) -> FloatArray:
    """Share by which rounding and tables may put swt > 0 off, shape (n,)."""
    # What swt is made of is as large as its root; it is a stress times a strain.
    is_product = scene.criterion.degree == 2
    size = np.sqrt(found.swt) if is_product else found.swt
    # Two bounds of one thing.
    rounding = np.minimum(
        _rounding(scene, np.abs(found.position)[:, None]), _share_within_rounding(scene, found) * size
    )
    rounding = rounding + _of_tables(scene, accuracy.check)
    if scene.profile.has_singular_edge:
        # Nearer, the limit counts.
        flat = scene.profile.flat_radius
        rounding *= np.abs(found.position) - flat >= flat * reach_of_edge(scene.profile)
    of_both = np.asarray(rounding * size if is_product else rounding)
    if scene.bulk is None:
        return of_both
    return np.maximum(of_both, _of_tension(scene, found, rounding, accuracy.search))


def _of_tension(scene: Scene, found: Maximum, rounding: FloatArray, resolution: Resolution) -> FloatArray:
    """Part of swt that a tension within rounding makes, shape (n,): all, where the bulk stress presses."""
    look = Look.at(scene, np.abs(found.position)[:, None], resolution.nodes, resolution.digits)
    planes = scene.planes(look.history, np.sign(found.position)[:, None, None])
    curves = planes.criterion.curves(*planes.on_plane(found.double_angle[:, None]))
    tension, up, down = (curve.max(axis=-1)[:, 0] for curve in curves)
    # On a plane the parts of a pressure cancel.
    rounding = rounding + PARTS * np.abs(planes.stress).sum(axis=0).max(axis=-1)[:, 0]
    low = np.maximum(tension, 0.0)
    criterion = scene.criterion
    return np.asarray(criterion.of_maxima(low + rounding, up, down) - criterion.of_maxima(low, up, down))


def reach_of_edge(profile: Profile) -> FloatArray:
    """Distance from a singular edge, over its radius, below which swt is taken from the limit, shape (n,)."""
    radius, flat = profile.radius(profile.largest_depth), profile.flat_radius
    reach = REACH * np.minimum(radius - flat, flat)
    return np.divide(reach, flat, out=np.zeros_like(flat), where=flat > 0.0)


def _rounding(scene: Scene, r: FloatArray) -> FloatArray:
    """Error of a stress at r, shape (n, 1), by the rounding of what arrives there, shape (n,)."""
    profile, coordinate = scene.profile, scene.coordinate
    r, b = np.minimum(r, profile.radius(profile.largest_depth)[:, None]), profile.flat_radius[:, None]
    at, step = coordinate.of(r), np.maximum(SLOPE_STEP * (r - b), LEAST_SLOPE_STEP * np.spacing(r))
    # How far from r an edge is left, in radius: what it leaves is the pressure by that ring.
    rise = coordinate.of(r + step) - at
    width = arrival(scene.cycle.load, coordinate, r, at)[1] * step
    # Under a flat face nothing arrives.
    width = np.divide(width, rise, out=np.zeros_like(rise), where=rise > 0.0)
    slope = profile.weighted_slope(r) / np.sqrt(np.maximum((r - b) * (r + b), r * step))
    return np.asarray(slope * np.sqrt(2.0 * np.minimum(width / r, 1.0)) / np.pi)[:, 0]


def _of_tables(scene: Scene, resolution: Resolution) -> FloatArray:
    """Error of a stress by tables, from the mean slope of the profile, shape (n,)."""
    deepest = scene.profile.largest_depth
    return np.asarray(10.0**-resolution.digits * deepest / scene.profile.radius(deepest))


def _share_within_rounding(scene: Scene, found: Maximum) -> FloatArray:
    """Relative change of swt, were all of it made by the smaller motion and this rounded, shape (n,)."""
    load, r = scene.cycle.load, np.abs(found.position)[:, None]
    normal = load.normal_motion
    distance = arrival(load, scene.coordinate, r, scene.coordinate.of(r))[1][:, 0]
    # A motion within rounding is none.
    shares = [
        np.divide(distance, motion, out=np.zeros_like(motion), where=motion > distance)
        for motion in (normal, load.motion - normal)
    ]
    return np.asarray(np.sqrt(np.maximum(*shares)))


def _climbed(split: Scene, positions: Positions, climb: Climb, accuracy: Accuracy) -> Maximum:
    """The maxima of the points to which climbs belong, in their order."""
    climb = climb_to_tops(split, positions, climb, accuracy, SHARES)
    # What is still on its way counts for what was seen of it.
    climb = climb.leading(np.where(climb.settled, climb.top, climb.seen), SHARES[-1])
    position, value, angle = looked_at_once_more(split, positions, climb, accuracy)
    order = np.lexsort((-value, climb.point))
    best = order[np.unique(climb.point[order], return_index=True)[1]]
    # A climb that is not over may change by all that its last round has changed, once more.
    remaining = np.where(
        climb.settled, climb.remaining, np.minimum(climb.remaining / CHANGE_SHARE, climb.top)
    )
    error = np.abs(value[best] - climb.top[best]) + remaining[best]
    # Nothing finer than this was looked at.
    error = np.maximum(error, accuracy.tolerance * value[best])
    return Maximum(value[best], error, position[best], angle[best])


#: Relative accuracy of swt there.
CANDIDATE_TOLERANCE = 1e-4
#: Maxima of a point nearer to one another than this share of the contact radius are one.
SAME_MAXIMUM = 1e-5


class Candidates(NamedTuple):
    """m local maxima, arrays of shape (m,).

    Attributes
    ----------
    rows
        Number of the point.
    position, double_angle, swt
        Signed x in a_H, 2θ of the best plane there, rad, and swt; descending in swt for each point.
    """

    rows: NDArray[np.intp]
    position: FloatArray
    double_angle: FloatArray
    swt: FloatArray


def candidates(scene: Scene, least: FloatArray) -> Candidates:
    """Local maxima of swt on the surface line of n points that are above the ``least``, shape (n,).

    Of a load whose second half mirrors the first, those at x ≥ 0 alone.
    """
    split, accuracy = scene.split_at_breakpoints(), Accuracy.for_tolerance(CANDIDATE_TOLERANCE)
    positions, seen = resolved(scene, Pieces.of(split), least)
    climb = Climb.start(split, positions, seen, accuracy.search, least)
    climb = climb_to_tops(split, positions, climb, accuracy)
    position, swt, angle = looked_at_once_more(split, positions, climb, accuracy)
    found = Candidates(climb.point, position, angle, swt)
    return _apart(found, SAME_MAXIMUM * scene.largest_radius)


def _apart(found: Candidates, distance: FloatArray) -> Candidates:
    """In descending order for each point, without those near to higher ones."""
    order = np.lexsort((-found.swt, found.rows))
    kept: list[int] = []
    for k in order:
        same = [j for j in kept if found.rows[j] == found.rows[k]]
        if all(abs(found.position[j] - found.position[k]) > distance[found.rows[k]] for j in same):
            kept.append(int(k))
    rows, position, double_angle, swt = found
    return Candidates(rows[kept], position[kept], double_angle[kept], swt[kept])
