"""swt not at a point but over a critical distance ℓ: volume average and the theory of critical distances.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, or taken at the depth ℓ/2 (point method) or as the mean over the depths 0 … 2ℓ (line
method), straight down or along the critical plane.

With ℓ → 0 all three tend to the largest swt over all planes at the critical point. That is s, unless a plane
that does not hold the y axis is higher there, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.half_sphere import HalfSpheres, gauss, interpolation
from swtstudy.mechanics.body.local_swt import Fineness, LocalSwt, Places
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.parameters import DIRECTIONS

#: Distances from the circle, and inclinations, of the places in the half spheres, and places on a line: more
#: while a mean is not as accurate as asked for. Of those on a line each number holds the one before.
COUNTS, LINE_COUNTS = (13, 19, 29), (15, 31, 63)
#: The distance from the critical point is this power of the abscissa of a line.
LINE_POWER = 4
#: The error claimed, over the changes of a mean without every other place, and over the value itself
#: (instants, planes, cells).
OF_CHANGE, OF_VALUE = 0.2, 3e-4
#: Largest over smallest distance that share their places.
SPAN = 40.0
#: Places that show which part of the cycle matters.
SHOWN = 12
#: Instants and cells for the many values of a half sphere and for the few of a line.
IN_SPHERES, ON_LINES = Fineness(3, 16), Fineness(4, 40)
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
        one, x = scene.take(np.array([row])), float(position[row])
        into = _directions(float(angle[row]))
        for group in groups:
            ell = distance[group]
            volume[row, group], volume_error[row, group] = _volume_means(one, x, ell, rtol)
            at, mean = _along_lines(one, x, into, ell, rtol)
            point[row, group], point_error[row, group] = at
            line[row, group], line_error[row, group] = mean
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


def _volume_means(scene: Scene, x: float, distance: FloatArray, rtol: float) -> tuple[FloatArray, FloatArray]:
    """Means over half spheres about (x, 0, 0) and their errors, shape (k,)."""
    local = None
    for count in COUNTS:
        spheres = HalfSpheres(abs(x), float(distance.max()), count)
        radius, depth, angle = spheres.places()
        places = Places(radius, depth, angle if x >= 0.0 else np.pi - angle)
        local = local or _local_swt(scene, x, places, IN_SPHERES)
        mean, *change = spheres.weights(distance) @ local.swt(places)
        error = OF_CHANGE * np.abs(change).sum(axis=0) + OF_VALUE * mean
        if np.all(error <= rtol * mean):
            break
    return mean, error


def _along_lines(
    scene: Scene, x: float, into: FloatArray, distance: FloatArray, rtol: float
) -> tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]:
    """Values at ℓ/2 and means over 0 … 2ℓ along unit vectors, each with errors, shape (k, directions)."""
    largest = 2.0 * float(distance.max())
    share = distance / distance.max()
    abscissa = _line_abscissae(LINE_COUNTS[0])
    places = _on_lines(x, into, np.concatenate([largest * abscissa**LINE_POWER, 0.5 * distance]))
    local = _local_swt(scene, x, places, ON_LINES)
    swt = local.swt(places).reshape(-1, len(into))
    swt, point = swt[: abscissa.size], swt[abscissa.size :]
    for count in LINE_COUNTS:
        if len(swt) < count:
            abscissa, held = _line_abscissae(count), swt
            swt = np.empty((count, len(into)))
            swt[1::2] = held
            places = _on_lines(x, into, largest * abscissa[::2] ** LINE_POWER)
            swt[::2] = local.swt(places).reshape(-1, len(into))
        mean = _line_means(abscissa, swt, share)
        change = [
            _line_means(abscissa[part], swt[part], share) - mean
            for part in (slice(0, None, 2), slice(1, None, 2))
        ]
        error = OF_CHANGE * np.abs(change).sum(axis=0) + OF_VALUE * mean
        if np.all(error <= rtol * mean):
            break
    return (point, OF_VALUE * point), (mean, error)


def _local_swt(scene: Scene, x: float, places: Places, fineness: Fineness) -> LocalSwt:
    """swt around the critical point, the instants being those that matter at some of the places."""
    shown = np.linspace(0, places.radius.size - 1, SHOWN).astype(int)
    return LocalSwt(scene, abs(x), places.at(shown), fineness)


def _line_abscissae(count: int) -> FloatArray:
    """Chebyshev's places in (0, 1)."""
    return 0.5 - 0.5 * np.cos(np.pi * np.arange(1, count + 1) / (count + 1))


def _on_lines(x: float, into: FloatArray, away: FloatArray) -> Places:
    """Places at distances from the critical point along unit vectors, one after another."""
    right = (x + away[:, None] * into[:, 0]).ravel()
    depth = (away[:, None] * into[:, 1]).ravel()
    return Places(np.abs(right), depth, np.where(right < 0.0, np.pi, 0.0))


def _line_means(abscissa: FloatArray, swt: FloatArray, share: FloatArray) -> FloatArray:
    """Means over the first shares of a line, shape (k, directions), from values at abscissae."""
    node, weight = gauss(ABSCISSAE)
    weight = LINE_POWER * node ** (LINE_POWER - 1) * weight
    scaled = share[:, None] ** (1.0 / LINE_POWER) * node
    return np.asarray((weight @ interpolation(abscissa, scaled)) @ swt)
