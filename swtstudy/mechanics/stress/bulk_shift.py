"""The shift of the stick zone by the bulk strain, which the superposition of a bulk stress leaves out.

The strain of the body that carries an oscillating bulk stress drags its surface under the other body. For a
Hertz contact of similar materials a stick circle off centre makes a uniform strain, which cancels that of
the bulk stress along x if the shift is e = 2 B_A/(μ (1 + ν)(4 − 3ν)) in a_H, B in E* δ0/a_H. Of a loop B_A
is half the range of the bulk stress, as of an oscillation. For a cylinder, in plane strain, e = B_A/(2μ).
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray, Points
from swtstudy.vocabulary.families import PLAIN, PLAIN_STRIP


def bulk_shift(points: Points) -> FloatArray:
    """e/a_H of n points, shape (n,), however large: about the width of the slip zone it is but an estimate.

    NaN for other profiles than the paraboloid and the cylinder, and without friction.
    """
    if points.profile not in (PLAIN, PLAIN_STRIP):
        return np.full(len(points), np.nan)
    ν, μ, amplitude = points.poisson_ratio, points.friction, points.bulk_stress_amplitude
    if points.path is not None:
        course = points.path.bulk
        amplitude = amplitude * (0.0 if course is None else 0.5 * np.ptp(course.ends))
    stiffness = 4.0 if points.profile == PLAIN_STRIP else (1.0 + ν) * (4.0 - 3.0 * ν)
    shift = np.full(len(points), np.nan)
    return np.divide(2.0 * amplitude, μ * stiffness, out=shift, where=μ > 0.0)
