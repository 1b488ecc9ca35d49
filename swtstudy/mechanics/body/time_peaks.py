"""The highest peaks of curves over the periodic cycle, and what may be hidden beside them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import gather
from swtstudy.mechanics.numerics.peaks import parabola_maximum
from swtstudy.mechanics.points import FloatArray

#: Instants nearer to one another, rad, are one.
SAME_INSTANT = 1e-9


class Peaks(NamedTuple):
    """The highest peaks of curves over the periodic cycle.

    Attributes
    ----------
    instant, value
        Shape (…, m, peaks, 3): before, at and after each peak.
    peaked
        Shape (…, m, peaks): whether it is a peak.
    """

    instant: FloatArray
    value: FloatArray
    peaked: NDArray[np.bool_]

    @classmethod
    def of(cls, instant: FloatArray, curve: FloatArray, count: int) -> Peaks:
        """Find the peaks of curves, (…, m, T), at ascending instants, (m, T). Instants that meet are one."""
        around, at = _neighbours(instant)
        before, after = (gather(curve, np.broadcast_to(at[k], curve.shape)) for k in (0, 2))
        peaked = (curve >= before) & (curve >= after) & (around[0] < around[1])
        highest = np.argpartition(np.where(peaked, -curve, np.inf), count, axis=-1)[..., :count]
        three = np.stack([gather(np.broadcast_to(v, curve.shape), highest) for v in around], axis=-1)
        values = np.stack([gather(v, highest) for v in (before, curve, after)], axis=-1)
        return cls(three, values, gather(peaked, highest))

    @property
    def beside(self) -> FloatArray:
        """The middle of both gaps, and where a parabola has its maximum, shape (…, m, 3 · peaks)."""
        top, _ = parabola_maximum(self.instant.reshape(-1, 3), self.value.reshape(-1, 3))
        left, right = (0.5 * (self.instant[..., k] + self.instant[..., k + 1]) for k in range(2))
        return np.mod(np.concatenate([left, top.reshape(left.shape), right], axis=-1), PERIOD)

    def hidden(self, beside: FloatArray) -> FloatArray:
        """Misfit of the parabolas at the instants beside, if that tops all peaks, (…, m)."""
        left, _, right = np.split(beside, 3, axis=-1)
        width, rise = np.diff(self.instant), np.diff(self.value)
        slope = rise / np.maximum(width, SAME_INSTANT)
        bend = (slope[..., 1] - slope[..., 0]) / np.maximum(width.sum(axis=-1), SAME_INSTANT)
        middle = 0.5 * (self.value[..., 1:] + self.value[..., :-1]) - 0.25 * bend[..., None] * width**2
        off = np.abs(middle - np.stack([left, right], axis=-1)).max(axis=-1)
        top = np.where(self.peaked, self.value[..., 1], -np.inf).max(axis=-1, keepdims=True)
        return np.where(self.peaked, np.maximum(off + self.value[..., 1] - top, 0.0), 0.0).max(axis=-1)


def _neighbours(instant: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
    """The last instant before each of the rows', itself, and the next one, and where they are, (3, m, T).

    Those that meet have the same next one; only the first of them has one before.
    """
    count = instant.shape[1]
    index = np.broadcast_to(np.arange(count), instant.shape)
    new = np.ones((len(instant), count + 1), dtype=bool)
    new[:, 1:-1] = np.diff(instant) > SAME_INSTANT
    begins = np.where(new, np.arange(count + 1), count)
    after = np.minimum.accumulate(begins[:, :0:-1], axis=1)[:, ::-1]
    before = np.where(new[:, :-1], index - 1, index)
    at = np.stack([before, index, after])
    return gather(instant, at % count) + PERIOD * (at // count), at % count
