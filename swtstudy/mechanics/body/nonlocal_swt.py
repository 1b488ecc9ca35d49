"""swt not at a point but over a critical distance ℓ: volume average and the theory of critical distances.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, or taken at the depth ℓ/2 (point method) or as the mean over the depths 0 … 2ℓ (line
method), straight down or along the critical plane.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.body.body import Body
from swtstudy.mechanics.points import FloatArray

#: Gauss points over the radius, the polar angle and the azimuth of the half sphere, and over a line. Half:
#: 2e-3, 2e-2, 4e-2 and 8e-3 of four bodies' means, up to twice as fast; twice: 8e-4, 2e-3, 1e-2 and 2e-3.
RADIAL, POLAR, AZIMUTH, LINE = 8, 8, 12, 24


def volume_mean(body: Body, x: float, distance: FloatArray) -> FloatArray:
    """Mean of swt over half spheres about (x, 0, 0).

    Parameters
    ----------
    body
        The body over one cycle.
    x
        Critical point on the line y = 0 of the surface, in a_H.
    distance
        Shape (k,): radii ℓ > 0 in a_H.

    Returns
    -------
    mean
        Shape (k,), over E* δ0/R.
    """
    radius, radius_weight = _gauss(RADIAL)
    radius_weight = 3.0 * radius_weight * radius**2
    cosine, cosine_weight = _gauss(POLAR)
    angle, angle_weight = _gauss(AZIMUTH)
    # y → −y is a symmetry: half of the azimuth is enough.
    ρ, c, φ = np.meshgrid(radius, cosine, np.pi * angle, indexing="ij")
    weight = radius_weight[:, None, None] * cosine_weight[:, None] * angle_weight
    s = np.sqrt(1.0 - c * c)
    direction = np.stack([ρ * s * np.cos(φ), ρ * s * np.sin(φ), ρ * c])
    offset = distance.reshape(-1, 1, 1, 1) * direction[:, None]
    swt = body.swt(x + offset[0], offset[1], offset[2]).swt
    return np.asarray((swt * weight).sum(axis=(1, 2, 3)))


def at_distance(body: Body, x: float, direction: FloatArray, distance: FloatArray) -> FloatArray:
    """swt at the distance ℓ/2 from the critical point along a unit vector (point method), shape (k,)."""
    away = 0.5 * distance[:, None] * direction
    return body.swt(x + away[:, 0], away[:, 1], away[:, 2]).swt


def line_mean(body: Body, x: float, direction: FloatArray, distance: FloatArray) -> FloatArray:
    """Mean of swt over the distances 0 … 2ℓ from the critical point (line method), shape (k,)."""
    t, weight = _gauss(LINE)
    # Next to the surface the stress is smooth in the root of the depth.
    away = 2.0 * distance[:, None, None] * (t * t)[:, None] * direction
    swt = body.swt(x + away[..., 0], away[..., 1], away[..., 2]).swt
    return np.asarray((swt * (2.0 * t * weight)).sum(axis=1))


def critical_direction(normal: FloatArray) -> FloatArray:
    """Unit vector into the body along the critical plane, within the plane y = 0."""
    into = np.array([-normal[2], 0.0, normal[0]])
    return into * np.copysign(1.0, into[2]) / np.linalg.norm(into)


def _gauss(count: int) -> tuple[FloatArray, FloatArray]:
    """Gauss–Legendre nodes and weights on [0, 1]."""
    node, weight = np.polynomial.legendre.leggauss(count)
    return 0.5 * (1.0 + node), 0.5 * weight
