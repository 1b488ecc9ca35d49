"""swt at given positions of the surface line: the extremes over the cycle and over the planes.

First all event-aligned instants are looked at; then the stress is sampled anew around the three instants
that make swt (the largest σ_n, the largest and the smallest ε_n), ever closer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.line.look import (
    Look,
    Resolution,
    extreme_instants,
    extremes_and_rivals,
    lifted,
    reach,
)
from swtstudy.mechanics.line.samples import ANGLE_ROUNDS, Samples, of_extremes
from swtstudy.mechanics.numerics.arrays import pick
from swtstudy.mechanics.planes.criterion import curves, of_maxima
from swtstudy.mechanics.planes.through_y import PlaneHistory, climb_over_planes
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: swt may have two maxima over the planes not far apart: 2θ is started from here, rad from the first look.
#: The first start alone: 1e-3 at some of 600 points (tests/test_narrow_maxima.py); half or twice: no
#: change at 128.
STARTS = np.array([0.0, -0.25, 0.25])[:, None, None]
#: Planes nearer than this are one, 2θ in rad. Half or twice: no change at 128 points.
SAME_PLANE = 0.01
#: A plane whose swt, interpolated, is below this share of the best one's is no rival: 4e-4 of s was lost at a
#: point where the two were nearer (tests/test_narrow_maxima.py), and looking at all planes costs 2 %.
RIVAL_SHARE = 0.97


def refine(
    scene: Scene, position: FloatArray, side: FloatArray, double_angle: FloatArray, resolution: Resolution
) -> tuple[FloatArray, FloatArray]:
    """swt on one side of the contact, with the extremes found closely.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n, X): r = |x|.
    side
        Shape (n,): sign of x.
    double_angle
        Shape (n, X): 2θ to start from, rad.
    resolution
        How closely.

    Returns
    -------
    swt, double_angle
        Shape (n, X).
    """
    look = Look.at(scene, position, resolution.nodes, resolution.digits)
    planes = scene.planes(look.history, side[:, None, None])
    best, other = _best_planes(planes, look.inside, double_angle + STARTS)
    found, rival, falling = extremes_and_rivals(planes, best, look.inside)
    elsewhere, apart = found.copy(), np.nonzero(other != best)
    elsewhere[apart] = extreme_instants(planes.take(*apart), other[apart], look.inside[apart])
    zoom = _Zoom(scene, look, side, resolution)
    first = zoom.around(found, falling)
    swt, angle = zoom.to_maximum(first, best)
    # Two planes, or two instants, that the nodes cannot tell apart are both followed; neighbouring nodes have
    # the same bracket.
    others, rivals = (
        np.flatnonzero((np.abs(found - extremes) > 1).any(axis=(1, 2))) for extremes in (elsewhere, rival)
    )
    rows, is_rival = np.concatenate([others, rivals]), np.repeat([False, True], [others.size, rivals.size])
    if rows.size:
        plane = np.concatenate([other[others], best[rivals]])
        extremes = np.concatenate([elsewhere[others], rival[rivals]])
        again = _Zoom(scene.take(rows), look.take(rows), side[rows], resolution)
        second, first = again.around(extremes), first.take(rows)
        # Of two instants the one around which the plane is higher.
        here = (second.tops(plane) > first.tops(plane)) | ~is_rival[:, None, None]
        more, at = again.to_maximum(second.or_other(here, first), plane)
        for which in (~is_rival, is_rival):
            same, value, turned = rows[which], more[which], at[which]
            better = value > swt[same]
            swt[same] = np.where(better, value, swt[same])
            angle[same] = np.where(better, turned, angle[same])
    return swt, angle


@dataclass(frozen=True)
class _Zoom:
    """Ever closer samples.

    Attributes
    ----------
    scene, look, side
        n points, their look and the signs of x.
    resolution
        How closely.
    """

    scene: Scene
    look: Look
    side: FloatArray
    resolution: Resolution

    def around(self, extremes: NDArray[np.intp], falling: NDArray[np.bool_] | None = None) -> Samples:
        """Samples around instants of the look, shape (n, X, 3); for ``falling`` see `TimeBrackets.around`."""
        return self._within(self.look.brackets(extremes, falling))

    def _within(self, brackets: TimeBrackets) -> Samples:
        history = self.look.line.history(brackets.samples())
        near = of_extremes(self.scene.planes(history, self.side[:, None, None]))
        return Samples(brackets, near, self.scene.walker)

    def to_maximum(self, samples: Samples, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """swt and 2θ near a plane (n, X)."""
        gain = 10.0**-self.resolution.digits
        swt, angle = samples.best_plane(angle, gain)
        for _ in range(1, self.resolution.zooms):
            samples = self._within(samples.narrowed(angle))
            swt, angle = samples.best_plane(angle, gain)
        return swt, angle


def _best_planes(
    planes: PlaneHistory, inside: NDArray[np.bool_], angle: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The planes of largest swt, 2θ: by the values at the instants, and by interpolation between them.

    Parameters
    ----------
    planes
        At points (…) and T instants.
    inside
        Shape (…, T), see `Look.inside`.
    angle
        Shape (s, …): starts, rad.
    """
    angle = climb_over_planes(planes, angle, ANGLE_ROUNDS)
    of_swt = curves(*planes.on_plane(angle))
    found = []
    for top in (lambda curve: curve.max(axis=-1), lambda curve: lifted(curve, inside).max(axis=-1)):
        swt = of_maxima(*(top(curve) for curve in of_swt), walker=planes.walker)
        found.append(np.moveaxis(swt, 0, -1))
    angle = np.moveaxis(angle, 0, -1)
    best, other = (swt.argmax(axis=-1) for swt in found)
    # Between two instants a plane may reach higher than the parabolas say.
    apart = np.abs(angle - pick(angle, best)[..., None]) > SAME_PLANE
    apart &= found[1] >= RIVAL_SHARE * pick(found[1], best)[..., None]
    at = np.nonzero(apart.any(axis=-1) & (best == other))
    if at[0].size:
        reached = (reach(np.stack([start[at] for start in curve]), inside[at]) for curve in of_swt)
        high = of_maxima(*reached, walker=planes.walker and planes.walker.take(at[0], 0))
        high = np.where(apart[at], np.moveaxis(high, 0, -1), 0.0)
        rival = high.argmax(axis=-1)
        other[at] = np.where(pick(high, rival) > pick(found[1][at], best[at]), rival, best[at])
    return pick(angle, best), pick(angle, other)
