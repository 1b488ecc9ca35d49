"""swt not at a point but over a critical distance ℓ: means over a volume or a line, and the point method.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, in a plane contact over the half disc in its section; or taken at the depth ℓ/2
(point method), or as the mean over the depths 0 … 2ℓ, straight down or along the critical plane. These are
means of a parameter that is quadratic in stress, not of stress, as Taylor's volume and line methods are. They
are made of values at nested places about the point: as many as their accuracy asks for.

With ℓ → 0 all three tend to the largest swt over all planes at the critical point. That is s, unless a plane
that does not hold the y axis is higher there, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from swtstudy.kernel.field import MANY, SINGLE, Opened, criterion_at, open_cycle
from swtstudy.solver.half_sphere import (
    ABSCISSAE,
    HalfDiscs,
    HalfSpheres,
    from_every_other,
    gauss,
    interpolation,
    nested,
)
from swtstudy.solver.points import Points
from swtstudy.solver.solve import arguments_of
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray
from swtstudy.vocabulary.parameters import DIRECTIONS

#: Places in the half spheres at most, or four times as many where such a share of a mean is in doubt (none:
#: 6e-3 off at a point of tests/solver/test_nonlocal.py); and on a line.
MOST, IN_DOUBT, LINE_MOST = 1000, 1e-2, 80
#: The error claimed of a mean over a half sphere, over its changes without every other place and over what
#: values are off there; of a mean over a line, over the latter; over the value itself (planes, cells). Of
#: 1,080 random means 3 are off more than is claimed.
OF_CHANGE, OF_OFF, OF_LINES, OF_VALUE = 0.15, 0.025, 0.12, 1e-4
#: How much of what another place on the arcs adds is an error.
OF_ADDED = 0.06
#: The least error claimed, over it, of a mean over a smaller sphere than the largest, which has fewer places.
OF_SMALLER = 2e-4
#: The least error claimed of values on lines, over the largest of them: where swt is a thousandth of that,
#: many planes are alike.
OF_LARGEST = 2e-5
#: Relative tolerance of values that are averaged, and of single ones, over that of the means.
OF_MANY, OF_SINGLE = 0.3, 0.03
#: Values below this share of those at ℓ/2 are not told as closely: they do not tell in a mean.
FLOOR = 0.02
#: Tolerance of what grew in stick.
GROWTH = 1e-5


class Places(NamedTuple):
    """Radius, depth and angle about the axis of N places, each of shape (N,)."""

    radius: FloatArray
    depth: FloatArray
    angle: FloatArray

    def at(self, which: BoolArray) -> FloatArray:
        """x, y and z of some of the places, shape (m, 3)."""
        radius, depth, angle = (values[which] for values in self)
        across = np.where(angle < np.pi, radius * np.sin(angle), 0.0)
        return np.stack([radius * np.cos(angle), across, depth], axis=1)


class Layout(NamedTuple):
    """Places to begin with.

    Attributes
    ----------
    distances, inclinations, power
        As in `HalfSpheres`.
    on_line, line_power
        Places on a line, whose distances from the critical point are this power of the abscissa.
    """

    distances: int
    inclinations: int
    power: float
    on_line: int
    line_power: int


#: For one distance, and for several: small spheres and short lines need their places, too.
ONE, SEVERAL = Layout(7, 15, 1.5, 19, 2), Layout(9, 15, 2.0, 23, 2)


class Estimate(NamedTuple):
    """Values, their errors for want of places, and their errors; all of one shape."""

    value: FloatArray
    of_places: FloatArray
    error: FloatArray

    @classmethod
    def of(cls, value: FloatArray, of_places: FloatArray, missing: FloatArray) -> Estimate:
        """From what instants may be missing in the values."""
        return cls(value, of_places, of_places + np.abs(missing) + OF_VALUE * np.abs(value))

    @property
    def not_negative(self) -> Estimate:
        """The same of means of swt, which is never below 0: where interpolation is, that is in the error."""
        below = np.maximum(-self.value, 0.0)
        return Estimate(self.value + below, self.of_places, self.error + below)

    def allowed(self, rtol: float) -> FloatArray:
        """The error that places may make: half of all, or more if instants make less."""
        size = np.maximum((rtol - OF_VALUE) * np.abs(self.value), 1e-300)
        of_instants = self.error - self.of_places - OF_VALUE * np.abs(self.value)
        return np.maximum(size - of_instants, 0.5 * size)


class Around:
    """swt around one critical point.

    Parameters
    ----------
    opened
        The load cycle of its point.
    x
        Signed position of the critical point.
    into
        Shape (d, 2): unit vectors into the body (right, down).
    distance
        Shape (k,).
    rtol
        Relative accuracy asked for.
    """

    def __init__(self, opened: Opened, x: float, into: FloatArray, distance: FloatArray, rtol: float) -> None:
        self.opened, self.x, self.into, self.distance, self.rtol = opened, x, into, distance, rtol
        self.largest = float(distance.max())
        self.layout = layout = ONE if distance.size == 1 else SEVERAL
        parts = HalfDiscs if opened.profile["plane"] else HalfSpheres
        self.spheres = parts(abs(x), self.largest, layout.power, layout.distances, layout.inclinations)
        #: swt, and what is missing of it, at the places; NaN where it is not known yet.
        self.grid = np.full((*self.spheres.shape, 2), np.nan)
        # The arcs' rule is exact for what another place would add to the largest sphere.
        places = self._turned(*self.spheres.side_places()) if distance.size > 1 else Places(*np.empty((3, 0)))
        self.side_places, self.side = places, np.full((places.radius.size, 2), np.nan)
        self.points = np.full((distance.size, len(into), 2), np.nan)
        self.lines = np.full((layout.on_line, len(into), 2), np.nan)

    def means(self) -> tuple[Estimate, Estimate]:
        """`in_spheres` and `on_lines`, with as many places as the accuracy asks for."""
        rtol = self.rtol
        while True:
            self._look()
            spheres, of_axes = self.in_spheres()
            lines = self.on_lines()
            finer = self._refine_spheres(spheres, of_axes, rtol)
            if not (self._refine_lines(lines, rtol) | finer):
                return spheres.not_negative, lines.not_negative

    def in_spheres(self) -> tuple[Estimate, FloatArray]:
        """Means over half spheres, and what distances and inclinations have in their errors, (2, k)."""
        inner, values = self.spheres.weights(self.distance), self.grid.reshape(-1, 2)
        change, off = self.spheres.changes(inner, values[:, 0])
        of_axes = OF_CHANGE * change + OF_OFF * off
        added = np.zeros((2, self.distance.size))
        if self.side.size:
            added = (self.spheres.side_weights(self.distance) @ self.side).T
        value, missing = (inner @ values).T + added
        of_places = of_axes.sum(axis=0) + OF_ADDED * np.abs(added[0])
        of_places += OF_SMALLER * np.abs(value) * (self.distance < self.largest)
        return Estimate.of(value, of_places, missing), of_axes

    def on_lines(self) -> Estimate:
        """Values at ℓ/2, and means over 0 … 2ℓ, along the vectors, shape (2, k, d)."""
        weights = self._line_weights(len(self.lines))
        line, missing = np.moveaxis(self.lines, -1, 0)
        off = np.abs(line - from_every_other(len(line)) @ line[1::2])
        of_places = np.stack([np.zeros_like(self.points[..., 0]), OF_LINES * np.abs(weights) @ off])
        of_places += OF_LARGEST * max(self.lines[..., 0].max(), self.points[..., 0].max())
        value, missing = (np.stack([self.points[..., k], weights @ self.lines[..., k]]) for k in range(2))
        return Estimate.of(value, of_places, missing)

    def _refine_spheres(self, found: Estimate, of_axes: FloatArray, rtol: float) -> bool:
        """Refine the places in the spheres; return whether there are more of them now."""
        allowed, both = found.allowed(rtol), of_axes.sum(axis=0)
        # More places leave what other places on the arcs add.
        allowed = np.maximum(allowed - (found.of_places - both), 0.5 * allowed)
        blame = (of_axes / allowed)[:, both > allowed].max(axis=1, initial=0.0)
        before = self.spheres
        most = 4 * MOST if (found.error > IN_DOUBT * found.value).any() else MOST
        worse = int(blame.argmax())
        # The other one only if it alone would be too much.
        for axis in (worse, 1 - worse):
            finer = self.spheres.finer(axis)
            wanted = blame[axis] > (0.0 if axis == worse else 1.0)
            if wanted and finer.distances * finer.inclinations <= most:
                self.spheres, self.grid = finer, _spread(self.grid, axis)
        return self.spheres is not before

    def _refine_lines(self, found: Estimate, rtol: float) -> bool:
        """Refine the places on the lines; return whether there are more of them now."""
        if np.all(found.of_places <= found.allowed(rtol)) or 2 * len(self.lines) > LINE_MOST:
            return False
        self.lines = _spread(self.lines, 0)
        return True

    def _look(self) -> None:
        """swt where it is not known yet."""
        self._fill(self.points, self._of_lines(0.5 * self.distance), OF_SINGLE, 0.0, SINGLE)
        floor = FLOOR * float(self.points[..., 0].max())
        away = 2.0 * self.largest * nested(len(self.lines)) ** self.layout.line_power
        self._fill(self.grid, self._turned(*self.spheres.grid()), OF_MANY, floor, MANY)
        self._fill(self.side, self.side_places, OF_MANY, floor, MANY)
        self._fill(self.lines, self._of_lines(away), OF_MANY, floor, MANY)

    def _fill(
        self, values: FloatArray, places: Places, share: float, floor: float, coarsest: np.int64
    ) -> None:
        """Write swt and what is missing of it where it is not known yet."""
        flat = values.reshape(-1, 2)
        unknown = np.isnan(flat[:, 0])
        if unknown.any():
            found = criterion_at(self.opened, places.at(unknown), share * self.rtol, floor, coarsest)
            flat[unknown] = np.stack(found[:2], axis=1)

    def _turned(self, radius: FloatArray, depth: FloatArray, angle: FloatArray) -> Places:
        """Places at angles from the critical point."""
        return Places(radius, depth, angle if self.x >= 0.0 else np.pi - angle)

    def _of_lines(self, away: FloatArray) -> Places:
        """Places at distances from the critical point, along one vector after the other at each."""
        right = (self.x + away[:, None] * self.into[:, 0]).ravel()
        depth = (away[:, None] * self.into[:, 1]).ravel()
        return Places(np.abs(right), depth, np.where(right < 0.0, np.pi, 0.0))

    def _line_weights(self, count: int) -> FloatArray:
        """Weights of values at so many abscissae in the means over 0 … 2ℓ, shape (k, count)."""
        node, weight = gauss(max(ABSCISSAE, count))
        power = self.layout.line_power
        weight = power * node ** (power - 1) * weight
        scaled = (self.distance[:, None] / self.largest) ** (1.0 / power) * node
        return np.asarray(weight @ interpolation(count, scaled))


def _spread(values: FloatArray, axis: int) -> FloatArray:
    """The values with NaN beside each of them along an axis."""
    shape = list(values.shape)
    shape[axis] = 2 * shape[axis] + 1
    spread = np.full(shape, np.nan)
    np.moveaxis(spread, axis, 0)[1::2] = np.moveaxis(values, axis, 0)
    return spread


#: Largest over smallest distance that share their places.
SPAN = 12.0
#: The least error claimed of a single value, over that.
OF_POINT = 1e-3


@dataclass(frozen=True)
class NonlocalSwt:
    """swt over k critical distances at n points, over E* δ0/R as s, with absolute errors; NaN without s.

    Attributes
    ----------
    volume, volume_error
        Shape (n, k): means over half spheres, or half discs in the plane.
    point, point_error, line, line_error
        Shape (n, k, 2): values at ℓ/2 and means over 0 … 2ℓ in both `DIRECTIONS`.
    volume_x, point_x, line_x
        Shape (n, k), (n, k, 2) and (n, k, 2): signed x of the points of the surface line that they are about.
    """

    volume: FloatArray
    volume_error: FloatArray
    point: FloatArray
    point_error: FloatArray
    line: FloatArray
    line_error: FloatArray
    volume_x: FloatArray
    point_x: FloatArray
    line_x: FloatArray


def nonlocal_swt(
    points: Points, position: FloatArray, angle: FloatArray, distance: FloatArray, rtol: float = 1e-3
) -> NonlocalSwt:
    """swt over critical distances about one place each of n points.

    Parameters
    ----------
    points
        n points.
    position, angle
        Shape (n,): signed x of the places on the surface line, in a_H, and the angle between the normal of
        the worst plane there and the x axis, degrees; NaN where there is none.
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
        opened = open_cycle(GROWTH, **arguments_of(points[[row]]))
        for group in groups:
            around = Around(opened, float(position[row]), into, distance[group], rtol)
            of_spheres, of_lines = around.means()
            volume[row, group], volume_error[row, group] = of_spheres.value, of_spheres.error
            point[row, group], line[row, group] = of_lines.value
            # A peak that is missed at one place does not average out.
            point_error[row, group] = np.maximum(of_lines.error[0], OF_POINT * of_lines.value[0])
            line_error[row, group] = of_lines.error[1]
    about = (np.broadcast_to(position.reshape(-1, *(1,) * (v.ndim - 1)), v.shape) for v in (volume, point))
    volume_x, point_x = about
    return NonlocalSwt(volume, volume_error, point, point_error, line, line_error, volume_x, point_x, point_x)


def _groups(distance: FloatArray) -> list[IndexArray]:
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
