"""Crossland's criterion of a stress history: no plane, but the deviatoric path and the hydrostatic stress."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray

#: Lengths below this share of a path are none.
NO_LENGTH = 1e-12
#: Steps for each dimension and point at most: each adds a point to those on the sphere or drops one.
STEPS = 50


def crossland(stress: FloatArray, sensitivity: float) -> FloatArray:
    """√J2,a + α max σ_H, of histories (…, T, 6), shape (…).

    √J2,a is the radius of the smallest sphere around the deviatoric path, in the norm √(s:s/2).
    """
    hydrostatic = stress[..., :3].mean(axis=-1, keepdims=True)
    path = stress.copy()
    path[..., :3] = (path[..., :3] - hydrostatic) / np.sqrt(2.0)
    flat = path.reshape(-1, *path.shape[-2:])
    radius = np.array([smallest_sphere(points)[1] for points in flat]).reshape(stress.shape[:-2])
    return np.maximum(radius + sensitivity * hydrostatic[..., 0].max(axis=-1), 0.0)


def smallest_sphere(points: FloatArray) -> tuple[FloatArray, float]:
    """Centre and radius of the smallest sphere around points, (k, d).

    The centre walks towards the points on the sphere, which shrinks until another point is on it, or until it
    is between them (Fischer, Gärtner and Kutz 2003).
    """
    centre = points[0].copy()
    on = [int(((points - centre) ** 2).sum(axis=1).argmax())]
    size = max(float(np.ptp(points, axis=0).max()), 1e-300)
    for _ in range(STEPS * (points.shape[1] + len(points))):
        base, others = points[on[0]], points[on[1:]] - points[on[0]]
        share = np.linalg.lstsq(others.T, centre - base, rcond=None)[0]
        way = base + share @ others - centre
        if np.linalg.norm(way) <= NO_LENGTH * size:
            shares = np.append(1.0 - share.sum(), share)
            if shares.min() >= -NO_LENGTH:
                break
            on.pop(int(shares.argmin()))
            continue
        short = ((points - centre) ** 2).sum(axis=1) - ((base - centre) ** 2).sum()
        nears = 2.0 * (base - points) @ way
        nears[on] = 0.0
        reaches = nears > NO_LENGTH * size**2
        stop = np.full(len(points), np.inf)
        stop[reaches] = np.maximum(-short[reaches], 0.0) / nears[reaches]
        first = int(stop.argmin())
        centre = centre + min(stop[first], 1.0) * way
        if stop[first] < 1.0:
            on.append(first)
    return centre, float(np.sqrt(((points - centre) ** 2).sum(axis=1).max()))
