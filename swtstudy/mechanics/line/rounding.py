"""Errors of swt that no closer look shows: the rounding of what arrives at a place, and that of tables.

What arrives at a place is left within a few roundings of it, and the stress shows the root of that distance.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.line.look import Accuracy, Look, Resolution
from swtstudy.mechanics.planes.through_y import PlaneHistory
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.line import arrival
from swtstudy.mechanics.stress.scene import Scene

#: Distance from the singular edge of a flat face, over the face or the ring beside it, up to which its limit
#: has more digits than r. A hundredth and a hundred times: about 1e-7.
REACH = 1e-8
#: Rounding of a plane's normal stress, over the parts that it is the sum of.
PARTS = 4.0 * float(np.finfo(float).eps)
#: Step to the slope of a coordinate, over the distance from a face's edge or the centre, and in roundings.
SLOPE_STEP, LEAST_SLOPE_STEP = 1e-3, 4.0


def of_rounding(
    scene: Scene, swt: FloatArray, position: FloatArray, double_angle: FloatArray, accuracy: Accuracy
) -> FloatArray:
    """Error of swt > 0 by rounding and by tables.

    Parameters
    ----------
    scene
        n points.
    swt, position, double_angle
        Shape (n,): swt, signed x in a_H and 2θ in rad of the critical planes.
    accuracy
        To which swt was found.

    Returns
    -------
    Shape (n,), over E* δ0/R as swt.
    """
    r = np.abs(position)[:, None]
    # What swt is made of is as large as its root; it is a stress times a strain.
    is_product = scene.criterion.degree == 2
    size = np.sqrt(swt) if is_product else swt
    # Two bounds of one thing.
    rounding = np.minimum(_rounding(scene, r), _share_within_rounding(scene, r) * size)
    of_stress = rounding + _of_tables(scene, accuracy.check)
    # Both factors of a product are rounded.
    of_both = np.asarray((of_stress + rounding) * size if is_product else of_stress)
    if scene.profile.has_singular_edge:
        # Nearer, the limit counts.
        flat = scene.profile.flat_radius
        beyond = r[:, 0] - flat >= flat * reach_of_edge(scene.profile)
        of_both, of_stress = of_both * beyond, of_stress * beyond
    if scene.bulk is None:
        return of_both
    look = Look.at(scene, r, accuracy.search.nodes, accuracy.search.digits)
    planes = scene.planes(look.history, np.sign(position)[:, None, None])
    return np.maximum(of_both, _of_tension(planes, double_angle, of_stress))


def _of_tension(planes: PlaneHistory, double_angle: FloatArray, rounding: FloatArray) -> FloatArray:
    """Part of swt that a tension within rounding makes, shape (n,): all, where the bulk stress presses."""
    curves = planes.criterion.curves(*planes.on_plane(double_angle[:, None]))
    tension, up, down = (curve.max(axis=-1)[:, 0] for curve in curves)
    # On a plane the parts of a pressure cancel.
    rounding = rounding + PARTS * np.abs(planes.stress).sum(axis=0).max(axis=-1)[:, 0]
    low = np.maximum(tension, 0.0)
    criterion = planes.criterion.take((slice(None), 0))
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


def _share_within_rounding(scene: Scene, r: FloatArray) -> FloatArray:
    """Relative change of swt, were all of it made by the smaller motion and this rounded, shape (n,)."""
    load, normal = scene.cycle.load, scene.cycle.load.normal_motion
    distance = arrival(load, scene.coordinate, r, scene.coordinate.of(r))[1][:, 0]
    # A motion within rounding is none.
    shares = [
        np.divide(distance, motion, out=np.zeros_like(motion), where=motion > distance)
        for motion in (normal, load.motion - normal)
    ]
    return np.asarray(np.sqrt(np.maximum(*shares)))
