"""The critical planes of many similar histories: fewer planes and climbs than `all_planes` takes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.numerics.hemisphere import hemisphere
from swtstudy.mechanics.planes.all_planes import swt_of_history, swt_on_planes
from swtstudy.mechanics.planes.ascent import climb
from swtstudy.mechanics.planes.criterion import Walker
from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.points import FloatArray

#: Planes of the coarse search, about 13° apart.
PLANES = 128
#: Planes beside each.
BESIDE = 6
#: Planes this high in some histories, over the highest, are tried in others like them. 0: no change.
NEAR = 0.7
#: Highest planes from which to climb. Four: one of 2,600 histories was more than 1e-3 low; two: 17 were.
CANDIDATES = 4
#: Last step of a climb, rad: its square is the error. 1e-9: twice the steps.
LAST_STEP = 3e-3
#: Histories in the coarse search at a time.
BLOCK = 16


@dataclass(frozen=True)
class CoarsePlanes:
    """Planes from which to climb.

    Attributes
    ----------
    normal
        Shape (k, 3).
    """

    normal: FloatArray

    @staticmethod
    def everywhere() -> CoarsePlanes:
        """Those of all orientations."""
        return CoarsePlanes(hemisphere(PLANES))

    def swt(self, stress: FloatArray, ν: float, γ: float) -> FloatArray:
        """swt of histories, (m, T, 6), on the planes, shape (m, k)."""
        single = self.normal.astype(np.float32)
        swt = np.empty((len(stress), len(single)))
        for first in range(0, len(stress), BLOCK):
            part = slice(first, first + BLOCK)
            swt[part] = swt_on_planes(stress[part].astype(np.float32), single, ν, 1.0, γ)
        return swt


def planes_like(stress: FloatArray, ν: float, γ: float) -> CoarsePlanes:
    """Those of all planes that are near to the highest in some of the histories, and those beside them."""
    every = CoarsePlanes.everywhere()
    swt = every.swt(stress, ν, γ)
    high = (swt >= NEAR * swt.max(axis=1, keepdims=True)).any(axis=0)
    high[_beside()[high]] = True
    return CoarsePlanes(every.normal[high])


def highest_planes(
    stress: FloatArray, planes: CoarsePlanes, poisson_ratio: float, walker_exponent: float
) -> tuple[FloatArray, FloatArray]:
    """Largest swt over the planes, and its planes.

    Parameters
    ----------
    stress
        Shape (m, T, 6), in E* √(δ0/R).
    planes
        From which to climb.
    poisson_ratio, walker_exponent
        ν and γ.

    Returns
    -------
    swt, normal
        Shape (m,), over E* δ0/R, and (m, 3).
    """
    index = np.tile(np.arange(len(stress)), CANDIDATES)
    coarse = planes.swt(stress, poisson_ratio, walker_exponent)
    highest = np.argpartition(-coarse, CANDIDATES, axis=1)[:, :CANDIDATES].T
    swt, normal = climb_from(stress[index], poisson_ratio, planes.normal[highest.ravel()], walker_exponent)
    best = swt.reshape(CANDIDATES, -1).argmax(axis=0) * len(stress) + np.arange(len(stress))
    swt, normal = swt[best], normal[best]
    # Tension may be confined to few planes.
    none = np.flatnonzero(swt <= 0.0)
    if none.size:
        found = swt_of_history(stress[none], poisson_ratio, 1.0 - poisson_ratio**2, walker_exponent)
        swt[none], normal[none] = found
    return swt, normal


def highest_coarse_planes(
    stress: FloatArray, planes: CoarsePlanes, poisson_ratio: float, walker_exponent: float
) -> FloatArray:
    """Normals, (m, 3), some degrees off those of `highest_planes`."""
    return planes.normal[planes.swt(stress, poisson_ratio, walker_exponent).argmax(axis=1)]


def climb_from(stress: FloatArray, ν: float, start: FloatArray, γ: float) -> tuple[FloatArray, FloatArray]:
    """Summits of swt over E* δ0/R, (m,), and their normals, (m, 3), from normals nearby."""
    modulus = 1.0 - ν**2
    strain = strain_history(stress, ν, modulus)
    return climb(stress, strain, start, Walker.of(γ, modulus, len(start)), LAST_STEP)


@lru_cache(maxsize=1)
def _beside() -> NDArray[np.intp]:
    """The planes beside each of the coarse ones, shape (PLANES, BESIDE)."""
    normals = hemisphere(PLANES)
    return np.argsort(-np.abs(normals @ normals.T), axis=1)[:, 1 : 1 + BESIDE]
