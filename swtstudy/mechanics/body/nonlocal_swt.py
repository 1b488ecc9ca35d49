"""swt not at a point but over a critical distance ℓ: means over a volume or a line, and the point method.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, in a plane contact over the half disc in its section; or taken at the depth ℓ/2
(point method), or as the mean over the depths 0 … 2ℓ, straight down or along the critical plane. These are
means of a parameter that is quadratic in stress, not of stress, as Taylor's volume and line methods are.

With ℓ → 0 all three tend to the largest swt over all planes at the critical point. That is s, unless a plane
that does not hold the y axis is higher there, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.around import Around
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.vocabulary.axes import DIRECTIONS

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
    scene: Scene, position: FloatArray, angle: FloatArray, distance: FloatArray, rtol: float = 1e-3
) -> NonlocalSwt:
    """swt over critical distances about one point each of n scenes.

    Parameters
    ----------
    scene
        n points.
    position, angle
        Shape (n,): signed x of the points on the surface line, in a_H, and the angle between the normal of
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
        for group in groups:
            around = Around(scene.take(np.array([row])), float(position[row]), into, distance[group])
            of_spheres, of_lines = around.means(rtol)
            volume[row, group], volume_error[row, group] = of_spheres.value, of_spheres.error
            point[row, group], line[row, group] = of_lines.value
            # A peak that is missed at one place does not average out.
            point_error[row, group] = np.maximum(of_lines.error[0], OF_POINT * of_lines.value[0])
            line_error[row, group] = of_lines.error[1]
    about = (np.broadcast_to(position.reshape(-1, *(1,) * (v.ndim - 1)), v.shape) for v in (volume, point))
    volume_x, point_x = about
    return NonlocalSwt(volume, volume_error, point, point_error, line, line_error, volume_x, point_x, point_x)


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
