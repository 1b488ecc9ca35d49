"""swt not at a point but over a critical distance ℓ: volume average and the theory of critical distances.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, or taken at the depth ℓ/2 (point method) or as the mean over the depths 0 … 2ℓ (line
method), straight down or along the critical plane.

With ℓ → 0 all three tend to the largest swt over all planes at the critical point. That is s, unless a plane
that does not hold the y axis is higher there, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.axes import DIRECTIONS
from swtstudy.mechanics.body.half_sphere import HalfSpheres, gauss, interpolation
from swtstudy.mechanics.body.local_swt import Fineness, LocalSwt, Places
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Distances from the circle, and inclinations, of the places in the half spheres, and places on a line: more
#: while a mean is not as accurate as asked for.
COUNTS, LINE_COUNTS = ((7, 13), (9, 19), (11, 25), (15, 33), (19, 41)), (17, 25, 37, 55)
#: The distance from the critical point is this power of the abscissa of a line.
LINE_POWER = 4
#: The error claimed of a mean over a half sphere, over its changes without every other place and over what
#: values are off there; of a mean over a line, over the latter; over the value itself (planes, cells).
OF_CHANGE, OF_OFF, OF_LINES, OF_VALUE = 0.25, 0.025, 0.3, 3e-4
#: The least error claimed of values on lines, over the largest of them: where swt is a thousandth of that,
#: many planes are alike.
OF_LARGEST = 2e-5
#: The error for want of places falls like about this power of their number.
ORDER, MARGIN = 2.2, 1.3
#: The least error claimed of a single value, over that.
OF_POINT = 1e-3
#: A value below this is none.
TINY = 1e-300
#: Largest over smallest distance that share their places.
SPAN = 40.0
#: Distances from the circle, and inclinations, of the places that show which part of the cycle matters.
SHOWN = 3, 7
#: How finely swt is searched for: finer while a mean is not as accurate as asked for.
FINENESS = (Fineness(3, 40), Fineness(6, 60))
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
            found = _refined(around.in_spheres, [count for _, count in COUNTS], rtol)
            volume[row, group], volume_error[row, group] = found
            lines, error = _refined(around.on_lines, LINE_COUNTS, rtol)
            point[row, group], line[row, group] = lines
            # A peak that is missed at one place does not average out.
            point_error[row, group] = np.maximum(error[0], OF_POINT * lines[0])
            line_error[row, group] = error[1]
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


#: A value, its error for want of places, and what instants may be missing in it, of one shape.
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
        self.first: dict[Callable[[int], Places], FloatArray] = {}

    def in_spheres(self, level: int, fineness: int) -> Found:
        """Means over half spheres, shape (k,)."""
        swt, missing = self._swt(self._in_spheres, level, fineness)
        spheres = self._spheres(level)
        weights = spheres.weights(self.distance)
        change, off = spheres.changes(self.distance, swt)
        return weights @ swt, OF_CHANGE * change + OF_OFF * off, weights @ missing

    def on_lines(self, level: int, fineness: int) -> Found:
        """Values at ℓ/2, and means over 0 … 2ℓ, along the vectors, shape (2, k, d)."""
        swt, missing = self._swt(self._on_lines, level, fineness)
        found = np.stack([swt, missing]).reshape(2, -1, len(self.into))
        (point, line), (no_point, no_line) = (np.split(v, [self.distance.size]) for v in found)
        abscissa = _abscissae(LINE_COUNTS[level])
        weights = self._line_weights(abscissa)
        off = np.abs(line - interpolation(abscissa[::2], abscissa) @ line[::2])
        error = OF_LARGEST * swt.max() + np.stack([np.zeros_like(point), OF_LINES * np.abs(weights) @ off])
        return np.stack([point, weights @ line]), error, np.stack([no_point, weights @ no_line])

    def _swt(
        self, places: Callable[[int], Places], level: int, fineness: int
    ) -> tuple[FloatArray, FloatArray]:
        """swt at places, and what is missing of it; the first ones of both kinds at a time."""
        if level or fineness:
            return self._local(FINENESS[fineness]).swt(places(level))
        if not self.first:
            kinds = self._in_spheres, self._on_lines
            parts = [of_kind(0) for of_kind in kinds]
            both = Places(*(np.concatenate(part) for part in zip(*parts, strict=True)))
            found = np.stack(self._local(FINENESS[0]).swt(both))
            cut = [parts[0].radius.size]
            self.first = dict(zip(kinds, np.split(found, cut, axis=1), strict=True))
        swt, missing = self.first[places]
        return swt, missing

    def _spheres(self, level: int) -> HalfSpheres:
        return HalfSpheres(abs(self.x), self.largest, *COUNTS[level])

    def _in_spheres(self, level: int) -> Places:
        return self._turned(*self._spheres(level).places())

    def _on_lines(self, level: int) -> Places:
        away = 2.0 * self.largest * _abscissae(LINE_COUNTS[level]) ** LINE_POWER
        return self._of_lines(np.concatenate([0.5 * self.distance, away]))

    def _local(self, fineness: Fineness) -> LocalSwt:
        """swt at the instants that matter at some of the places."""
        if fineness not in self.local:
            spheres = HalfSpheres(abs(self.x), self.largest, *SHOWN)
            lines = self._of_lines(self.largest * np.array([0.1, 0.6, 2.0]))
            inside = self._turned(*spheres.grid(1))
            some = (np.concatenate(parts) for parts in zip(inside, lines, strict=True))
            self.local[fineness] = LocalSwt(self.scene, abs(self.x), Places(*some), fineness)
        return self.local[fineness]

    def _turned(self, radius: FloatArray, depth: FloatArray, angle: FloatArray) -> Places:
        """Places at angles from the critical point."""
        return Places(radius, depth, angle if self.x >= 0.0 else np.pi - angle)

    def _of_lines(self, away: FloatArray) -> Places:
        """Places at distances from the critical point, along one vector after the other at each."""
        right = (self.x + away[:, None] * self.into[:, 0]).ravel()
        depth = (away[:, None] * self.into[:, 1]).ravel()
        return Places(np.abs(right), depth, np.where(right < 0.0, np.pi, 0.0))

    def _line_weights(self, abscissa: FloatArray) -> FloatArray:
        """Weights of values at abscissae in the means over 0 … 2ℓ, shape (k, n)."""
        node, weight = gauss(ABSCISSAE)
        weight = LINE_POWER * node ** (LINE_POWER - 1) * weight
        scaled = (self.distance[:, None] / self.largest) ** (1.0 / LINE_POWER) * node
        return np.asarray(weight @ interpolation(abscissa, scaled))


def _abscissae(count: int) -> FloatArray:
    """Places along a line, denser towards both ends, in (0, 1)."""
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.arange(1, count + 1) / (count + 1)))


def _refined(
    at: Callable[[int, int], Found], counts: Sequence[int], rtol: float
) -> tuple[FloatArray, FloatArray]:
    """A value and its error, with more places and instants as far as they are needed."""
    level, fineness = 0, 0
    while True:
        value, of_places, missing = at(level, fineness)
        size, of_instants = np.abs(value), np.abs(missing)
        error = of_places + of_instants + OF_VALUE * size
        # Half of the error may come from instants that are missing, the rest from places.
        allowed = np.maximum((rtol - OF_VALUE) * size, TINY)
        finer = fineness + 1 < len(FINENESS) and bool(np.any(of_instants > 0.5 * allowed))
        excess = float(np.max(of_places / np.maximum(allowed - of_instants, 0.5 * allowed)))
        more = level + 1 < len(counts) and excess > 1.0
        if np.all(error <= rtol * size) or not (finer or more):
            return value, error
        wanted = counts[level] * (MARGIN * excess) ** (1.0 / ORDER)
        while more and level + 1 < len(counts):
            level += 1
            if counts[level] >= wanted:
                break
        fineness += finer
