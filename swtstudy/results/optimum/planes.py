"""Tangent planes of a function at points of the unit cube, and the steps that they suggest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

#: Step of a difference quotient as a fraction of the distance, and its least: rounding of s is 1e-8.
_DIFFERENCE, _SMALLEST_DIFFERENCE = 0.03, 1e-6

#: Distances, as fractions, within which the lowest point is tried: curvature spoils long steps.
_FRACTIONS = (1.0, 0.3)
#: A plane that is off by this fraction of its rise is bent by a kink.
_BENT = 0.2


@dataclass(frozen=True)
class Planes(Rows):
    """Points, values and gradients of m tangent planes, shapes (m, d), (m,) and (m, d)."""

    points: FloatArray
    values: FloatArray
    gradients: FloatArray

    @classmethod
    def none(cls, dimensions: int) -> Planes:
        """No planes."""
        return cls(np.empty((0, dimensions)), np.empty(0), np.empty((0, dimensions)))

    def __len__(self) -> int:
        return len(self.values)

    def within(self, centre: FloatArray, distance: float) -> Planes:
        """Return the planes of points within a distance along each axis."""
        return self.take((np.abs(self.points - centre) <= distance).all(axis=1))


def probes(points: FloatArray, distance: float) -> FloatArray:
    """Where a function has to be known for its tangent planes at m points, shape (m (d + 2), d)."""
    inward, directions = _neighbours(points, distance)
    beside = points[:, None, :] + inward[:, None, :] * directions
    return np.concatenate([points, beside.reshape(-1, points.shape[1])])


def planes_from(points: FloatArray, distance: float, found: FloatArray) -> Planes:
    """The tangent planes at points, by the differences of the values ``found`` at their `probes`.

    Left out are points where the function has no value, and those with a kink between them and their
    neighbours: differences on either side of it make a plane that touches neither.
    """
    inward, directions = _neighbours(points, distance)
    values, shifted = found[: len(points)], found[len(points) :].reshape(len(points), len(directions))
    with np.errstate(invalid="ignore"):  # infinite where there is no value
        rises = shifted - values[:, None]
        strayed = np.abs(rises[:, -1] - 0.5 * rises[:, :-1].sum(axis=1))
        bent = strayed > _BENT * np.abs(rises).max(axis=1)
    good = np.isfinite(values) & np.isfinite(shifted).all(axis=1) & ~bent
    return Planes(points[good], values[good], (rises[:, :-1] / inward)[good])


def _neighbours(points: FloatArray, distance: float) -> tuple[FloatArray, FloatArray]:
    """Steps to the neighbours of points along each axis, and the neighbours in these steps, (d + 1, d)."""
    step = max(_DIFFERENCE * distance, _SMALLEST_DIFFERENCE)
    d = points.shape[1]
    # The last neighbour checks the plane through the others.
    return np.where(points > 0.5, -step, step), np.concatenate([np.eye(d), np.full((1, d), 0.5)])


def lowest_of(planes: Planes, centre: FloatArray, value: float, distance: float) -> Iterator[FloatArray]:
    """The lowest points of the highest of planes, within distances of the centre along each axis.

    No plane is taken to be above the value at the centre, as those of a curve that bends down may be.
    """
    from scipy.optimize import linprog

    # Relative to the centre, in units of the distance: tolerances of the linear programme are absolute.
    offsets = planes.values + np.sum(planes.gradients * (centre - planes.points), axis=1) - value
    scale = max(float(np.abs(planes.gradients).max()) * distance, np.finfo(float).tiny)
    slopes = planes.gradients * distance / scale
    low, high = np.maximum(-centre / distance, -1.0), np.minimum((1.0 - centre) / distance, 1.0)
    for fraction in _FRACTIONS:
        found = linprog(
            np.append(np.zeros(len(centre)), 1.0),
            A_ub=np.column_stack([slopes, -np.ones(len(slopes))]),
            b_ub=-np.minimum(offsets, 0.0) / scale,
            bounds=[*zip(fraction * low, fraction * high, strict=True), (None, None)],
        )
        if found.success:
            yield np.clip(centre + distance * found.x[:-1], 0.0, 1.0)


def newton(planes: Planes, centre: FloatArray, distance: float) -> FloatArray:
    """Newton's step by the curvature that the gradients show, downhill along each of its axes."""
    nearest = int(np.abs(planes.points - centre).max(axis=1).argmin())
    gradient, origin = planes.gradients[nearest], planes.points[nearest]
    # Least squares: gradients = gradient + (points - origin) @ curvature.
    curvature, *_ = np.linalg.lstsq(planes.points - origin, planes.gradients - gradient, rcond=None)
    size, axes = np.linalg.eigh((curvature + curvature.T) / 2.0)
    slope = gradient @ axes
    # Where the curvature is too small for a step within the distance, the whole distance.
    length = np.where(np.abs(slope) > 0.0, distance, 0.0)
    curved = np.abs(size) * distance > np.abs(slope)
    np.divide(np.abs(slope), np.abs(size), out=length, where=curved)
    step = axes @ (-np.sign(slope) * length)
    return np.clip(origin + np.clip(step, -distance, distance), 0.0, 1.0)
