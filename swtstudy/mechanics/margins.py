"""Margins of points, as far as the load alone gives them: how far they are from where the model ends.

One of them is the shift of the stick zone by the bulk strain, which the superposition of a bulk stress
leaves out. The strain of the body that carries an oscillating bulk stress drags its surface under the other
body. For a Hertz contact of similar materials a stick circle off centre makes a uniform strain, which
cancels that of the bulk stress along x if the shift is e = 2 B_A/(μ (1 + ν)(4 − 3ν)) in a_H, B in E*
δ0/a_H. Of a loop B_A is half the range of the bulk stress, as of an oscillation. For a cylinder, in plane
strain, e = B_A/(2μ). Both are those of equal moduli; with others the shift goes with the strain of the body
that carries the bulk stress over the mean strain of both, under equal tractions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.kernel.batch import margins_batch
from swtstudy.mechanics.points import FloatArray, Points, Rows
from swtstudy.mechanics.solver import arguments_of
from swtstudy.vocabulary.choices import PLAIN, PLAIN_STRIP


@dataclass(frozen=True)
class Margins(Rows):
    """Margins of n points, each of shape (n,).

    Attributes
    ----------
    largest_radius
        Largest contact radius of the cycle in a_H, half the width in plane contacts.
    stick_radius
        Radius of the permanent stick zone in a_H; NaN where there is none.
    bulk_shift
        By how much the bulk strain would move the stick zone, in a_H, see `bulk_shift`; however large it is.
    force_ratio
        Largest |F_x|/(μ F_N) that is prescribed: there is no equilibrium where it is above 1; NaN where
        the tangential force is not prescribed.
    slide
        By how much the tangential displacement exceeds the limit of partial slip, in μ E* δ0/G*: u_A minus
        that limit if the depth is constant. 0 without gross slip; NaN where the bodies part or the
        tangential force is prescribed.
    """

    largest_radius: FloatArray
    stick_radius: FloatArray
    bulk_shift: FloatArray
    force_ratio: FloatArray
    slide: FloatArray

    @classmethod
    def of(cls, points: Points) -> Margins:
        """Margins of points of one profile family and control."""
        found = margins_batch(**arguments_of(points))
        radius, stick, ratio, slide = (
            found[name].copy() for name in ("contact_radius", "stick_radius", "force_ratio", "slide")
        )
        return cls(radius, stick, bulk_shift(points), ratio, slide)


def bulk_shift(points: Points) -> FloatArray:
    """e/a_H of n points, shape (n,), however large: about the width of the slip zone it is but an estimate.

    NaN without friction, and under a bulk stress that moves for other profiles than the paraboloid and the
    cylinder.
    """
    ν, μ, amplitude = points.poisson_ratio, points.friction, points.bulk_stress_amplitude
    if points.path is not None:
        course = points.path.bulk
        amplitude = amplitude * (0.0 if course is None else 0.5 * np.ptp(course.ends))
    if points.profile not in (PLAIN, PLAIN_STRIP):
        return np.where((amplitude == 0.0) & (μ > 0.0), 0.0, np.nan)
    stiffness = 4.0 if points.profile == PLAIN_STRIP else (1.0 + ν) * (4.0 - 3.0 * ν)
    shift = np.full(len(points), np.nan)
    return np.divide(2.0 * amplitude, μ * stiffness, out=shift, where=μ > 0.0)
