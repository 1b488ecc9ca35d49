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

from dataclasses import dataclass, fields

import numpy as np

from swtstudy.mechanics.contact.slip_front import stick_coordinate
from swtstudy.mechanics.control.diagram import diagram, largest_depth
from swtstudy.mechanics.indenter import roughness
from swtstudy.mechanics.load.bimodal import alike, load_of
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.roots import parabola
from swtstudy.mechanics.points import FloatArray, Points, Rows
from swtstudy.mechanics.stress.work import SAMPLES
from swtstudy.vocabulary.choices import PLAIN, PLAIN_STRIP


@dataclass(frozen=True)
class Margins(Rows):
    """Margins of n points, each of shape (n,).

    Attributes
    ----------
    largest_radius
        Largest contact radius of the cycle in a_H, half the width in plane contacts.
    slip_width
        Its distance from the permanent stick zone in a_H; NaN where there is none.
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
    slip_width: FloatArray
    bulk_shift: FloatArray
    force_ratio: FloatArray
    slide: FloatArray

    @classmethod
    def of(cls, points: Points) -> Margins:
        """Margins of points of one profile family and control."""
        found = cls(*np.full((len(fields(cls)), len(points)), np.nan))
        for index in alike(points):
            load = load_of(points.take(index))
            some = points.take(index)
            deepest = largest_depth(some.control, some.profile, some.shape, load.largest_normal)
            level = roughness(some.profile, some.shape, deepest)
            for each in np.unique(level):
                rows = np.flatnonzero(level == each)
                found.write(index[rows], _of_alike(points.take(index[rows]), load.take(rows)))
        return found


def _of_alike(points: Points, prescribed: Load) -> Margins:
    """Margins of points whose loads are alike, of profiles of one roughness."""
    load, coordinate = diagram(points.control, points.profile, points.shape, prescribed)
    stick = stick_coordinate(load)
    ends = np.maximum(np.stack([stick, load.largest_normal], axis=1), 0.0)
    stick_radius, largest = coordinate.radius(ends).T
    width = np.where(stick >= 0.0, largest - stick_radius, np.nan)
    unknown = np.full(len(points), np.nan)
    if points.control.tangential_force:
        return Margins(largest, width, bulk_shift(points), _force_ratio(load), unknown)
    touches = load.normal(load.turning_instants()).min(axis=1) > 0.0
    slide = np.where(touches, np.maximum(-stick, 0.0), np.nan)
    return Margins(largest, width, bulk_shift(points), unknown, slide)


def _force_ratio(load: Load) -> FloatArray:
    """Largest |T|/N over the cycle, inf where T is not 0 without N, shape (n,)."""
    turns = load.turning_instants()
    ends = np.concatenate([turns[:, -1:] - 2.0 * np.pi, turns], axis=1)
    steps = 1 if load.grows_in_lines else SAMPLES
    share = np.arange(steps) / steps
    instants = (ends[:, :-1, None] + np.diff(ends, axis=1)[:, :, None] * share).reshape(len(load), -1)
    instants = np.mod(instants, 2.0 * np.pi)
    normal, tangential = np.maximum(load.normal(instants), 0.0), np.abs(load.tangential(instants))
    with np.errstate(divide="ignore"):
        ratio = np.divide(tangential, normal, out=np.zeros_like(normal), where=tangential > 0.0)
    best = ratio.argmax(axis=1)
    rows = np.arange(len(load))
    around = [ratio[rows, (best + step) % ratio.shape[1]] for step in (-1, 0, 1)]
    top = ratio[rows, best]
    # Even steps lie between turning instants; at one the load turns, and is known.
    smooth = (best % steps > 0) & np.isfinite(around).all(axis=0)
    rise = parabola(*(np.where(smooth, each, 0.0) for each in around))[1]
    return np.asarray(top + np.where(smooth, rise, 0.0))


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
