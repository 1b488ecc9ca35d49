"""Criteria of the body's stress histories over all plane orientations (eq. 9).

On the plane with the normal n, swt is the maximum over the cycle of σ_n times half the range of ε_n. It is a
maximum over triples of instants (of the largest stress, the largest and the smallest strain) of a product of
two quadratic forms of n. A maximum of smooth functions has its own maxima where one of them has: the search
climbs from the highest planes of a coarse hemisphere (`swtstudy.mechanics.planes.ascent`) and keeps the
highest summit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mechanics.numerics.arrays import ROUNDING, SAME, hemisphere
from swtstudy.mechanics.numerics.roots import MOST_STEPS
from swtstudy.mechanics.planes.ascent import climb, swap_instants
from swtstudy.mechanics.planes.criterion import SWT, Criterion
from swtstudy.mechanics.planes.weights import normal_weights, symmetric_tensor
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray

#: Planes of the coarse search, about 10° apart. Half: 1e-6 in 16 values of bodies, no faster; twice: 6e-7.
COARSE_PLANES = 256
#: Highest planes of the coarse search, from which the climbs start. Not only its peaks: two summits can
#: stand closer to one another than the planes. 3: rounding in 16 values of bodies, 20 % faster; 12: rounding.
CANDIDATES = 6
#: Summits as high as this fraction of the highest may have a higher neighbour, or be the highest with more
#: instants. No neighbours: 1.5e-3 low at 1 of 1,500 random histories; no rivals: 4e-3 to 2e-2 at 3 of 1,080
#: places of bodies.
PROMISING = 0.9
#: Histories times planes of a look at a time: with their instants they stay in the processor's cache. An
#: eighth or eight times: the same time to 8 % at 229 instants.
BLOCK_SIZE = 2048


class CriticalPlane(NamedTuple):
    """The critical plane of each history.

    Attributes
    ----------
    swt
        Shape (...): σ_n^max Δε_n/2, in the unit of stress²/modulus; 0 where no plane ever sees tension.
    normal
        Shape (..., 3): unit normal, its first non-zero component positive.
    """

    swt: FloatArray
    normal: FloatArray


def swt_of_history(
    stress: ArrayLike, poisson_ratio: float, young_modulus: float = 1.0, criterion: Criterion = SWT
) -> CriticalPlane:
    """Largest value over all planes of a criterion of shape (1,), without checks of the input."""
    history = np.asarray(stress, dtype=float)
    batch = history.shape[:-2]
    history = history.reshape(-1, *history.shape[-2:])
    tensor = criterion.swing.tensor(history, poisson_ratio, young_modulus)
    start = _starts(history, poisson_ratio, young_modulus, criterion)
    index = np.tile(np.arange(len(history)), CANDIDATES)
    every = criterion.take(np.zeros(len(index), dtype=np.intp))
    swt, normal = climb(history[index], tensor[index], start.reshape(-1, 3), every)
    highest = swt.reshape(CANDIDATES, -1).max(axis=0)
    open_ = np.flatnonzero((swt > 0.0) & (swt >= PROMISING * highest[index]) & _distinct(normal))
    for _ in range(MOST_STEPS):
        if not len(open_):
            break
        some, own = (history[index[open_]], tensor[index[open_]]), every.take(open_)
        higher, where = climb(*some, swap_instants(*some, normal[open_], own), own)
        better = higher > swt[open_]
        open_ = open_[better]
        swt[open_], normal[open_] = higher[better], where[better]
    best = swt.reshape(CANDIDATES, -1).argmax(axis=0), np.arange(len(history))
    swt, normal = swt.reshape(CANDIDATES, -1)[best], normal.reshape(CANDIDATES, -1, 3)[best]
    # n and −n are the same plane: show the one whose first component that is not 0 is positive.
    first = np.argmax(np.abs(normal) > SAME, axis=1)
    normal = normal * np.sign(np.take_along_axis(normal, first[:, None], axis=1)) + 0.0
    return CriticalPlane(swt.reshape(batch), normal.reshape(*batch, 3))


def swt_on_planes(
    stress: ArrayLike,
    normals: ArrayLike,
    poisson_ratio: float,
    young_modulus: float = 1.0,
    criterion: Criterion = SWT,
) -> FloatArray:
    """A criterion of shape (1,) on given planes.

    Parameters
    ----------
    stress
        Shape (..., time, 6).
    normals
        Shape (planes, 3), unit vectors.
    poisson_ratio, young_modulus
        ν, E.

    Returns
    -------
    swt
        Shape (..., planes).
    """
    stress, normals = np.asarray(stress), np.asarray(normals)
    on_planes = stress @ normal_weights(normals).T
    tension = on_planes.max(axis=-2)
    amplitude = criterion.swing.amplitudes(stress, normals, on_planes, poisson_ratio, young_modulus)
    return criterion.value(tension, amplitude)


def _starts(
    stress: FloatArray, poisson_ratio: float, young_modulus: float, criterion: Criterion
) -> FloatArray:
    """Normals from which to climb, shape (candidates, n, 3)."""
    normals = hemisphere(COARSE_PLANES)
    swt = _look(stress, normals, poisson_ratio, young_modulus, criterion)
    start = normals[np.argpartition(-swt, CANDIDATES, axis=1)[:, :CANDIDATES]]
    # Tension may be confined to a cone too narrow for the coarse planes.
    blind = np.flatnonzero(swt.max(axis=1) <= 0.0)
    start[blind] = _most_tensile_direction(stress[blind])[:, None]
    return start.swapaxes(0, 1)


def _look(
    stress: FloatArray, normals: FloatArray, ν: float, young_modulus: float, criterion: Criterion
) -> NDArray[np.float32]:
    """A criterion of many histories, (m, T, 6), on the same planes, (k, 3), in single precision, (m, k)."""
    single, count = normals.astype(np.float32), max(BLOCK_SIZE // len(normals), 1)
    value = np.empty((len(stress), len(normals)), dtype=np.float32)
    for first in range(0, len(stress), count):
        part = slice(first, first + count)
        value[part] = swt_on_planes(stress[part].astype(np.float32), single, ν, young_modulus, criterion)
    return value


def _most_tensile_direction(stress: FloatArray) -> FloatArray:
    """Direction of the largest principal stress of the cycle, shape (n, 3)."""
    values, directions = np.linalg.eigh(symmetric_tensor(stress))
    instant = values[..., 2].argmax(axis=1)
    return directions[np.arange(len(stress)), instant, :, 2]


def _distinct(normal: FloatArray) -> np.ndarray:
    """False for summits that an earlier candidate of the same history has reached."""
    summits = normal.reshape(CANDIDATES, -1, 3)
    distinct = np.ones(summits.shape[:2], dtype=bool)
    for late in range(1, CANDIDATES):
        closeness = np.abs((summits[:late] * summits[late]).sum(axis=-1))
        distinct[late] = (closeness < 1.0 - ROUNDING).all(axis=0)
    return distinct.ravel()


#: Planes of a look at many histories, about 13° apart, and how many are beside each of them.
LOOK_PLANES, BESIDE = 128, 6


@dataclass(frozen=True)
class CoarsePlanes:
    """Planes from which to climb.

    Attributes
    ----------
    normal
        Shape (k, 3).
    beside
        Shape (k, b): numbers of the planes beside each.
    """

    normal: FloatArray
    beside: IndexArray

    @staticmethod
    def everywhere() -> CoarsePlanes:
        """Return planes of all orientations."""
        return CoarsePlanes(hemisphere(LOOK_PLANES), _beside())

    def some(self, which: BoolArray) -> CoarsePlanes:
        """Some of the planes."""
        number = np.where(which, np.cumsum(which) - 1, -1)
        beside = number[self.beside[which]]
        own = np.arange(len(beside))[:, None]
        return CoarsePlanes(self.normal[which], np.where(beside < 0, own, beside))

    def swt(self, stress: FloatArray, ν: float, criterion: Criterion) -> NDArray[np.float32]:
        """swt of histories, (m, T, 6), on the planes, shape (m, k)."""
        return _look(stress, self.normal, ν, 1.0, criterion)


@lru_cache(maxsize=1)
def _beside() -> IndexArray:
    """The planes beside each of the coarse ones, shape (LOOK_PLANES, BESIDE)."""
    normals = hemisphere(LOOK_PLANES)
    return np.argsort(-np.abs(normals @ normals.T), axis=1)[:, 1 : 1 + BESIDE]
