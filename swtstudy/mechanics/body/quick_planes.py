"""The critical planes of many similar histories: fewer planes and climbs than `all_planes` takes."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.numerics.hemisphere import hemisphere
from swtstudy.mechanics.planes.all_planes import swt_on_planes
from swtstudy.mechanics.planes.ascent import climb
from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.points import FloatArray

#: Planes of the coarse search, about 13° apart.
PLANES = 128
#: Planes beside each, than which a peak is higher.
BESIDE = 6
#: Another peak at least so high, over the highest plane, is climbed from, too.
WORTHY = 0.7
#: Histories in the coarse search at a time.
BLOCK = 16


def quick_planes(stress: FloatArray, poisson_ratio: float) -> tuple[FloatArray, FloatArray]:
    """Largest swt over the planes, and its planes.

    Parameters
    ----------
    stress
        Shape (m, T, 6), in E* √(δ0/R).
    poisson_ratio
        ν.

    Returns
    -------
    swt, normal
        Shape (m,), over E* δ0/R, and (m, 3).
    """
    start, rival, worthy = _coarse_planes(stress, poisson_ratio)
    swt, normal = climb_from(stress, poisson_ratio, start)
    several = np.flatnonzero(worthy)
    if several.size:
        other, where = climb_from(stress[several], poisson_ratio, rival[several])
        higher = other > swt[several]
        swt[several[higher]], normal[several[higher]] = other[higher], where[higher]
    return swt, normal


def highest_coarse_planes(stress: FloatArray, poisson_ratio: float) -> FloatArray:
    """Normals, (m, 3), some degrees off those of `quick_planes`."""
    return _coarse_planes(stress, poisson_ratio)[0]


def climb_from(stress: FloatArray, ν: float, start: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Summits of swt over E* δ0/R, (m,), and their normals, (m, 3), from normals nearby."""
    return climb(stress, strain_history(stress, ν, 1.0 - ν**2), start)


def _coarse_planes(stress: FloatArray, ν: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The highest of few planes, the highest other peak among them, and whether that is worth a climb."""
    normals, neighbours = hemisphere(PLANES), _neighbours()
    single = normals.astype(np.float32)
    best, rival = np.empty((2, len(stress)), dtype=np.intp)
    worthy = np.empty(len(stress), dtype=bool)
    for first in range(0, len(stress), BLOCK):
        part = slice(first, first + BLOCK)
        swt = swt_on_planes(stress[part].astype(np.float32), single, ν)
        row, best[part] = np.arange(len(swt)), swt.argmax(axis=1)
        least = WORTHY * swt[row, best[part]]
        peaked = swt >= swt[:, neighbours].max(axis=-1)
        peaked[row, best[part]] = False
        others = np.where(peaked, swt, 0.0)
        rival[part] = others.argmax(axis=1)
        worthy[part] = others[row, rival[part]] > least
    return normals[best], normals[rival], worthy


@lru_cache(maxsize=1)
def _neighbours() -> NDArray[np.intp]:
    """The planes beside each of the coarse ones, shape (PLANES, BESIDE)."""
    normals = hemisphere(PLANES)
    return np.argsort(-np.abs(normals @ normals.T), axis=1)[:, 1 : 1 + BESIDE]
