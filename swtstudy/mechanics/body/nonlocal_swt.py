"""swt not at a point but over a critical distance ℓ: volume average and the theory of critical distances.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, or taken at the depth ℓ/2 (point method) or as the mean over the depths 0 … 2ℓ (line
method), straight down or along the critical plane.

With ℓ → 0 all three tend to the largest swt over all planes at the critical point. That is s, unless a plane
that does not hold the y axis is higher there, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.half_sphere import HalfSpheres, gauss, interpolation
from swtstudy.mechanics.body.local_swt import Fineness, LocalSwt, Places
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.parameters import DIRECTIONS

#: Distances from the circle, and inclinations, of the places in the half spheres, and places on a line: more
#: while a mean is not as accurate as asked for.
COUNTS, LINE_COUNTS = (9, 13, 19, 27), (11, 17, 25, 37)
#: The distance from the critical point is this power of the abscissa of a line.
LINE_POWER = 4
#: The error claimed, over the changes of a mean without every other place, and over the value itself (planes,
#: cells). Of 144 means of random scenes the places made an error of more than that in three.
OF_CHANGE, OF_VALUE = 0.3, 3e-4
#: The changes fall at least like this power of the counts.
ORDER = 2.5
#: A value below this is none.
TINY = 1e-300
#: Largest over smallest distance that share their places.
SPAN = 40.0
#: Places that show which part of the cycle matters.
SHOWN = 12
#: Instants and cells, finer while a mean is not as accurate as asked for.
FINENESS = (Fineness(3, 16), Fineness(6, 32))
#: Abscissae of the integrals of the interpolation along a line.
ABSCISSAE = 32


@dataclass(frozen=True)
class NonlocalSwt:
    """swt over k critical distances at n points, over E* δ0/R as s, with absolute errors; NaN without s.

    Attributes
    ----------
    volume, volume_error
        Shape (n, k): means over half spheres.
    point, point_error, line, line_error
        Shape (n, k, 2): values at ℓ/2 and means over 0 … 2ℓ in both `DIRECTIONS`.
    """

    volume: FloatArray
    volume_error: FloatArray
    point: FloatArray
    point_error: FloatArray
    line: FloatArray
    line_error: FloatArray


def nonlocal_swt(
    scene: Scene, position: FloatArray, angle: FloatArray, distance: FloatArray, rtol: float = 1e-3
) -> NonlocalSwt:
    """swt over critical distances about the critical points of n scenes.

    Parameters
    ----------
    scene
        n points.
    position, angle
        Shape (n,): signed x of the critical points on the surface line, in a_H, and the angle between the
        normal of the critical plane and the x axis, degrees; NaN where there is none.
    distance
        Shape (k,): ℓ > 0 in a_H.
    rtol
        Relative accuracy asked for.
    """
    n, k = len(position), len(distance)
    volume, volume_error = np.full((2, n, k), np.nan)
    point, point_error, line, line_error = np.full((4, n, k, len(DIRECTIONS)), np.nan)
    groups = _groups(distance)
    for row in np.flatnonzero(np.isfinite(position)):
        into = _directions(float(angle[row]))
        for group in groups:
            around = _Around(scene.take(np.array([row])), float(position[row]), into, distance[group])
            volume[row, group], volume_error[row, group] = _refined(around.in_spheres, rtol)
            lines, error = _refined(around.on_lines, rtol)
            point[row, group], line[row, group] = lines
            point_error[row, group], line_error[row, group] = error
    return NonlocalSwt(volume, volume_error, point, point_error, line, line_error)


def _groups(distance: FloatArray) -> list[NDArray[np.intp]]:
    """Indices of the distances that share their places."""
    order = np.argsort(distance)
    ratio = distance[order] / distance[order[0]]
    return [order[part] for part in np.split(np.arange(order.size), _cuts(ratio))]


def _cuts(ascending: FloatArray) -> list[int]:
    """Where a new group begins."""
    cuts, first = [], 0
    for number, value in enumerate(ascending):
        if value > SPAN * ascending[first]:
            cuts.append(number)
            first = number
    return cuts


def _directions(degrees: float) -> FloatArray:
    """Unit vectors into the body (right, down) of `DIRECTIONS`, shape (2, 2)."""
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    along_plane = np.array([-sine, cosine]) * np.copysign(1.0, cosine)
    return np.array([[0.0, 1.0], along_plane])


#: A value, its changes without every other place, and what instants may be missing in it, of one shape.
Found = tuple[FloatArray, FloatArray, FloatArray]


class _Around:
    """swt around one critical point.

    Parameters
    ----------
    scene
        A batch of one point.
    x
        Signed position of the critical point.
    into
        Shape (d, 2): unit vectors into the body (right, down).
    distance
        Shape (k,).
    """

    def __init__(self, scene: Scene, x: float, into: FloatArray, distance: FloatArray) -> None:
        self.scene, self.x, self.into, self.distance = scene, x, into, distance
        self.largest = float(distance.max())
        self.local: dict[Fineness, LocalSwt] = {}

    def in_spheres(self, level: int, fineness: Fineness) -> Found:
        """Means over half spheres, shape (k,)."""
        spheres = HalfSpheres(abs(self.x), self.largest, COUNTS[level])
        swt, missing = self._local(fineness).swt(self._of_spheres(spheres))
        weights = spheres.weights(self.distance)
        mean, *change = weights @ swt
        return mean, np.abs(change).sum(axis=0), weights[0] @ missing

    def on_lines(self, level: int, fineness: Fineness) -> Found:
        """Values at ℓ/2, and means over 0 … 2ℓ, along the vectors, shape (2, k, d)."""
        abscissa = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, LINE_COUNTS[level] + 1) / (LINE_COUNTS[level] + 1))
        away = np.concatenate([0.5 * self.distance, 2.0 * self.largest * abscissa**LINE_POWER])
        found = np.stack(self._local(fineness).swt(self._of_lines(away))).reshape(2, away.size, -1)
        (point, line), (no_point, no_line) = (np.split(v, [self.distance.size]) for v in found)
        mean, missing = (self._line_means(abscissa, values) for values in (line, no_line))
        change = np.abs(self._line_means(abscissa[::2], line[::2]) - mean)
        changes = np.stack([np.zeros_like(point), change])
        return np.stack([point, mean]), changes, np.stack([no_point, missing])

    def _local(self, fineness: Fineness) -> LocalSwt:
        """swt at the instants that matter at some of the places."""
        if fineness not in self.local:
            spheres = self._of_spheres(HalfSpheres(abs(self.x), self.largest, COUNTS[0]))
            lines = self._of_lines(self.largest * np.array([0.1, 0.6, 2.0]))
            shown = np.linspace(0, spheres.radius.size - 1, SHOWN).astype(int)
            some = (np.concatenate(parts) for parts in zip(spheres.at(shown), lines, strict=True))
            self.local[fineness] = LocalSwt(self.scene, abs(self.x), Places(*some), fineness)
        return self.local[fineness]

    def _of_spheres(self, spheres: HalfSpheres) -> Places:
        radius, depth, angle = spheres.places()
        return Places(radius, depth, angle if self.x >= 0.0 else np.pi - angle)

    def _of_lines(self, away: FloatArray) -> Places:
        """Places at distances from the critical point, along one vector after the other at each."""
        right = (self.x + away[:, None] * self.into[:, 0]).ravel()
        depth = (away[:, None] * self.into[:, 1]).ravel()
        return Places(np.abs(right), depth, np.where(right < 0.0, np.pi, 0.0))

    def _line_means(self, abscissa: FloatArray, swt: FloatArray) -> FloatArray:
        """Means over 0 … 2ℓ, shape (k, d), from values at abscissae."""
        node, weight = gauss(ABSCISSAE)
        weight = LINE_POWER * node ** (LINE_POWER - 1) * weight
        scaled = (self.distance[:, None] / self.largest) ** (1.0 / LINE_POWER) * node
        return np.asarray((weight @ interpolation(abscissa, scaled)) @ swt)


def _refined(at: Callable[[int, Fineness], Found], rtol: float) -> tuple[FloatArray, FloatArray]:
    """A value and its error, with more places and instants as far as they are needed."""
    level, fineness = 0, 0
    while True:
        value, change, missing = at(level, FINENESS[fineness])
        size = np.abs(value)
        of_places, of_instants = OF_CHANGE * change, np.abs(missing)
        error = of_places + of_instants + OF_VALUE * size
        # Half of the error may come from either.
        allowed = np.maximum(0.5 * (rtol - OF_VALUE) * size, TINY)
        finer = fineness + 1 < len(FINENESS) and bool(np.any(of_instants > allowed))
        excess = float((of_places / allowed).max())
        more = level + 1 < len(COUNTS) and excess > 1.0
        if np.all(error <= rtol * size) or not (finer or more):
            return value, error
        fineness += finer
        if more:
            enough = np.array(COUNTS) >= COUNTS[level] * excess ** (1.0 / ORDER)
            level = max(level + 1, int(enough.argmax()) if enough.any() else len(COUNTS) - 1)
