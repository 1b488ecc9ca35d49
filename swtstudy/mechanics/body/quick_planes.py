"""The critical planes of many similar histories: fewer planes and climbs than `all_planes` takes."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.numerics.hemisphere import hemisphere
from swtstudy.mechanics.planes.all_planes import swt_on_planes
from swtstudy.mechanics.planes.ascent import climb
from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.points import FloatArray

#: Planes of the coarse search, about 13° apart.
PLANES = 128
#: The highest plane whose normal is further away than this cosine may have a summit of its own, if it is at
#: least so high, over the highest of all.
APART, WORTHY = 0.85, 0.9
#: Histories in the coarse search at a time.
BLOCK = 16


def quick_planes(stress: FloatArray, poisson_ratio: float) -> FloatArray:
    """Normals of the planes of largest swt.

    Parameters
    ----------
    stress
        Shape (m, T, 6), in E* √(δ0/R).
    poisson_ratio
        ν.

    Returns
    -------
    Shape (m, 3).
    """
    start, rival, worthy = _coarse_planes(stress, poisson_ratio)
    swt, normal = climb_from(stress, poisson_ratio, start)
    several = np.flatnonzero(worthy)
    if several.size:
        other, where = climb_from(stress[several], poisson_ratio, rival[several])
        higher = other > swt[several]
        normal[several[higher]] = where[higher]
    return normal


def highest_coarse_planes(stress: FloatArray, poisson_ratio: float) -> FloatArray:
    """The same without a climb: normals some degrees off."""
    return _coarse_planes(stress, poisson_ratio)[0]


def climb_from(stress: FloatArray, ν: float, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Summits of swt over E* δ0/R, (m,), and their normals, (m, 3), from normals nearby."""
    return climb(stress, strain_history(stress, ν, 1.0 - ν**2), start)


def _coarse_planes(stress: FloatArray, ν: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The highest of few planes, the highest apart from it, and whether that is worth a climb."""
    normals = hemisphere(PLANES)
    single, apart = normals.astype(np.float32), np.abs(normals @ normals.T) < APART
    best, rival = np.empty((2, len(stress)), dtype=np.intp)
    worthy = np.empty(len(stress), dtype=bool)
    for first in range(0, len(stress), BLOCK):
        part = slice(first, first + BLOCK)
        swt = swt_on_planes(stress[part].astype(np.float32), single, ν)
        best[part] = swt.argmax(axis=1)
        others = np.where(apart[best[part]], swt, 0.0)
        rival[part] = others.argmax(axis=1)
        worthy[part] = others.max(axis=1) > WORTHY * swt.max(axis=1)
    return normals[best], normals[rival], worthy
