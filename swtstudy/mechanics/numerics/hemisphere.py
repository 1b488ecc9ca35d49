"""Nearly evenly spread plane normals: n and −n are one plane, so that half a sphere holds them all."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from swtstudy.mechanics.points import FloatArray


@lru_cache(maxsize=4)
def hemisphere(planes: int) -> FloatArray:
    """Unit normals on a Fibonacci spiral over the half sphere z > 0.

    Parameters
    ----------
    planes
        Number of planes n; their spacing is about √(2π/n) rad.

    Returns
    -------
    normals
        Shape (n, 3); no two are the same plane.
    """
    index = np.arange(planes)
    z = 1.0 - (index + 0.5) / planes
    angle = index * np.pi * (3.0 - np.sqrt(5.0))
    radius = np.sqrt(1.0 - z**2)
    normals = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1)
    normals.flags.writeable = False
    return normals
