"""Arrays of many short rows: look-ups, ragged rows as one, matching axes; places and directions that spread.

The look-ups are much faster than `numpy.take_along_axis`. Cosine-spaced places are dense at both ends, where
functions may begin like square roots; of plane normals n and −n are one plane, so that half a sphere holds
all.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray

#: What is nearer than this, relative or in rad, is apart by rounding.
ROUNDING = 1e-12
#: What is nearer than this is the same: a hundredth of the least error that is claimed for s.
SAME = 1e-9
#: Less than this is nothing: it divides nothing, and has no logarithm.
TINY = 1e-300
#: The same for what is raised to the third power before it divides.
TINY_ROOT = 1e-100
#: Longest rows that are counted column by column. Halving takes 0.7 to 2 times as long at 16, 0.3 at 48.
SHORT = 24

T = TypeVar("T", bound=np.generic)


def gather(values: NDArray[T], index: IndexArray) -> NDArray[T]:
    """``np.take_along_axis(values, index, axis=-1)``, where index may have more leading axes.

    Parameters
    ----------
    values
        Shape (…, k).
    index
        Shape (…, m) or (s, …, m), 0 ≤ index < k.
    """
    lead, k = values.shape[:-1], max(values.shape[-1], 1)
    first = np.arange(0, math.prod(lead) * k, k, dtype=np.intp).reshape(*lead, 1)
    return values.ravel().take(first + index)


def pick(values: NDArray[T], index: IndexArray) -> NDArray[T]:
    """One value of each row: values of shape (…, k) at the index of shape (…) or (s, …)."""
    return gather(values, index[..., None])[..., 0]


def packed(keep: BoolArray, *arrays: NDArray[T]) -> tuple[NDArray[T], ...]:
    """The kept entries of each row, moved to its front; shorter rows repeat their first kept entry.

    Parameters
    ----------
    keep
        Shape (…, k), at least one kept entry in each row.
    arrays
        Shape (…, k).

    Returns
    -------
    Arrays of shape (…, m), where m is the largest number of kept entries.
    """
    lead, k = keep.shape[:-1], keep.shape[-1]
    place = np.cumsum(keep, axis=-1)
    width = int(place[..., -1].max(initial=1))
    kept = np.flatnonzero(keep)
    target = kept // k * width + place.ravel()[kept] - 1
    first = keep.argmax(axis=-1)
    result = []
    for values in arrays:
        out = np.repeat(pick(values, first), width)
        out[target] = values.ravel()[kept]
        result.append(out.reshape(*lead, width))
    return tuple(result)


class RowTable:
    """n functions, each known at k ascending abscissae.

    Parameters
    ----------
    abscissa, value
        Shape (n, k).
    """

    def __init__(self, abscissa: FloatArray, value: FloatArray) -> None:
        self.abscissa, self.value = abscissa, value
        self._width = abscissa[:, -1:] - abscissa[:, :1]
        #: All rows as one ascending row, each within a unit of its own.
        self._key = self._keys(np.arange(len(abscissa))[:, None], abscissa).ravel()

    def interpolated(self, row: IndexArray, at: FloatArray) -> FloatArray:
        """The functions number ``row`` at (…), linear between their abscissae and constant beyond."""
        k = self.abscissa.shape[1]
        place = np.searchsorted(self._key, self._keys(row, at), side="right") - 1
        place = np.clip(place, row * k, row * k + k - 2)
        low, first = self.abscissa.take(place), self.value.take(place)
        high, last = self.abscissa.take(place + 1), self.value.take(place + 1)
        slope = (last - first) / (high - low)
        return np.asarray(slope * (np.clip(at, low, high) - low) + first)

    def _keys(self, row: IndexArray, at: FloatArray) -> FloatArray:
        share = (at - self.abscissa[row, 0]) / self._width[row, 0]
        return np.asarray(row + 0.5 * np.clip(share, 0.0, 1.0))


def align(values: NDArray[T], like: NDArray[Any]) -> NDArray[T]:
    """Append axes to ``values`` so that it broadcasts against ``like``, whose leading axes it shares."""
    return values.reshape(values.shape + (1,) * (like.ndim - values.ndim))


def distinct(values: FloatArray) -> tuple[FloatArray, IndexArray]:
    """The distinct values of each row, ascending.

    Parameters
    ----------
    values
        Shape (n, k).

    Returns
    -------
    distinct, number
        Shape (n, m), shorter rows repeat their first, and (n, k): the number of each value among them.
    """
    order = np.argsort(values, axis=1, kind="stable")
    ascending = gather(values, order)
    new = np.ones(values.shape, dtype=bool)
    new[:, 1:] = ascending[:, 1:] != ascending[:, :-1]
    number = np.empty(values.shape, dtype=np.intp)
    np.put_along_axis(number, order, np.cumsum(new, axis=1) - 1, axis=1)
    return packed(new, ascending)[0], number


def between(low: FloatArray, high: FloatArray, angle: FloatArray) -> FloatArray:
    """Places between ``low`` (α = 0) and ``high`` (α = π) at the angle α."""
    return low + (high - low) * (0.5 - 0.5 * np.cos(angle))


def polynomial_in(coefficients: FloatArray, piece: IndexArray, t: FloatArray) -> FloatArray:
    """Values at t of the polynomials of its pieces, from coefficients of t⁰, t¹, …, shape (d, pieces)."""
    value = coefficients[-1].take(piece)
    for c in coefficients[-2::-1]:
        value *= t
        value += c.take(piece)
    return value


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
