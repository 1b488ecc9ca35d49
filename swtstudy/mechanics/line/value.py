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
    extremes_and_rivals,
)
from swtstudy.mechanics.line.samples import ANGLE_ROUNDS, Samples, of_extremes
from swtstudy.mechanics.planes.through_y import climb_over_planes
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene


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
    best = climb_over_planes(planes, double_angle, ANGLE_ROUNDS)
    found, rival, falling = extremes_and_rivals(planes, best, look.inside)
    zoom = _Zoom(scene, look, side, resolution)
    first = zoom.around(found, falling)
    swt, angle = zoom.to_maximum(first, best)
    # Two instants that the nodes cannot tell apart are both followed; neighbours have the same bracket.
    rows = np.flatnonzero((np.abs(found - rival) > 1).any(axis=(1, 2)))
    if rows.size:
        again = _Zoom(scene.take(rows), look.take(rows), side[rows], resolution)
        second, first, plane = again.around(rival[rows]), first.take(rows), best[rows]
        # Of two instants the one around which the plane is higher.
        here = second.tops(plane) > first.tops(plane)
        more, at = again.to_maximum(second.or_other(here, first), plane)
        better = more > swt[rows]
        swt[rows] = np.where(better, more, swt[rows])
        angle[rows] = np.where(better, at, angle[rows])
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
        return Samples(brackets, near, self.scene.criterion_along)

    def to_maximum(self, samples: Samples, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """swt and 2θ near a plane (n, X)."""
        gain = 10.0**-self.resolution.digits
        swt, angle = samples.best_plane(angle, gain)
        for _ in range(1, self.resolution.zooms):
            samples = self._within(samples.narrowed(angle))
            swt, angle = samples.best_plane(angle, gain)
        return swt, angle
