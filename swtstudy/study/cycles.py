"""Cycles of a record: folded to one, their scatter and drift, and the harmonics that fit them best."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.numerics.arrays import TINY
from swtstudy.mechanics.points import FloatArray

#: Least eigenvalue of the mean products of harmonics, 1/2 of samples at even phases: below this noise would
#: count seven times as much.
LEAST_EIGENVALUE = 0.01


def folded(time: FloatArray, values: FloatArray, period: float, count: int) -> FloatArray:
    """The first whole cycles of a record at even phases, as many as it has samples in a cycle.

    Parameters
    ----------
    time
        Shape (k,), ascending.
    values
        Shape (k, d).
    period, count
        Length of a cycle, and how many.

    Returns
    -------
    array
        Shape (count, m, d); straight lines between the samples.
    """
    step = (time[-1] - time[0]) / (len(time) - 1)
    phases = max(2, round(period / step))
    at = time[0] + period * (np.arange(count)[:, None] + np.arange(phases) / phases)
    return np.stack([np.interp(at, time, column) for column in values.T], axis=-1)


def scatter(cycles: FloatArray) -> FloatArray:
    """Standard deviation of cycles (c, m, d) from their mean, root mean square over phases, shape (d,)."""
    count = len(cycles)
    if count < 2:
        return np.full(cycles.shape[-1], np.nan)
    variance = cycles.var(axis=0, ddof=1)
    return np.asarray(np.sqrt(variance.mean(axis=0)))


def drift(cycles: FloatArray) -> float:
    """Share of the period by which each of the cycles, (c, m, d), comes late; 0 for a single one.

    The shift of the mean cycle with which the steps from cycle to cycle agree best, in the sense of least
    squares, of the first three harmonics of columns over their `scatter`: the period is longer by so much.
    """
    size = scatter(cycles)
    some = size > 0.0
    if not some.any():
        return 0.0
    means = (v.mean(axis=0)[:, some] / size[some] for v in (cycles, np.diff(cycles, axis=0)))
    mean, step = (np.fft.rfft(v, axis=0)[1:4] for v in means)
    slope = 2j * np.pi * np.arange(1, len(mean) + 1)[:, None] * mean
    return float(-(slope.conj() * step).sum().real / max((np.abs(slope) ** 2).sum(), TINY))


def mean_over(time: FloatArray, values: FloatArray, period: float) -> float:
    """Mean of one closed cycle over the time, by straight lines; the samples need not be even."""
    at, closed = np.append(time, time[0] + period), np.append(values, values[0])
    return float(np.sum(np.diff(at) * 0.5 * (closed[1:] + closed[:-1])) / period)


def harmonics(phase: FloatArray, values: FloatArray, highest: int) -> tuple[FloatArray, FloatArray]:
    """The harmonics that fit a column best, in the sense of least squares, and the fit.

    Parameters
    ----------
    phase
        Shape (k,): φ of each sample, rad.
    values
        Shape (k,).
    highest
        The highest order.

    Returns
    -------
    rows
        Shape (highest + 1, 3): order, amplitude and phase of amplitude · sin(order · φ + phase).
    fit
        Shape (k,).
    """
    base = _waves(phase, highest)
    found = np.linalg.lstsq(base, values, rcond=None)[0]
    sine, cosine = found[1 : highest + 1], found[highest + 1 :]
    rows = np.stack([np.arange(1, highest + 1), np.hypot(sine, cosine), np.arctan2(cosine, sine)], axis=1)
    return np.concatenate([[[0.0, found[0], 0.5 * np.pi]], rows]), base @ found


def determined(phase: FloatArray, highest: int) -> bool:
    """Return whether samples tell harmonics apart: cycles sampled at the same phases count as one."""
    base = _waves(phase, highest)
    return bool(np.linalg.eigvalsh(base.T @ base / len(phase))[0] > LEAST_EIGENVALUE)


def _waves(phase: FloatArray, highest: int) -> FloatArray:
    """Shape (k, 2 · highest + 1): one, sines and cosines."""
    waves = np.outer(phase, np.arange(1, highest + 1))
    return np.concatenate([np.ones((len(phase), 1)), np.sin(waves), np.cos(waves)], axis=1)
