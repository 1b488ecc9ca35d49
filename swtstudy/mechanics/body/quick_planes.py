"""The critical planes of many similar histories: fewer planes and climbs than `all_planes` takes.

On a plane the highest peaks over the periodic cycle count, and what may be hidden beside them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import SAME, gather
from swtstudy.mechanics.numerics.roots import parabola_maximum
from swtstudy.mechanics.planes.all_planes import PROMISING, CoarsePlanes, swt_of_history
from swtstudy.mechanics.planes.ascent import ROUGH_STEP, ActiveForms, Rows, climb_by
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.swing import Swing
from swtstudy.mechanics.planes.weights import normal_weights
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray


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
    peaked: BoolArray

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
        slope = rise / np.maximum(width, SAME)
        bend = (slope[..., 1] - slope[..., 0]) / np.maximum(width.sum(axis=-1), SAME)
        middle = 0.5 * (self.value[..., 1:] + self.value[..., :-1]) - 0.25 * bend[..., None] * width**2
        off = np.abs(middle - np.stack([left, right], axis=-1)).max(axis=-1)
        top = np.where(self.peaked, self.value[..., 1], -np.inf).max(axis=-1, keepdims=True)
        return np.where(self.peaked, np.maximum(off + self.value[..., 1] - top, 0.0), 0.0).max(axis=-1)


def _neighbours(instant: FloatArray) -> tuple[FloatArray, IndexArray]:
    """The last instant before each of the rows', itself, and the next one, and where they are, (3, m, T).

    Those that meet have the same next one; only the first of them has one before.
    """
    count = instant.shape[1]
    index = np.broadcast_to(np.arange(count), instant.shape)
    new = np.ones((len(instant), count + 1), dtype=bool)
    new[:, 1:-1] = np.diff(instant) > SAME
    begins = np.where(new, np.arange(count + 1), count)
    after = np.minimum.accumulate(begins[:, :0:-1], axis=1)[:, ::-1]
    before = np.where(new[:, :-1], index - 1, index)
    at = np.stack([before, index, after])
    return gather(instant, at % count) + PERIOD * (at // count), at % count


#: Planes this high in some histories, over the highest, are tried in others like them. 0: no change.
NEAR = 0.7
#: Planes from which to climb: those higher than the ones beside them before other high ones. Two: a plane
#: 2° from another one's summit was missed, swt 7e-3 low.
CANDIDATES = 4
#: Cosine of the angle, 2°, between summits that are one. 6°: 1.03 times as much is missing.
ALIKE = 0.9995


def planes_like(stress: FloatArray, ν: float, criterion: Criterion) -> CoarsePlanes:
    """Return the planes near to the highest in some of the histories, and those beside them."""
    every = CoarsePlanes.everywhere()
    swt = every.swt(stress, ν, criterion)
    high = (swt >= NEAR * swt.max(axis=1, keepdims=True)).any(axis=0)
    high[every.beside[high]] = True
    return every.some(high)


def rival_planes(
    stress: FloatArray, planes: CoarsePlanes, ν: float, criterion: Criterion
) -> tuple[IndexArray, FloatArray, FloatArray]:
    """Planes on which swt has its summits, if not much lower than the highest of their history.

    Parameters
    ----------
    stress
        Shape (m, T, 6), in E* √(δ0/R).
    planes
        From which to climb.
    ν, criterion
        Poisson's ratio; criterion of shape (1,).

    Returns
    -------
    history, swt, normal
        Shape (n,), ascending, (n,) over E* δ0/R, and (n, 3): at least one plane of each history.
    """
    coarse = planes.swt(stress, ν, criterion)
    peaked = coarse >= coarse[:, planes.beside].max(axis=-1)
    peaked &= coarse > PROMISING * coarse.max(axis=1, keepdims=True)
    first = np.where(peaked, -2.0 * coarse, -coarse)
    highest = np.argpartition(first, CANDIDATES, axis=1)[:, :CANDIDATES]
    swt, normal = _climb(stress, ν, planes.normal[highest], criterion)
    # Tension may be confined to few planes.
    none = np.flatnonzero(swt.max(axis=1) <= 0.0)
    if none.size:
        swt[none, 0], normal[none, 0] = swt_of_history(stress[none], ν, 1.0 - ν**2, criterion)
    order = np.argsort(-swt, axis=1)
    swt, normal = gather(swt, order), normal[np.arange(len(swt))[:, None], order]
    rival = swt > PROMISING * swt[:, :1]
    for late in range(1, CANDIDATES):
        alike = np.abs((normal[:, :late] * normal[:, late, None]).sum(axis=-1)) > ALIKE
        rival[:, late] &= ~(alike & rival[:, :late]).any(axis=1)
    rival[:, 0] = True
    return np.nonzero(rival)[0], swt[rival], normal[rival]


def climb_from(
    stress: FloatArray, ν: float, start: FloatArray, criterion: Criterion
) -> tuple[FloatArray, FloatArray]:
    """Summits of swt over E* δ0/R, (m,), and their normals, (m, 3), from normals nearby."""
    swt, normal = _climb(stress, ν, start[:, None], criterion)
    return swt[:, 0], normal[:, 0]


def on_planes(
    stress: FloatArray, ν: float, normal: FloatArray, swing: Swing, like: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """σ_n and the swing of histories, (m, T, 6), on k planes each, (m, k, 3), shape (m, k, T).

    A strain with E = 1. Of a vector along the line in which it swings most, in other histories if these are
    given as ``like``.
    """
    tension = normal_weights(normal) @ stress.swapaxes(1, 2)
    return tension, swing.on_planes(stress, normal, tension, ν, stress if like is None else like)


def _climb(
    stress: FloatArray, ν: float, start: FloatArray, criterion: Criterion
) -> tuple[FloatArray, FloatArray]:
    """Summits, (m, k), and their normals, (m, k, 3), from normals, (m, k, 3)."""
    several, modulus = start.shape[1], 1.0 - ν**2
    unit = modulus if criterion.swing.is_strain else 1.0
    flat = start.reshape(-1, 3)
    every, current = np.arange(len(flat)), flat.copy()

    def active(rows: Rows, normal: FloatArray, own: Criterion) -> ActiveForms:
        current[rows] = normal
        history, number = np.divmod(every[rows], several)
        some = np.unique(history)
        histories = stress if some.size == len(stress) else stress[some]
        tension, curve = on_planes(histories, ν, current.reshape(start.shape)[some], own.swing)
        history = np.searchsorted(some, history)
        tension, curve = tension[history, number], curve[history, number]
        row = np.arange(len(history))
        top, high, low = tension.argmax(axis=1), curve.argmax(axis=1), curve.argmin(axis=1)
        change = own.swing.tensor(0.5 * (histories[history, high] - histories[history, low]), ν, modulus)
        swt = own.value(tension[row, top], 0.5 / unit * (curve[row, high] - curve[row, low]))
        return swt, histories[history, top], change

    swt, normal = climb_by(active, flat, criterion.take(np.zeros(len(flat), dtype=np.intp)), ROUGH_STEP)
    return swt.reshape(start.shape[:2]), normal.reshape(start.shape)
