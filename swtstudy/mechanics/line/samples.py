"""Samples of the stress around the three instants that make swt, and the best plane by these."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.through_y import PlaneHistory, best_angle
from swtstudy.mechanics.points import FloatArray

#: How often the plane is improved and the extremes over the cycle are looked up anew: for all, and at most
#: where swt still rises, since the extremes move with the plane. 2 at most: 4e-4 at rtol 1e-4 at 1 of 1,001
#: points (tests/mechanics/test_narrow_maxima.py).
ANGLE_ROUNDS, LARGEST_ANGLE_ROUNDS = 2, 16


@dataclass(frozen=True)
class Samples:
    """k samples around each of three extremes at n × X positions.

    Attributes
    ----------
    brackets
        Where they lie.
    near
        Shape (3, n, X, 3, k), see `of_extremes`.
    criterion
        Shape (n, 1).
    """

    brackets: TimeBrackets
    near: FloatArray
    criterion: Criterion

    def take(self, index: NDArray[np.intp]) -> Samples:
        """Return the samples of the points at ``index``."""
        return Samples(self.brackets.take(index), self.near[:, index], self.criterion.take(index))

    def or_other(self, own: NDArray[np.bool_], other: Samples) -> Samples:
        """These around the extremes that are ``own``, shape (n, X, 3), and other ones around the others."""
        near = np.where(own[..., None], self.near, other.near)
        return replace(self, brackets=self.brackets.or_other(own, other.brackets), near=near)

    def narrowed(self, angle: FloatArray) -> TimeBrackets:
        """Brackets around the best samples on planes (n, X)."""
        return self.brackets.narrowed(on_plane(self.near, angle).argmax(axis=-1))

    def tops(self, angle: FloatArray) -> FloatArray:
        """Maxima of the three curves between the samples, on planes (n, X), shape (n, X, 3)."""
        return on_plane(self._at_peaks(angle), angle)

    def best_plane(self, angle: FloatArray, gain: float) -> tuple[FloatArray, FloatArray]:
        """swt and 2θ of the best planes near some, each (n, X), until they rise by less than a share."""
        for _ in range(ANGLE_ROUNDS):
            peaks, start = self._at_peaks(angle), angle
            angle = _turned(peaks, start, self.criterion)
        before, peaks = _swt(peaks, start, self.criterion), self._at_peaks(angle)
        swt = _swt(peaks, angle, self.criterion)
        rows, some = np.arange(len(angle)), self
        for _ in range(ANGLE_ROUNDS, LARGEST_ANGLE_ROUNDS):
            rises = np.flatnonzero((swt[rows] - before > gain * swt[rows]).any(axis=1))
            if not rises.size:
                break
            rows, some, before = rows[rises], some.take(rises), swt[rows[rises]]
            start = angle[rows]
            turned = _turned(peaks[:, rises], start, some.criterion)
            peaks = some._at_peaks(turned)
            found = _swt(peaks, turned, some.criterion)
            swt[rows], angle[rows] = found, turned
        return swt, angle

    def _at_peaks(self, angle: FloatArray) -> FloatArray:
        """Coefficients of the three curves at their maxima between the samples, shape (3, n, X, 3)."""
        weights = self.brackets.weights_at_peak(on_plane(self.near, angle))
        return np.asarray((self.near * weights).sum(axis=-1))


def _turned(peaks: FloatArray, angle: FloatArray, criterion: Criterion) -> FloatArray:
    """2θ at which the extremes (3, n, X, 3) of planes (n, X) make the largest swt."""
    return best_angle(peaks[..., 0], 0.5 * (peaks[..., 1] + peaks[..., 2]), angle, criterion)


def _swt(peaks: FloatArray, angle: FloatArray, criterion: Criterion) -> FloatArray:
    """swt by the extremes (3, n, X, 3) of planes (n, X)."""
    return criterion.of_maxima(*np.moveaxis(on_plane(peaks, angle), -1, 0))


def of_extremes(planes: PlaneHistory) -> FloatArray:
    """Coefficients of the curves whose maxima make swt, each at its own samples: (3, n, X, 3, k)."""
    stress, swing = (values.reshape(*values.shape[:-1], 3, -1) for values in (planes.stress, planes.swing))
    return np.stack([stress[..., 0, :], swing[..., 1, :], -swing[..., 2, :]], axis=-2)


def on_plane(coefficients: FloatArray, angle: FloatArray) -> FloatArray:
    """A + B cos 2θ + C sin 2θ of coefficients (3, n, X, …) at 2θ of shape (n, X)."""
    a, b, c = coefficients
    angle = angle.reshape(angle.shape + (1,) * (a.ndim - angle.ndim))
    return np.asarray(a + b * np.cos(angle) + c * np.sin(angle))
