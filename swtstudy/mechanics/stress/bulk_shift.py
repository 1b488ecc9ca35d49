"""The shift of the stick zone by the bulk strain, which the superposition of a bulk stress leaves out.

The strain of the body that carries an oscillating bulk stress drags its surface under the other body. For a
Hertz contact of similar materials a stick circle off centre makes a uniform strain, which cancels that of
the bulk stress along x if the shift is e = 2 B_A/(μ (1 + ν)(4 − 3ν)) in a_H, B in E* δ0/a_H. Of a loop B_A
is half the range of the bulk stress, as of an oscillation. For a cylinder, in plane strain, e = B_A/(2μ).
"""

from __future__ import annotations

import numpy as np

from swtstudy.families import PLAIN, PLAIN_STRIP
from swtstudy.mechanics.contact.stick_zone import stick_coordinate
from swtstudy.mechanics.control.diagram import diagram
from swtstudy.mechanics.load.of_points import alike, load_of
from swtstudy.mechanics.points import FloatArray, Points


def bulk_shift(points: Points) -> FloatArray:
    """e/a_H of n points, shape (n,).

    NaN for other profiles than the paraboloid and the cylinder, without friction or a permanent stick zone,
    and where e is larger than the width a − c of the ring between that and the largest contact radius.
    """
    if points.profile not in (PLAIN, PLAIN_STRIP):
        return np.full(len(points), np.nan)
    ν, μ, amplitude = points.poisson_ratio, points.friction, points.bulk_stress_amplitude
    if points.path is not None:
        course = points.path.bulk
        amplitude = amplitude * (0.0 if course is None else 0.5 * np.ptp(course.ends))
    with np.errstate(divide="ignore", invalid="ignore"):
        stiffness = 4.0 if points.profile == PLAIN_STRIP else (1.0 + ν) * (4.0 - 3.0 * ν)
        shift = 2.0 * amplitude / (μ * stiffness)
    width = np.full(len(points), np.nan)
    for index in alike(points):
        some = points.take(index)
        load, coordinate = diagram(some.control, some.profile, some.shape, load_of(some))
        stick = stick_coordinate(load)
        ends = np.maximum(np.stack([stick, load.largest_normal], axis=1), 0.0)
        stick_radius, largest = coordinate.radius(ends).T
        width[index] = np.where(stick >= 0.0, largest - stick_radius, np.nan)
    # Infinite without friction.
    return np.where(shift <= width, shift, np.nan)
